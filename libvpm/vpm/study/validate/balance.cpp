// Nothing gets lost: reflected, transmitted and absorbed power, each tallied where it happens, make up what was sent;
// and in a closed cavity whose walls keep the share rho, light arrives 1/(1 - rho) times.
#include <fmt/format.h>
#include <array>
#include <optional>

#include "vpm/estimate/surface_estimate.h"
#include "vpm/path/follow.h"
#include "vpm/scene/build.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/estimates/irradiance.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/fields.h"
#include "vpm/study/validate/scenes/small_pass.h"

namespace vpm {

namespace {

Medium coloured_medium(const TestField& field) {
  Medium medium;
  medium.sigma_t = Rgb(1.0f, 1.5f, 2.5f);
  medium.sigma_s = Rgb(0.9f, 0.7f, 0.5f) * medium.sigma_t;
  medium.phase = HenyeyGreenstein{0.6f};
  medium.grid = field.grid;
  return medium;
}

/// A beam into the box of the fields. Flows of its 1 W per channel: what leaves backwards and forwards, and what
/// collisions absorb.
std::vector<Check> check_box(const TestField& field, const StrategyInfo& info, const Effort& effort) {
  Scene scene;
  scene.media.push_back(coloured_medium(field));
  const Interface media{0, kVacuum};
  add_shape(scene, field_box(), Boundary{}, &media);
  scene.geometry.commit();
  const auto strategy = make_distance_strategy(careful_settings(info.name));
  const uint64_t tight = info.bounded_weight ? 3'500'000 : 9'000'000;
  const Rgb lost = Rgb(1.0f) - scene.media[0].albedo();
  const Ray beam = test_ray();
  const std::string name = fmt::format("{}, {}", field.name, info.name);
  const auto samples =
      sample_moments(3, effort.count(40'000, tight), effort.seed_of("beam, " + name), [&](Rng& rng, double* sum) {
        WalkCounters counters;
        double reflected[3] = {}, transmitted[3] = {}, absorbed[3] = {};
        const auto see = [&](const Event& event, const PathState&, const PathState& now) {
          const bool back = glm::dot(now.ray.direction, beam.direction) < 0.0f;
          for (int c = 0; c < 3; ++c) {
            if (event.kind == EventKind::collision)
              absorbed[c] += now.throughput[c] * lost[c];
            else
              (back ? reflected : transmitted)[c] += now.throughput[c];
          }
          return true;
        };
        follow({scene, *strategy, counters}, {beam, kVacuum, Rgb(1.0f)}, rng, PhotonVisitor{see});
        for (int c = 0; c < 3; ++c) sum[c] = reflected[c] + transmitted[c] + absorbed[c];
      });
  std::vector<Check> checks;
  for (size_t c = 0; c < 3; ++c) checks.push_back(check_weighted_mean(name + kOfChannel[c], samples[c], 1.0));
  return checks;
}

/// Coloured fog over a floor, a sphere of glass, a mirror, lights of many kinds, and a camera for what guides photons.
Scene scene_with_everything(const TestField& field) {
  Scene scene;
  scene.media.push_back(coloured_medium(field));
  const Interface media{0, kVacuum};
  add_shape(scene, field_box(), Boundary{}, &media);
  add_shape(scene, quad_mesh(Vec3d(-2.0, -1.5, -2.0), Vec3d(0.0, 0.0, 5.0), Vec3d(5.0, 0.0, 0.0)),
            Lambertian{Rgb(0.8f, 0.5f, 0.3f)});
  add_shape(scene, SphereShape{field_point({1.0, -2.0, 1.0}), 0.3f}, Dielectric{1.4f});
  add_shape(scene, SphereShape{Vec3(-1.2f, 0.6f, 1.2f), 0.4f}, Mirror{Rgb(0.9f, 0.8f, 0.7f)});
  scene.lights.push_back(PointLight{field_point({2.0, 3.0, 0.0}), Rgb(1.0f, 0.5f, 0.2f)});
  scene.lights.push_back(ConstantEnvironment{Rgb(0.2f)});
  scene.lights.push_back(BeamLight{test_ray().origin, test_ray().direction, 0.2f, Rgb(4.0f)});
  scene.lights.push_back(DirectionalLight{glm::normalize(Vec3(0.3f, -0.8f, 0.1f)), Rgb(0.1f, 0.2f, 0.3f)});
  const DiscShape disc{Vec3(0.2f, 1.9f, -0.3f), glm::normalize(Vec3(0.1f, -1.0f, 0.2f)), 0.3f};
  add_shape(scene, disc, Lambertian{Rgb(0.2f)}, nullptr, static_cast<int>(scene.lights.size()));
  scene.lights.push_back(DiscLight{disc.center, disc.normal, disc.radius, Rgb(1.0f, 0.7f, 0.4f)});
  const TriangleMesh light = box_mesh(Vec3d(1.6, 1.7, 1.6), Vec3d(1.9, 1.9, 1.8));
  add_shape(scene, light, Lambertian{Rgb(0.4f)}, nullptr, static_cast<int>(scene.lights.size()));
  scene.lights.push_back(MeshLight{std::make_shared<EmittingMesh>(light), Rgb(0.8f)});
  scene.camera = make_camera(Vec3(3.0f, 0.5f, 3.0f), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The photons' own ledger. In the sum of channels that of a batch nearly closes: what became of power is what it was.
/// In each channel it closes on average, because channels mix on the way; so does what was emitted.
std::vector<Check> check_ledger(const Scene& scene, std::string_view strategy_name, const GuideSettings& guided,
                                const Effort& effort) {
  const std::string name = fmt::format("ledger of a scene with everything, {}{}", strategy_name,
                                       guided.importons == 0 ? ""
                                       : guided.scatter      ? ", guided where they scatter, too"
                                                             : ", guided");
  const auto strategy = make_distance_strategy({.strategy = std::string(strategy_name)});
  TraceSettings settings;
  settings.seed = effort.seed_of(name);
  settings.emitted = effort.count(200, 40'000);
  std::optional<PhotonGuide> guide;
  if (guided.importons > 0) {
    guide = learn_guide(scene, *strategy, guided, settings.seed, 0, settings.max_events);
    settings.guide = &*guide;
    settings.split = guided.split;
  }
  Rgbd power(0.0);
  for (const Light& light : scene.lights) power += Rgbd(light_power(light, scene.bounds));
  Ledger all;
  ChannelMoments emitted;  // W, by batch
  Moments gained;          // in all channels, likewise
  for (settings.pass = 0; settings.pass < 100; ++settings.pass) {
    Progress progress("", 0, false);
    const Ledger ledger = trace_photons(scene, *strategy, settings, {}, progress);
    const Rgbd gone = ledger.absorbed_in_media + ledger.absorbed_on_surfaces + ledger.escaped + ledger.cut;
    const Rgbd gain = (gone - ledger.emitted) / static_cast<double>(ledger.emitted_count);
    gained.add(gain.r + gain.g + gain.b);
    emitted.add(ledger.emitted / static_cast<double>(ledger.emitted_count));
    all.merge(ledger);
  }
  const double size = all.weights.effective_sample_size();
  const auto check = [&](std::string what, const Moments& samples, double exact) {
    return size < kLeastSampleSize ? not_determined(std::move(what), samples.mean(), exact,
                                                    fmt::format("effective sample size {:.0f}", size))
                                   : check_mean(std::move(what), samples, exact);
  };
  const uint64_t faults = all.non_finite + all.cut_count + all.walk.medium_mismatches;
  std::vector<Check> checks{check(name, gained, 0.0), check_bound(name + ", cut, not finite or in the wrong medium",
                                                                  static_cast<double>(faults), 0.0, 0.0)};
  for (size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<int>(c);
    checks.push_back(check(name + kOfChannel[c], all.imbalance.channels[c], 0.0));
    checks.push_back(check(name + ", emitted" + kOfChannel[c], emitted.channels[c], power[channel]));
  }
  return checks;
}

std::vector<Check> check_flows(const Effort& effort) {
  const auto fields = test_fields();
  std::vector<Check> checks;
  append(checks, check_box({"homogeneous", nullptr}, strategy_info("homogeneous"), effort));
  for (const StrategyInfo& info : distance_strategies())
    if (info.heterogeneous && info.positive) append(checks, check_box(fields[5], info, effort));
  append(checks, check_ledger(scene_with_everything({"homogeneous", nullptr}), "homogeneous", {}, effort));
  const Scene scene = scene_with_everything(fields[5]);
  for (const StrategyInfo& info : distance_strategies())
    if (info.heterogeneous && info.positive) append(checks, check_ledger(scene, info.name, {}, effort));
  for (const bool scatter : {false, true})
    append(checks, check_ledger(scene, "regular", {.importons = 2'000, .scatter = scatter}, effort));
  return checks;
}

/// A closed cavity of grey walls with a light in it.
template <class Surface>
Scene cavity(const Surface& walls, float reflectance, const Vec3& light) {
  Scene scene;
  add_shape(scene, walls, Lambertian{Rgb(reflectance)});
  scene.lights.push_back(PointLight{light, Rgb(1.0f / (4.0f * kPi))});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// Power that arrives at the walls over power emitted.
Check check_arrivals(const std::string& name, const Scene& scene, double reflectance, const Effort& effort) {
  const auto strategy = make_distance_strategy({});
  const auto samples =
      sample_moments(1, effort.count(20'000, 4'000'000), effort.seed_of("cavity, " + name), [&](Rng& rng, double* out) {
        const Emission emission = emit(scene.lights[0], scene.bounds, rng);
        WalkCounters counters;
        const auto see = [&](const Event& event, const PathState&, const PathState& now) {
          if (event.kind == EventKind::surface) out[0] += now.throughput.g;
          return true;
        };
        follow({scene, *strategy, counters}, {emission.ray, kVacuum, emission.power}, rng, PhotonVisitor{see});
      });
  return check_mean(name, samples[0], 1.0 / (1.0 - reflectance));
}

/// The irradiance of a sphere's wall with the light at its center, by the surface map.
Check check_wall(float radius, float reflectance, const Effort& effort) {
  const Scene scene = cavity(SphereShape{Vec3(0.0f), radius}, reflectance, Vec3(0.0f));
  const auto strategy = make_distance_strategy({});
  const GatherSettings gather{GatherMode::radius, 0.4f * radius, 0, KernelKind::epanechnikov};
  const std::string name = fmt::format("sphere, reflectance {:.1g}, irradiance by the surface map", reflectance);
  const auto samples =
      sample_moments(1, effort.count(2'000, 200'000), effort.seed_of(name), [&](Rng& rng, double* out) {
        PhotonLists photons = small_pass(scene, *strategy, rng);
        const PhotonMap map = make_photon_map(std::move(photons.surface), gather, photons.ledger.emitted_count);
        const Vec3 outward = glm::normalize(Vec3(0.6f, -0.5f, 0.3f));
        out[0] = surface_irradiance(radius * outward, -outward, map).value.g;
      });
  const double ratio = double{gather.radius} / radius, left_out = reflectance * kCapLoss * ratio * ratio;
  return check_mean(name, samples[0], (1.0 - left_out) / (1.0 - double{reflectance}) / (4.0 * kPiD * radius * radius));
}

std::vector<Check> check_cavities(const Effort& effort) {
  const Scene sphere = cavity(SphereShape{Vec3(0.0f), 1.5f}, 0.8f, Vec3(0.3f, -0.2f, 0.9f));
  const Scene box = cavity(field_box(), 0.5f, field_point({1.0, 2.0, -3.0}));
  return {check_arrivals("sphere, reflectance 0.8, arrivals over emitted", sphere, double{0.8f}, effort),
          check_arrivals("box, reflectance 0.5, arrivals over emitted", box, 0.5, effort),
          check_wall(1.5f, 0.5f, effort), check_wall(1.5f, 0.8f, effort)};
}

}  // namespace

std::vector<Experiment> balance_experiments() {
  return {{1, "balance of power: reflected, transmitted, absorbed over sent", check_flows},
          {1, "closed cavities: 1/(1 - reflectance)", check_cavities}};
}

}  // namespace vpm
