// Pictures that must be the same, with all their bias: of a light and of two at its place that share its intensity; by
// densities at the query and at the photon where the density is the same everywhere; by caustic photons that are aimed
// and by those among all; by irradiance where gathering rays end, whose picture is known, and by that computed
// beforehand.
#include "vpm/base/parallel.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/estimates/irradiance.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/small_scenes.h"

namespace vpm {

namespace {

/// Where the light is. The square of what shadow rays from about a point light bring has no mean: they need it outside.
enum class LightPlace { in_fog, above_fog };

/// Fog of little albedo, so that light scattered once is most of what is seen, and a floor.
Scene lit_by(const std::vector<float>& shares, LightPlace place) {
  Scene scene;
  Medium fog = make_medium(nullptr, Rgb(0.6f), 0.3f);
  fog.phase = HenyeyGreenstein{0.5f};
  scene.media.push_back(fog);
  const Interface fog_inside{0, kVacuum};
  if (place == LightPlace::in_fog)
    scene.world_medium = 0;
  else
    add_shape(scene, box_mesh(Vec3d(-5, -2, -5), Vec3d(5, 0.8, 5)), Boundary{}, &fog_inside);
  add_shape(scene, quad_mesh(Vec3d(-4, -1, 4), Vec3d(8, 0, 0), Vec3d(0, 0, -8)), Lambertian{Rgb(0.3f)});
  for (const float share : shares) scene.lights.push_back(PointLight{Vec3(0.4f, 1.2f, 0.0f), Rgb(share)});
  scene.camera = make_camera(Vec3(0, 0.3f, 3), Vec3(0.0f), Vec3(0, 1, 0), 40.0f, {6, 6});
  scene.geometry.commit();
  finish(scene);
  scene.camera_medium = 0;
  return scene;
}

/// Mean radiance of the film in many passes.
Moments radiance(const Scene& scene, RenderSettings settings, size_t passes, const Effort& effort,
                 const std::string& name) {
  settings.seed = effort.seed_of(name);
  settings.radii = RadiusSchedule::constant;
  const auto render_pass = settings.integrator == Integrator::path ? render_path_pass : render_photon_pass;
  std::vector<double> means(passes);
  parallel_for_chunks(passes, 1, [&](size_t i, size_t, size_t) {
    const Image image = render_pass(scene, settings, static_cast<int>(i), {}).image;
    for (const Rgb& pixel : image.pixels) means[i] += pixel.g / static_cast<double>(image.pixels.size());
  });
  Moments all;
  for (const double mean : means) all.add(mean);
  return all;
}

/// A ball of glass over a floor, seen with a caustic so blurred that few photons are enough for its power.
Check check_caustics(const Effort& effort) {
  const Scene scene = lit_corner(1.5f);
  RenderSettings settings;
  settings.photons.emitted = 1000;
  settings.surface.radius = settings.caustics.radius = 0.4f;
  settings.indirect.type = IndirectLight::final_gather;
  settings.indirect.rays = 1;
  const size_t passes = effort.count(200, 4000);
  const Moments by_all = radiance(scene, settings, passes, effort, "caustics by all");
  settings.caustics.emitted = 400;  // another number, which their power depends on
  return check_same("caustics by photons that are aimed", radiance(scene, settings, passes, effort, "caustics aimed"),
                    by_all);
}

/// Final gathering in a hollow sphere with a light of 1 W at its center: irradiance is even, so that points where it
/// was computed beforehand blur nothing. The map where rays end misses kCapLoss of the light that was reflected before.
std::vector<Check> check_final_gathering(const Effort& effort) {
  constexpr float kRadius = 1.5f, kReflectance = 0.5f, kRatio = 0.15f;
  Scene scene;
  add_shape(scene, SphereShape{Vec3(0.0f), kRadius}, Lambertian{Rgb(kReflectance)});
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f / (4.0f * kPi))});
  scene.camera = make_camera(Vec3(0.3f, 0.2f, 0.1f), Vec3(0.6f, -0.5f, 0.3f), Vec3(0, 1, 0), 60.0f, {4, 4});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.photons.emitted = 500;
  settings.surface.radius = kRatio * kRadius;
  settings.indirect.type = IndirectLight::final_gather;
  settings.indirect.rays = 4;
  const size_t passes = effort.count(500, 20'000);
  const Moments at_ends = radiance(scene, settings, passes, effort, "irradiance at ends");
  settings.indirect.irradiance = EndIrradiance::precomputed;
  const double whole = kReflectance / kPiD / (1.0 - double{kReflectance}) / (4.0 * kPiD * kRadius * kRadius);
  const double left_out = double{kReflectance} * kReflectance * kCapLoss * kRatio * kRatio;
  return {check_mean("final gathering in a hollow sphere", at_ends, whole * (1.0 - left_out)),
          check_same("irradiance computed beforehand or where rays end",
                     radiance(scene, settings, passes, effort, "irradiance beforehand"), at_ends)};
}

std::vector<Check> check_pictures(const Effort& effort) {
  const std::vector<float> one{1.0f}, two{0.2f, 0.8f};
  const Scene whole = lit_by(one, LightPlace::in_fog), parts = lit_by(two, LightPlace::in_fog);
  const Scene below_one = lit_by(one, LightPlace::above_fog), below_two = lit_by(two, LightPlace::above_fog);
  RenderSettings photons;
  photons.photons.emitted = 1000;
  photons.volume.radius = photons.surface.radius = 0.4f;
  photons.direct.type = DirectLight::photons;
  RenderSettings at_photons = photons;
  at_photons.volume.form = VolumeForm::density_at_photon;
  RenderSettings shadow_rays = photons;
  shadow_rays.single_scattering.type = shadow_rays.direct.type = DirectLight::shadow_rays;
  shadow_rays.samples_per_pixel = 4;
  RenderSettings paths;
  paths.integrator = Integrator::path;
  paths.samples_per_pixel = 8;
  const size_t passes = effort.count(100, 4000);
  const auto find = [&](const char* name, const Scene& scene, const RenderSettings& settings) {
    return radiance(scene, settings, passes, effort, name);
  };
  const Moments by_photons = find("photons", whole, photons);
  std::vector<Check> checks{
      check_same("a light in two, photons", find("photons, two", parts, photons), by_photons),
      check_same("a light in two, shadow rays", find("shadow rays, two", below_two, shadow_rays),
                 find("shadow rays", below_one, shadow_rays)),
      check_same("a light in two, paths", find("paths, two", below_two, paths), find("paths", below_one, paths)),
      check_same("density at the photon or at the query", find("at photons", whole, at_photons), by_photons),
      check_caustics(effort)};
  append(checks, check_final_gathering(effort));
  return checks;
}

}  // namespace

std::vector<Experiment> picture_experiments() { return {{1, "the same picture in another way", check_pictures}}; }

}  // namespace vpm
