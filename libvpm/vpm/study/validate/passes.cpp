// Passes of a render: their radii by the recurrence, those of pixels by what these find, and the variance that the film
// states against the one it has.
#include <fmt/format.h>
#include <cmath>

#include "vpm/base/parallel.h"
#include "vpm/base/progress.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/render/render.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/small_scenes.h"

namespace vpm {

namespace {

RenderSettings pass_settings(uint64_t seed) {
  RenderSettings settings;
  settings.seed = seed;
  settings.photons.emitted = 500;
  settings.volume.radius = 0.2f;
  settings.surface.radius = 0.3f;
  return settings;
}

/// r_{i+1}^d = r_i^d (i + A) / (i + 1), A = 4/(d + 4) [Knaus2011, sec. 4], and no change where none is wanted.
std::vector<Check> check_radii(const Effort& effort) {
  const Scene scene = foggy_floor();
  RenderSettings settings = pass_settings(effort.seed_of("radii"));
  std::vector<Check> checks;
  for (const int pass : {0, 1, 30}) {
    const RenderStatistics found = render_photon_pass(scene, settings, pass).statistics;
    const auto check = [&](const char* name, float radius, float first, double d) {
      double measure = 1.0;
      for (int i = 1; i <= pass; ++i) measure *= (i + 4.0 / (d + 4.0)) / (i + 1.0);
      const double exact = first * std::pow(measure, 1.0 / d);
      checks.push_back(check_bound(fmt::format("{} of pass {}", name, pass), radius, exact, 1e-5 * exact));
    };
    check("volume radius", found.last_volume_radius, settings.volume.radius.metres(), 3.0);
    check("surface radius", found.last_surface_radius, settings.surface.radius.metres(), 2.0);
    RenderSettings beams = settings;
    beams.volume.choose("beam");
    check("radius around rays", render_photon_pass(scene, beams, pass).statistics.last_volume_radius,
          settings.volume.radius.metres(), 2.0);
    beams.volume.choose("photon-beams");
    check("radius of photon beams", render_photon_pass(scene, beams, pass).statistics.last_volume_radius,
          settings.volume.radius.metres(), 1.0);
    beams.volume.choose("beams-points");
    check("radius of beams around points", render_photon_pass(scene, beams, pass).statistics.last_volume_radius,
          settings.volume.radius.metres(), 2.0);
  }
  settings.radii = RadiusSchedule::constant;
  const RenderStatistics found = render_photon_pass(scene, settings, 30).statistics;
  checks.push_back(
      check_bound("volume radius that stays", found.last_volume_radius, settings.volume.radius.metres(), 0.0));
  checks.push_back(
      check_bound("surface radius that stays", found.last_surface_radius, settings.surface.radius.metres(), 0.0));
  return checks;
}

/// What a pixel keeps by the textbook [Hachisuka2009].
struct TextbookPixel {
  double radius = 0.0;   // R, m
  double photons = 0.0;  // N
  double flux = 0.0;     // tau, W

  void add(double found, double power) {
    if (found == 0.0) return;
    const double shrinks = (photons + 2.0 / 3.0 * found) / (photons + found);
    photons += 2.0 / 3.0 * found;
    flux = (flux + found * power) * shrinks;
    radius *= std::sqrt(shrinks);
  }
};

/// Radii of pixels' own, and the mean of passes, by what so many samples of each pixel have found in each pass.
std::vector<Check> check_pixels(int samples, const Effort& effort) {
  const Scene scene = bare_floor();
  RenderSettings settings = pass_settings(effort.seed_of(fmt::format("pixels, {}", samples)));
  settings.samples_per_pixel = samples;
  settings.until.passes = static_cast<int>(effort.count(12, 100));
  settings.photons.emitted = 2000;
  settings.radii = RadiusSchedule::per_pixel;
  settings.surface.kernel = KernelKind::constant;
  settings.direct.type = DirectLight::photons;
  RenderResult result = nothing_rendered(scene.camera);
  std::vector<TextbookPixel> textbook(result.film.mean().pixels.size(), {settings.surface.radius.metres()});
  const double power = light_power(scene.lights[0], scene.bounds).g;  // of every photon
  const auto run = [&](int number, const RenderResult& so_far, const PassProgress& progress) {
    Pass pass = render_photon_pass_after(so_far.discs, scene, settings, {number, progress});
    for (size_t i = 0; i < textbook.size(); ++i) textbook[i].add(static_cast<double>(pass.found[i]), power / samples);
    return pass;
  };
  result = run_passes(settings.until, {run, tile_count(scene.camera)}, std::move(result), {});
  const double per_flux = 0.5 / kPiD / (kPiD * settings.until.passes * static_cast<double>(settings.photons.emitted));
  const Image mean = result.film.mean();
  double radius_off = 0.0, radiance_off = 0.0;
  size_t lit = 0;
  for (size_t i = 0; i < textbook.size(); ++i) {
    const auto [radius, photons, flux] = textbook[i];
    const double radiance = per_flux * flux / (radius * radius);
    radius_off =
        std::max(radius_off, std::abs(disc_radius(result.discs[i], settings.surface.radius.metres()) / radius - 1.0));
    lit += flux > 0.0 && mean.pixels[i].g > 0.0f;
    radiance_off = std::max(radiance_off, std::abs(mean.pixels[i].g - radiance) / (radiance + 1e-3));
  }
  const std::string at_most =
      fmt::format(", relative, at the most{}", samples == 1 ? "" : fmt::format(", of {} samples", samples));
  return {check_bound("R" + at_most, radius_off, 0.0, 1e-5),
          check_bound("tau / (pi R^2)" + at_most, radiance_off, 0.0, 1e-5),
          check_bound("pixels without light, of " + fmt::format("{} samples", samples),
                      static_cast<double>(textbook.size() - lit), 0.0, 0.5 * static_cast<double>(textbook.size()))};
}

/// Two films of other seeds differ by as much as the variances they state; over their pixels, for many pairs.
std::vector<Check> check_variance(const Effort& effort) {
  const Scene scene = foggy_floor();
  const size_t pairs = effort.count(100, 2000);
  std::vector<double> stated(pairs), found(pairs);
  parallel_for_chunks(pairs, 1, [&](size_t i, size_t, size_t) {
    const auto film = [&](const char* which) {
      RenderSettings settings = pass_settings(effort.seed_of(fmt::format("film {} {}", which, i)));
      settings.until.passes = 4;
      settings.radii = RadiusSchedule::constant;  // passes of one distribution
      return render(scene, settings, nothing_rendered(scene.camera), {}).film;
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
  return {{4, "radii of a render's passes", check_radii},
          {4, "radii of pixels by the photons they find",
           [](const Effort& effort) {
             std::vector<Check> checks = check_pixels(1, effort);
             append(checks, check_pixels(3, effort));
             return checks;
           }},
          {4, "the variance a film states", check_variance}};
}

}  // namespace vpm
