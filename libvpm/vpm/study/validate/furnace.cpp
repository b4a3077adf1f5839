// The white furnace: where nothing absorbs and radiance 1 comes from everywhere, the radiance is 1 everywhere, whatever
// scatters. By paths from the eye, and by photons through the volume map: fluence 4 pi, and phase-weighted sums that
// give the radiance 1 back.
#include <fmt/format.h>
#include <algorithm>

#include "vpm/base/warp.h"
#include "vpm/estimate/surface_region.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/estimate/volume_region.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/fields.h"
#include "vpm/study/validate/scenes/lit_body.h"
#include "vpm/study/validate/scenes/small_pass.h"

namespace vpm {

namespace {

/// Radiance along rays from a point inside, into random directions.
Check check_radiance(const std::string& name, const Scene& scene, const Vec3& eye, const StrategyInfo& strategy,
                     const Effort& effort) {
  const uint64_t tight = strategy.bounded_weight ? 700'000 : 1'700'000;
  RenderSettings settings;
  settings.distance = careful_settings(strategy.name);
  const PathContext context = make_path_context(scene, settings);
  const MediumId medium = medium_at(scene, eye);
  const auto samples =
      sample_moments(1, effort.count(20'000, tight), effort.seed_of("radiance, " + name), [&](Rng& rng, double* out) {
        EyeCounters counters;
        out[0] = path_radiance(context, {eye, uniform_sphere(rng.uniform2())}, medium, rng, counters).g;
      });
  return check_weighted_mean(name, samples[0], 1.0);
}

/// A ball of glass, seen from within: there radiance is ior^2, along every ray. Near the middle of a ball none is
/// totally reflected, and caught.
std::vector<Check> check_inside_glass(const Effort& effort) {
  constexpr float kIor = 1.5f;
  Scene scene;
  add_shape(scene, SphereShape{Vec3(0.3f, -0.2f, 0.5f), 1.0f}, Dielectric{kIor});
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.5f, 0.0f, 0.4f), Vec3(0.0f), Vec3(0, 1, 0), 100.0f, {16, 16});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.seed = effort.seed_of("inside glass");
  const auto check = [&](std::string name, const Image& image) {
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels) sum += pixel.g;
    return check_bound(std::move(name), sum / 256.0, double{kIor} * kIor, 1e-4);
  };
  return {check("inside a ball of glass, by paths", render_path_pass(scene, settings, 0).image),
          check("inside a ball of glass, by rays that gather", render_photon_pass(scene, settings, 0).image)};
}

std::vector<Check> check_radiances(const Effort& effort) {
  const StrategyInfo &regular = strategy_info("regular"), &homogeneous = strategy_info("homogeneous");
  const auto fields = test_fields();
  const Rgb sigma_t(1.5f);
  const Vec3 eye = field_point({0.5, -1.5, -2.5});
  std::vector<Check> checks;
  for (const auto& [name, phase] : {std::pair<const char*, Phase>("isotropic", Isotropic{}),
                                    {"Rayleigh", Rayleigh{}},
                                    {"g = 0.9", HenyeyGreenstein{0.9f}},
                                    {"g = -0.6", HenyeyGreenstein{-0.6f}}}) {
    const LitBody body = lit_box("", white_medium(nullptr, sigma_t, phase));
    checks.push_back(check_radiance(fmt::format("homogeneous, {}", name), body.scene, eye, homogeneous, effort));
  }
  for (const TestField& field : fields)
    for (const StrategyInfo& info : distance_strategies()) {
      if (!info.heterogeneous || !info.unbiased) continue;
      // Weights without bound, from event to event across empty layers: their variance is beyond any number of samples.
      if (!info.bounded_weight && field.name == "sparse grid") continue;
      const LitBody body =
          lit_box("", white_medium(field.grid, tested_extinction(info, *field.grid), HenyeyGreenstein{0.5f}));
      checks.push_back(check_radiance(fmt::format("{}, {}", field.name, info.name), body.scene, eye, info, effort));
    }
  const Scene furnished = furnished_box(white_medium(fields[5].grid, sigma_t, HenyeyGreenstein{0.5f}));
  checks.push_back(check_radiance("white surfaces in a random grid", furnished, eye, regular, effort));
  append(checks, check_inside_glass(effort));
  const Scene room = glowing_room(white_medium(nullptr, sigma_t, HenyeyGreenstein{0.5f}));
  checks.push_back(check_radiance("a room of glowing walls", room, Vec3(0.4f, -0.2f, 0.1f), homogeneous, effort));
  const Scene mesh = glowing_mesh(white_medium(nullptr, sigma_t, HenyeyGreenstein{0.5f}));
  checks.push_back(
      check_radiance("a glowing mesh in its own light", mesh, Vec3(0.4f, -0.2f, 0.1f), homogeneous, effort));
  return checks;
}

