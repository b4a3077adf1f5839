// Level 3: every way to the same picture. The mean radiance of a small film, by the path tracer and by photon maps with
// every strategy, form and gathering, must agree.
//
// Photon maps have a kernel's bias, which is no error of theirs. Each pass is rendered with two radii and extrapolated
// to radius 0: where the photons' density is smooth the bias goes with r^2, where a sphere sticks out of the medium
// with r [Silverman1986, sec. 3.3; Jarosz2008, sec. 7.5.3].
#include <fmt/format.h>

#include "vpm/base/parallel.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/ladder.h"
#include "vpm/study/validate/scenes/gatherings.h"
#include "vpm/study/validate/scenes/small_scenes.h"

namespace vpm {
namespace {

/// A way to the mean radiance of the film: per channel, with the effective number of samples.
struct Measured {
  std::vector<Moments> channels;
  double effective = 0.0;
};

/// Rays through random places of the film.
Measured by_path_tracer(const Scene& scene, const RenderSettings& settings, uint64_t rays) {
  const PathContext context = make_path_context(scene, settings);
  // The last quantity is the sum over channels, for the effective sample size.
  Measured measured{sample_moments(4, rays, settings.seed, [&](Rng& rng, double* out) {
    const Vec2 film = rng.uniform2() * Vec2(scene.camera.width, scene.camera.height);
    EyeCounters counters;
    const Rgb radiance = path_radiance(context, scene.camera.ray(film), scene.camera_medium, rng, counters);
    for (int c = 0; c < 3; ++c) out[c] = radiance[c];
    out[3] = sum_channels(radiance);
  })};
  measured.effective = effective_sample_size(measured.channels[3]);
  measured.channels.pop_back();
  return measured;
}

/// How a kernel's bias vanishes with its radius, for the extrapolation to radius 0.
enum class BiasOrder { edges = 1, smooth = 2 };

Pass render_pass(const Scene& scene, const RenderSettings& settings, int pass) {
  const auto render = settings.integrator == Integrator::combined ? render_combined_pass : render_photon_pass;
  return render(scene, settings, pass, {});
}

/// Photon maps, and combined techniques: extrapolated passes.
Measured by_photons(const Scene& scene, RenderSettings settings, BiasOrder order, int passes) {
  const double half = order == BiasOrder::smooth ? 4.0 / 3.0 : 2.0;  // the weight of half the radius
  settings.radii = RadiusSchedule::constant;
  RenderSettings halved = settings;
  for (AskedGather* gather : std::initializer_list<AskedGather*>{&halved.volume, &halved.surface, &halved.caustics})
    gather->radius = 0.5f * gather->radius.metres();
  std::vector<Rgbd> means(static_cast<size_t>(passes));
  std::vector<double> effective(means.size());
  parallel_for_chunks(means.size(), 1, [&](size_t i, size_t, size_t) {
    const int pass = static_cast<int>(i);
    const Pass coarse = render_pass(scene, settings, 2 * pass);
    const Pass fine = render_pass(scene, halved, 2 * pass + 1);
    means[i] = half * channel_means(fine.image) + (1.0 - half) * channel_means(coarse.image);
    const Ledger& ledger = fine.statistics.ledger;
    effective[i] = ledger.weights.sum > 0.0 ? ledger.weights.effective_sample_size() : kLeastSampleSize;
  });
  Measured measured{std::vector<Moments>(3)};
  for (size_t i = 0; i < means.size(); ++i) {
    for (int c = 0; c < 3; ++c) measured.channels[c].add(means[i][c]);
    measured.effective += effective[i];
  }
  return measured;
}

/// One check per channel (one where all are alike); none determined where the effective sample size is small.
void compare(std::vector<Check>& checks, const std::string& name, const Measured& measured, const Measured& reference,
             bool grey) {
  for (size_t c = 0; c < (grey ? 1 : 3); ++c) {
    const std::string full = name + (grey ? "" : kOfChannel[c]);
    const Moments &value = measured.channels[c], &exact = reference.channels[c];
    if (measured.effective < kLeastSampleSize)
      checks.push_back(not_determined(full, value.mean(), exact.mean(),
                                      fmt::format("effective sample size {:.0f}", measured.effective)));
    else
      checks.push_back(check_same(full, value, exact));
  }
}

/// A scene with the radius its photon maps need.
struct Subject {
  std::string name;
  std::function<Scene()> make;
  BiasOrder order;
  float radius;        // m, of the coarser map
  uint64_t times = 1;  // as many photons as for others: more where few come near the camera
};

RenderSettings photon_settings(const Subject& subject, uint64_t photons) {
  RenderSettings settings;
  settings.photons.emitted = photons * subject.times;
  settings.volume.radius = settings.surface.radius = settings.caustics.radius = subject.radius;
  return settings;
}

std::vector<Check> compare_gatherings(const Subject& subject, const Effort& effort) {
  const Scene scene = subject.make();
  const bool media = !scene.media.empty(), surfaces = facts_of(scene).rough_surfaces;
  RenderSettings paths;
  paths.seed = effort.seed_of(subject.name + " by paths");
  const Measured reference = by_path_tracer(scene, paths, effort.count(40'000, 300'000));
  std::vector<Check> checks;
  for (auto& [name, settings] :
       gatherings(photon_settings(subject, effort.count(3'000, 8'000)), media, surfaces, effort.count(0, 1) > 0)) {
    const bool long_beams = settings.volume.length == BeamLength::long_beams;
    if (long_beams && scene.world_medium != kVacuum) continue;  // they have no end
    settings.seed = effort.seed_of(subject.name + name);
    const int passes = static_cast<int>(effort.count(20, 64));
    compare(checks, name, by_photons(scene, settings, subject.order, passes), reference, scene.grey);
  }
  return checks;
}

/// Careful flights; by local extinction with the mean extinction at the least, as their weights have no bound else.
DistanceSettings flights_by(const StrategyInfo& strategy) {
  DistanceSettings settings = careful_settings(strategy.name);
  if (strategy.name == "local-extinction") settings.parameters["extinction_floor"] = 1.0f;
  return settings;
}

TransmittanceSettings shadow_rays_by(const EstimatorInfo& estimator) {
  return {std::string(estimator.name), among(estimator.parameters, {{"step", kCarefulStep}})};
}

/// Every strategy, for paths of the path tracer and for photons if it is for them, and every estimator of
/// transmittance.
std::vector<Check> compare_strategies(const Subject& subject, const Effort& effort) {
  const Scene scene = subject.make();
  RenderSettings base = photon_settings(subject, effort.count(3'000, 8'000));
  base.distance = careful_settings(base.distance.strategy);
  base.seed = effort.seed_of(subject.name + " reference");
  const uint64_t rays = effort.count(40'000, 300'000);
  const Measured reference = by_path_tracer(scene, base, rays);
  bool grids = false;
  for (const Medium& medium : scene.media) grids |= !medium.homogeneous();
  std::vector<Check> checks;
  for (const StrategyInfo& strategy : distance_strategies()) {
    if (grids && !strategy.heterogeneous) continue;
    if (!grids && !strategy.positive) continue;  // in an endless medium the variance has no bound
    RenderSettings settings = base;
    settings.distance = flights_by(strategy);
    settings.seed = effort.seed_of(fmt::format("{} {} paths", subject.name, strategy.name));
    compare(checks, fmt::format("paths by {}", strategy.name), by_path_tracer(scene, settings, rays), reference,
            scene.grey);
    if (!strategy.positive) continue;
    settings.seed = effort.seed_of(fmt::format("{} {} photons", subject.name, strategy.name));
    const int passes = static_cast<int>(effort.count(20, 64));
    compare(checks, fmt::format("photons by {}", strategy.name), by_photons(scene, settings, subject.order, passes),
            reference, scene.grey);
  }
  for (const EstimatorInfo& estimator : transmittance_estimators()) {
    RenderSettings settings = base;
    settings.transmittance = shadow_rays_by(estimator);
    settings.seed = effort.seed_of(fmt::format("{} {}", subject.name, estimator.name));
    compare(checks, fmt::format("shadow rays by {}", estimator.name), by_path_tracer(scene, settings, rays), reference,
            scene.grey);
  }
  return checks;
}

/// Every strategy with every estimator of transmittance, by the path tracer, in every form of the photon map, and where
/// beams may fly by it, with these.
std::vector<Check> combinations(const Effort& effort) {
  const Scene scene = small_cloud(Viewpoint::outside, Rgb(0.8f, 1.0f, 1.3f));
  RenderSettings base = photon_settings({"", {}, BiasOrder::smooth, 0.3f}, effort.count(3'000, 8'000));
  base.seed = effort.seed_of("combinations reference");
  const Measured reference = by_path_tracer(scene, base, effort.count(80'000, 600'000));
  std::vector<Check> checks;
  for (const StrategyInfo& strategy : distance_strategies()) {
    if (!strategy.heterogeneous) continue;
    base.distance = flights_by(strategy);
    const uint64_t rays = effort.count(10'000, 80'000) * (strategy.bounded_weight ? 1 : 4);
    for (const EstimatorInfo& estimator : transmittance_estimators()) {
      RenderSettings settings = base;
      settings.transmittance = shadow_rays_by(estimator);
      const std::string name = fmt::format("paths by {}, shadow rays by {}", strategy.name, estimator.name);
      settings.seed = effort.seed_of("combinations " + name);
      compare(checks, name, by_path_tracer(scene, settings, rays), reference, scene.grey);
    }
    if (!strategy.positive) continue;
    for (auto& [form, settings] : forms(base, true)) {
      const std::string name = fmt::format("photons by {}, {}", strategy.name, form);
      settings.seed = effort.seed_of("combinations " + name);
      const int passes = static_cast<int>(effort.count(10, 32));
      compare(checks, name, by_photons(scene, settings, BiasOrder::smooth, passes), reference, scene.grey);
    }
    if (!strategy.analog) continue;
    RenderSettings beams = base;
    beams.volume.choose("photon-beams");
    RenderSettings around_points = beams;
    around_points.volume.choose("beams-points");
    RenderSettings planes = beams;
    planes.volume.choose("photon-planes");
    planes.volume.length = BeamLength::long_beams;
    planes.volume.planes = 200;
    for (auto& [what, settings] :
         NamedSettings{{"beams", beams}, {"beams around points", around_points}, {"planes and long beams", planes}}) {
      const std::string name = fmt::format("photon {} by {}", what, strategy.name);
      settings.seed = effort.seed_of("combinations " + name);
      const int passes = static_cast<int>(effort.count(10, 32));
      compare(checks, name, by_photons(scene, settings, BiasOrder::smooth, passes), reference, scene.grey);
    }
  }
  return checks;
}

/// Every set of techniques in a grid whose extinction differs between channels.
std::vector<Check> combine_in_chromatic_cloud(const Effort& effort) {
  const Scene scene = small_cloud(Viewpoint::inside, Rgb(1.0f, 2.0f, 4.0f));
  RenderSettings base = photon_settings({"", {}, BiasOrder::smooth, 0.3f}, effort.count(3'000, 8'000));
  base.seed = effort.seed_of("chromatic cloud reference");
  const Measured reference = by_path_tracer(scene, base, effort.count(80'000, 600'000));
  NamedSettings sets;
  append_combined(sets, base, true, false, true);
  sets.emplace_back("photon beams alone", base);  // what they have left of their powers is looked up ray by ray
  sets.back().second.volume.choose("photon-beams");
  std::vector<Check> checks;
  for (auto& [name, settings] : sets) {
    settings.seed = effort.seed_of("chromatic cloud, " + name);
    const int passes = static_cast<int>(effort.count(20, 64));
    compare(checks, name, by_photons(scene, settings, BiasOrder::smooth, passes), reference, scene.grey);
  }
  return checks;
}

/// The same box as a homogeneous medium and as a constant grid.
std::vector<Check> constant_grid(const Effort& effort) {
  const Scene plain = filled_box(false), grid = filled_box(true);
  std::vector<Check> checks;
  RenderSettings settings = photon_settings({"", {}, BiasOrder::edges, 0.1f}, effort.count(3'000, 8'000));
  const auto measure = [&](const Scene& scene, const std::string& name, bool photons) {
    settings.seed = effort.seed_of(name);
    return photons ? by_photons(scene, settings, BiasOrder::edges, static_cast<int>(effort.count(20, 64)))
                   : by_path_tracer(scene, settings, effort.count(40'000, 300'000));
  };
  const Measured reference = measure(plain, "plain", false);
  compare(checks, "constant grid, paths", measure(grid, "grid", false), reference, false);
  compare(checks, "constant grid, photons", measure(grid, "grid photons", true), measure(plain, "plain photons", true),
          false);
  compare(checks, "homogeneous, photons", measure(plain, "plain photons again", true), reference, false);
  return checks;
}

}  // namespace

std::vector<Experiment> agreement_experiments() {
  const auto seen_from = [](Viewpoint viewpoint) { return [=] { return small_cloud(viewpoint, Rgb(2.0f)); }; };
  const std::vector<Subject> by_gathering{
      {"a light in chromatic fog, seen from inside", foggy_light, BiasOrder::smooth, 0.25f, 4},
      {"a cloud from outside", seen_from(Viewpoint::outside), BiasOrder::smooth, 0.3f},
      {"a cloud from its border", seen_from(Viewpoint::border), BiasOrder::smooth, 0.3f},
      {"a cloud from inside", seen_from(Viewpoint::inside), BiasOrder::smooth, 0.3f},
      {"a floor next to a wall", [] { return lit_corner(); }, BiasOrder::smooth, 0.08f},
      {"a floor under a ball of glass", [] { return lit_corner(1.5f); }, BiasOrder::smooth, 0.03f},
      {"a floor under a ball of IOR 1", [] { return lit_corner(1.0f); }, BiasOrder::smooth, 0.08f},
      {"a floor shaded as if leaning towards a wall", leaning_wall, BiasOrder::smooth, 0.1f},
      {"rough glass next to rough metal", rough_corner, BiasOrder::smooth, 0.2f},
      {"a floor in fog", foggy_floor, BiasOrder::edges, 0.06f},
      {"a hollow cube", hollow_cube, BiasOrder::edges, 0.1f}};
  const std::vector<Subject> by_strategy{
      {"strategies in a cloud", [] { return small_cloud(Viewpoint::outside, Rgb(1.0f)); }, BiasOrder::smooth, 0.3f},
      {"strategies in chromatic fog", foggy_light, BiasOrder::smooth, 0.25f, 4}};
  std::vector<Experiment> all;
  for (const Subject& s : by_gathering)
    all.push_back({3, s.name, [s](const Effort& effort) { return compare_gatherings(s, effort); }});
  for (const Subject& s : by_strategy)
    all.push_back({3, s.name, [s](const Effort& effort) { return compare_strategies(s, effort); }});
  all.push_back({3, "every strategy with every estimator and form", combinations});
  all.push_back({3, "techniques combined in a chromatic cloud", combine_in_chromatic_cloud});
  all.push_back({3, "a constant grid is a homogeneous medium", constant_grid});
  for (const Experiment& e : light_map_experiments()) all.push_back(e);
  return all;
}

}  // namespace vpm
