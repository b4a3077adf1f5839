// The medium a path is in: known at every step from the boundaries it has crossed. What the next shape says can correct
// it, so that errors do no harm to pictures; here only rays that graze may need one.
#include "vpm/medium/make_grid.h"
#include "vpm/render/path_tracer.h"
#include "vpm/render/photon_pass.h"
#include "vpm/scene/build.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

/// Rays that graze a sphere may find one of its two crossings only: where they pass it by no more than the rounding of
/// their points, d = 2.4e-7 m of the 2 m here, which 2 d / R = 1e-6 of those do that meet the ball of R = 0.5 m.
constexpr double kGrazing = 1e-6;
/// More corrections than grazing explains in one run of 100,000: above the mean of a Poisson distribution by five
/// standard deviations and five.
double most_corrections(uint64_t crossings) {
  const double mean = kGrazing * static_cast<double>(crossings);
  return mean + 5.0 * std::sqrt(mean) + 5.0;
}

/// Fog in a sphere, with a light and the camera in it, and a ball of glass full of milk. Edges are where rounding may
/// call for more corrections: there are none.
Scene nested_media() {
  Scene scene;
  scene.media = {make_medium(nullptr, Rgb(0.7f), 0.8f), make_medium(nullptr, Rgb(3.0f), 0.95f)};
  const Interface fog{0, kVacuum}, milk{1, 0};
  add_shape(scene, SphereShape{Vec3(0.0f), 2.0f}, Boundary{}, &fog);
  add_shape(scene, SphereShape{Vec3(0.4f, 0.1f, 0.0f), 0.5f}, Dielectric{1.4f}, &milk);
  add_shape(scene, SphereShape{Vec3(3.0f, 0.0f, -1.0f), 0.6f}, Mirror{Rgb(0.9f)});
  scene.lights = {PointLight{Vec3(-0.6f, 0.7f, 0.3f), Rgb(1.0f)}, PointLight{Vec3(0.3f, 3.0f, 0.5f), Rgb(2.0f)}};
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 1.8f), Vec3(0.4f, 0.0f, 0.0f), Vec3(0, 1, 0), 60.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  scene.camera_medium = medium_at(scene, scene.camera.position);
  return scene;
}

std::vector<Check> check_media(const Effort& effort) {
  const Scene scene = nested_media();
  RenderSettings settings;
  settings.seed = effort.seed_of("nested media");
  settings.photons_emitted = effort.count(20'000, 1'000'000);
  settings.samples_per_pixel = static_cast<int>(effort.count(20, 1000));
  settings.volume.radius = 0.1f;
  settings.volume_direct = DirectLight::shadow_rays;
  const RenderStatistics photons = render_photon_pass(scene, settings, 0).statistics;
  const RenderStatistics paths = render_path_pass(scene, settings, 0).statistics;
  const auto corrections = [](std::string name, const WalkCounters& walk) {
    return check_bound(std::move(name), static_cast<double>(walk.medium_mismatches), 0.0,
                       most_corrections(walk.crossings));
  };
  return {corrections("corrections, photons", photons.ledger.walk),
          corrections("corrections, rays that gather", photons.eye.walk),
          corrections("corrections, paths", paths.eye.walk)};
}

}  // namespace

std::vector<Experiment> medium_experiments() { return {{1, "nested media: which one a path is in", check_media}}; }

}  // namespace vpm