/// Photon maps of few photons each, many times: their means are those of one large map, and their errors known.
std::vector<Check> check_map(const LitBody& body, const Vec3& inside, std::string_view strategy_name, VolumeForm form,
                             const Effort& effort) {
  const Medium& medium = body.scene.media[0];
  const auto strategy = make_distance_strategy(careful_settings(strategy_name));
  const std::string name = fmt::format("{}, {}", body.name, strategy_name);
  const GatherSettings gather{GatherMode::radius, 0.6f, 0, KernelKind::epanechnikov};
  ListSettings few;
  few.emitted = 100;
  few.volume_form = form;
  few.density_floor = strategy_info(strategy_name).bounded_weight ? 0.3f : 0.0f;
  const auto samples =
      sample_moments(2, effort.count(2'400, 30'000), effort.seed_of("map, " + name), [&](Rng& rng, double* out) {
        ListSettings settings = few;
        settings.seed = rng.bits();
        PhotonLists photons = list_photons(body.scene, *strategy, settings);
        const PhotonMap map = make_photon_map(std::move(photons.volume[0]), gather, photons.ledger.emitted_count);
        out[0] = fluence(medium.majorant(), inside, map).g;
        out[1] = volume_sum(medium.phase, inside, uniform_sphere(rng.uniform2()), map).value.g / medium.majorant().g;
      });
  return {check_weighted_mean(name + ", fluence", samples[0], 4.0 * kPiD * body.radiance),
          check_weighted_mean(name + ", radiance scattered", samples[1], body.radiance)};
}

std::vector<Check> check_maps(const Effort& effort) {
  const auto fields = test_fields();
  const Rgb sigma_t(1.5f);
  const HenyeyGreenstein phase{0.5f};
  std::vector<Check> checks;
  const LitBody sphere = lit_sphere("sphere", white_medium(nullptr, sigma_t, phase));
  const Vec3 off_center(0.5f, -0.3f, 0.4f);
  append(checks, check_map(sphere, off_center, "homogeneous", VolumeForm::density_at_query, effort));
  const LitBody glass = lit_glass("sphere behind glass", white_medium(nullptr, sigma_t, phase), 1.5f);
  append(checks, check_map(glass, off_center, "homogeneous", VolumeForm::density_at_query, effort));
  const LitBody again = lit_sphere("sphere, density at the photon", white_medium(nullptr, sigma_t, phase));
  append(checks, check_map(again, off_center, "homogeneous", VolumeForm::density_at_photon, effort));
  const LitBody room{"a room of glowing walls", glowing_room(white_medium(nullptr, sigma_t, phase))};
  append(checks, check_map(room, Vec3(0.6f, 0.0f, 0.0f), "homogeneous", VolumeForm::density_at_query, effort));
  const LitBody mesh{"a glowing mesh", glowing_mesh(white_medium(nullptr, sigma_t, phase))};
  append(checks, check_map(mesh, Vec3(0.85f, 0.2f, 0.0f), "homogeneous", VolumeForm::density_at_query, effort));
  for (const size_t i : {size_t{1}, size_t{2}, size_t{5}})
    for (const StrategyInfo& strategy : distance_strategies())
      if (strategy.heterogeneous && strategy.positive)
        append(checks, check_map(lit_box(fields[i].name, white_medium(fields[i].grid, sigma_t, phase)),
                                 field_point({0.5, 0.2, 0.5}), strategy.name, VolumeForm::density_at_query, effort));
  return checks;
}

/// How far shares of kernels may be off, over the shares.
constexpr double kShareError = 0.02;

/// The volume map where the medium ends, corrected.
std::vector<Check> check_border_of_medium(const LitBody& body, const Vec3& point, const Effort& effort) {
  const Medium& medium = body.scene.media[0];
  const auto strategy = make_distance_strategy({});
  const GatherSettings gather{GatherMode::radius, 0.6f, 0, KernelKind::epanechnikov};
  const VolumeRegion region(body.scene, 0, point, gather.kernel);
  const auto samples = sample_moments(
      2, effort.count(3'000, 40'000), effort.seed_of("border, " + body.name), [&](Rng& rng, double* out) {
        PhotonLists photons = small_pass(body.scene, *strategy, rng);
        const PhotonMap map = make_photon_map(std::move(photons.volume[0]), gather, photons.ledger.emitted_count);
        GatherCounters counters;
        Neighbours near;
        const BoundedMap bounded{map, region, GatherWork{counters, near}};
        out[0] = fluence(medium.majorant(), point, bounded).g;
        out[1] = volume_sum(medium.phase, point, uniform_sphere(rng.uniform2()), bounded).value.g / medium.majorant().g;
      });
  const double fluence = 4.0 * kPiD * body.radiance;
  return {check_within(body.name + ", fluence", samples[0], fluence, kShareError * fluence),
          check_within(body.name + ", radiance scattered", samples[1], body.radiance, kShareError * body.radiance)};
}

