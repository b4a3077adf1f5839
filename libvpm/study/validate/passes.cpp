// Passes of a render: their radii by the recurrence, and the variance that the film states against the one it has.
#include <fmt/format.h>
#include <cmath>

#include "base/parallel.h"
#include "render/photon_pass.h"
#include "render/render.h"
#include "study/validate/groups.h"
#include "study/validate/small_scenes.h"

namespace vpm {

namespace {

RenderSettings pass_settings(uint64_t seed) {
  RenderSettings settings;
  settings.seed = seed;
  settings.photons_emitted = 500;
  settings.volume.radius = 0.2f;
  settings.surface.radius = 0.3f;
  return settings;
}

/// r_{i+1}^d = r_i^d (i + A) / (i + 1), A = 4/(d + 4) [Knaus2011, sec. 4], and no change where none is wanted.
std::vector<Check> check_radii(const Effort& effort) {
  static const std::atomic<bool> kGoOn{false};
  const Scene scene = foggy_floor();
  RenderSettings settings = pass_settings(effort.seed_of("radii"));
  std::vector<Check> checks;
  for (const int pass : {0, 1, 30}) {
    const RenderStatistics found = render_photon_pass(scene, settings, pass, kGoOn).statistics;
    const auto check = [&](const char* name, float radius, float first, double d) {
      double measure = 1.0;
      for (int i = 1; i <= pass; ++i) measure *= (i + 4.0 / (d + 4.0)) / (i + 1.0);
      const double exact = first * std::pow(measure, 1.0 / d);
      checks.push_back(check_bound(fmt::format("{} of pass {}", name, pass), radius, exact, 1e-5 * exact));
    };
    check("volume radius", found.last_volume_radius, settings.volume.radius, 3.0);
    check("surface radius", found.last_surface_radius, settings.surface.radius, 2.0);
  }
  settings.shrink_radii = false;
  const RenderStatistics found = render_photon_pass(scene, settings, 30, kGoOn).statistics;
  checks.push_back(check_bound("volume radius that stays", found.last_volume_radius, settings.volume.radius, 0.0));
  checks.push_back(check_bound("surface radius that stays", found.last_surface_radius, settings.surface.radius, 0.0));
  return checks;
}

/// Two films of other seeds differ by as much as the variances they state; over their pixels, for many pairs.
std::vector<Check> check_variance(const Effort& effort) {
  static const std::atomic<bool> kGoOn{false};
  const Scene scene = foggy_floor();
  const size_t pairs = effort.count(100, 2000);
  std::vector<double> stated(pairs), found(pairs);
  parallel_for_chunks(pairs, 1, [&](size_t i, size_t, size_t) {
    const auto film = [&](const char* which) {
      RenderSettings settings = pass_settings(effort.seed_of(fmt::format("film {} {}", which, i)));
      settings.passes = 4;
      settings.shrink_radii = false;  // passes of one distribution
      return render(scene, settings, nothing_rendered(scene.camera), kGoOn, ProgressMode::never).film;
    };
    const Film a = film("a"), b = film("b");
    const Image mean_a = a.mean(), mean_b = b.mean(), variance_a = a.variance_of_mean(),
                variance_b = b.variance_of_mean();
    for (size_t p = 0; p < mean_a.pixels.size(); ++p) {
      stated[i] += 0.5 * (double{variance_a.pixels[p].g} + variance_b.pixels[p].g);
      found[i] += 0.5 * std::pow(double{mean_a.pixels[p].g} - mean_b.pixels[p].g, 2);
    }
  });
  Moments all_stated, all_found, excess;
  for (size_t i = 0; i < pairs; ++i) {
    all_stated.add(stated[i]);
    all_found.add(found[i]);
    excess.add(found[i] - stated[i]);
  }
  Check check = check_mean("variance found less variance stated", excess, 0.0);
  check.note = fmt::format("of the mean of 4 passes, over 36 pixels: found {:.4g}, stated {:.4g}", all_found.mean(),
                           all_stated.mean());
  return {check};
}

}  // namespace

std::vector<Experiment> pass_experiments() {
  return {{4, "radii of a render's passes", check_radii}, {4, "the variance a film states", check_variance}};
}

}  // namespace vpm