/// What a white sheet sends out by its map, in its middle, at its edge and at its corner, corrected.
std::vector<Check> check_sheet(const Effort& effort) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1, 0.2, 1), Vec3d(2, 0, 0), Vec3d(0, 0, -2)), Lambertian{Rgb(1.0f)});
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const auto strategy = make_distance_strategy({});
  const GatherSettings gather{GatherMode::radius, 0.5f, 0, KernelKind::epanechnikov};
  const Vec3 up(0.0f, 1.0f, 0.0f);
  std::vector<Check> checks;
  for (const auto& [name, x, z] : {std::tuple("a white sheet, its middle", 0.1f, 0.0f),
                                   {"a white sheet, its edge", 0.9999f, 0.0f},
                                   {"a white sheet, its corner", -0.9999f, 0.9999f}}) {
    const Hit hit = scene.geometry.intersect({Vec3(x, 1.0f, z), -up}).value();
    const SurfaceRegion region(scene, hit, up, gather);
    const auto samples =
        sample_moments(1, effort.count(4'000, 100'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          const PhotonLists photons = small_pass(scene, *strategy, rng);
          const PhotonMap map = make_photon_map(photons.surface, gather, photons.ledger.emitted_count);
          GatherCounters counters;
          Neighbours near;
          out[0] =
              scattered_radiance(Lambertian{Rgb(1.0f)}, hit, up, BoundedMap{map, region, GatherWork{counters, near}})
                  .value.g;
        });
    checks.push_back(region.share(gather.radius).inside < 1.0f ? check_within(name, samples[0], 1.0, kShareError)
                                                               : check_mean(name, samples[0], 1.0));
  }
  return checks;
}

/// The picture of a white medium in the box of the fields, gathered from a large radius up to where it ends.
std::vector<Check> check_picture(const std::string& name, Scene scene, const VolumeSettings& gather, double bound,
                                 const Effort& effort, uint64_t passes = 24) {
  scene.camera = make_camera(field_point({20, 17, 25}), field_point(Vec3d(0.0)), Vec3(0, 1, 0), 14.0f, {8, 8});
  RenderSettings settings;
  settings.seed = effort.seed_of(name);
  settings.photons.emitted = 10'000;
  settings.radii = RadiusSchedule::constant;
  settings.volume = gather;
  settings.surface.radius = 0.05f;
  Moments means;
  uint64_t least_shares = 0;
  for (int pass = 0; pass < static_cast<int>(effort.count(passes, 400)); ++pass) {
    const Pass found = render_photon_pass(scene, settings, pass);
    means.add(channel_means(found.image).g);
    least_shares += found.statistics.eye.gather.least_shares;
  }
  return {check_within(name, means, 1.0, bound),
          check_bound(name + ", least shares", static_cast<double>(least_shares), 0.0, 0.0)};
}

/// In the corners of the box there is nothing around a ball of voxels.
Medium ball_of_voxels() {
  const GridFrame& voxels = test_fields()[2].grid->frame();
  return white_medium(make_grid(voxels,
                                [](int x, int y, int z) {
                                  return glm::length(Vec3d(x, y, z)) > 6.0 ? 0.0 : (x + y + z) & 1 ? 1.4 : 1.0;
                                }),
                      Rgb(1.5f), Isotropic{});
}

/// Fills the box, without a place of no density.
Medium box_of_voxels() {
  const GridFrame& voxels = test_fields()[2].grid->frame();
  return white_medium(make_grid(voxels, [](int x, int y, int z) { return (x + y + z) & 1 ? 1.4 : 1.0; }), Rgb(1.5f),
                      HenyeyGreenstein{0.5f});
}

std::vector<Check> check_borders(const Effort& effort) {
  struct NamedSpread {
    const char* name;
    std::string_view type;
    uint64_t passes = 24;
  };
  const NamedSpread spreads[] = {{"balls", "radius"},
                                 {"discs", "beam"},
                                 {"photon beams", "photon-beams"},
                                 {"photon beams around points", "beams-points", 96}};
  const Medium white = white_medium(nullptr, Rgb(1.5f), HenyeyGreenstein{0.5f});
  const Vec3 center(0.3f, -0.2f, 0.5f);  // of the sphere
  std::vector<Check> checks =
      check_border_of_medium(lit_sphere("the border of a sphere", white), center + Vec3(0.0f, 0.9999f, 0.0f), effort);
  append(checks, check_border_of_medium(lit_box("a face of a box", white), field_point({6.999, 0.1, 0.3}), effort));
  append(checks,
         check_border_of_medium(lit_box("near a corner of a box", white), field_point({6.4, 6.2, -6.5}), effort));
  append(checks, check_sheet(effort));
  const VolumeSettings each_ball("radius", {.radius = 0.6f, .boundary = BoundaryRule::corrected});
  const auto box_of = [](const Medium& medium) { return lit_box("", medium).scene; };
  append(checks, check_picture("picture of a box", box_of(white), each_ball, 0.005, effort));
  append(checks,
         check_picture("picture of a ball of voxels", box_of(ball_of_voxels()),
                       VolumeSettings("radius", {.radius = 0.4f, .boundary = BoundaryRule::corrected}), 0.01, effort));
  for (const auto& [name, type, passes] : spreads)
    append(checks, check_picture(fmt::format("picture of a box, {} past ends of segments", name), box_of(white),
                                 VolumeSettings(type, {.radius = 0.6f, .boundary = BoundaryRule::ends}), 0.005, effort,
                                 passes));
  append(checks,
         check_picture("picture of balls in a box, discs past ends of segments", box_around_balls(white),
                       VolumeSettings("beam", {.radius = 0.4f, .boundary = BoundaryRule::ends}), 0.005, effort, 100));
  append(checks,
         check_picture("picture of a ball of voxels, discs", box_of(ball_of_voxels()),
                       VolumeSettings("beam", {.radius = 0.4f, .boundary = BoundaryRule::corrected}), 0.01, effort));
  append(checks,
         check_picture("picture of a ball of voxels, nearest photons", box_of(ball_of_voxels()),
                       VolumeSettings("nearest", {.radius = 0.6f, .count = 100, .boundary = BoundaryRule::ends}), 0.01,
                       effort));
  const Medium voxels = box_of_voxels();
  for (const auto& [name, type, passes] : spreads)
    append(checks, check_picture(fmt::format("picture of a box of voxels, {} past ends of segments", name),
                                 box_of(voxels), VolumeSettings(type, {.radius = 0.6f, .boundary = BoundaryRule::ends}),
                                 0.005, effort, passes));
  return checks;
}

/// The combined estimator, from a camera inside: each set of techniques finds all light. Kernels are small, so that
/// little light is missing at surfaces.
std::vector<Check> check_combined(const Effort& effort) {
  using T = Technique;
  const Medium grid = white_medium(test_fields()[5].grid, Rgb(1.5f), HenyeyGreenstein{0.5f});
  const Medium even = white_medium(nullptr, Rgb(1.5f), HenyeyGreenstein{0.5f});
  const std::pair<const char*, std::vector<T>> sets[] = {
      {"connections", {T::connections}},
      {"connections and light tracing", {T::connections, T::light_tracing}},
      {"connections and points in balls", {T::connections, T::points_3d}},
      {"connections and points beside rays", {T::connections, T::points_2d}},
      {"connections and beams", {T::connections, T::short_beams}}};
  std::vector<Check> checks;
  for (const auto& [where, make] :
       {std::pair("white surfaces in a random grid", &furnished_box), {"a room of glowing walls", &glowing_room}}) {
    const bool room = make == &glowing_room;
    Scene scene = make(room ? even : grid);
    const Vec3 eye = room ? Vec3(0.4f, -0.2f, 0.1f) : field_point({0.5, -1.5, -2.5});
    scene.camera = make_camera(eye, eye + Vec3(0.3f, 0.2f, -1.0f), Vec3(0, 1, 0), 60.0f, {4, 4});
    scene.camera_medium = medium_at(scene, eye);
    for (const auto& [name, techniques] : sets) {
      RenderSettings settings;
      settings.integrator = Integrator::combined;
      for (const TechniqueInfo& info : kTechniques)
        settings.combined.techniques.set(
            info.technique, std::find(techniques.begin(), techniques.end(), info.technique) != techniques.end());
      settings.photons.emitted = 500;
      settings.samples_per_pixel = 4;
      settings.radii = RadiusSchedule::constant;
      settings.volume.radius = settings.surface.radius = 0.02f;
      const std::string full = fmt::format("combined, {}, {}", where, name);
      settings.seed = effort.seed_of(full);
      Moments means;
      for (int pass = 0; pass < static_cast<int>(effort.count(100, 4'000)); ++pass)
        means.add(channel_means(render_combined_pass(scene, settings, pass).image).g);
      checks.push_back(check_within(full, means, 1.0, 0.005));
    }
  }
  return checks;
}

}  // namespace

std::vector<Experiment> furnace_experiments() {
  return {{1, "white furnace: radiance by paths from the eye", check_radiances},
          {1, "white furnace: photon maps", check_maps},
          {1, "white furnace: photon maps at borders, corrected", check_borders},
          {1, "white furnace: techniques combined", check_combined}};
}

}  // namespace vpm
