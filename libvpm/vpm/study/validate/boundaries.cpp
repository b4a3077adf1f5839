// Paths across boundaries: both sides of smooth glass, and the medium that a path is in.
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/surface/material/fresnel.h"

namespace vpm {

// Level 0: an eye path that follows both sides of smooth glass. Two panes reflect R each, and what the medium sends
// along a segment is 1 where the path travels away from the eye. The light that the eye sees is then the sum of a
// geometric series.
namespace {

constexpr float kPaneIor = 1.5f;

/// What media send along each segment of a path that travels against the z axis.
class EvenGlow final : public VolumeEstimator {
 public:
  ScatteredLight finds() const override { return {}; }
  KernelEstimate along(const EyeSegment& segment, EyeWork&) const override {
    return segment.ray.direction.z < 0.0f ? segment.throughput : Rgb(0.0f);
  }
};

TriangleMesh square(double z) { return quad_mesh(Vec3d(-1, -1, z), Vec3d(2, 0, 0), Vec3d(0, 2, 0)); }

Scene two_panes() {
  Scene scene;
  for (const double z : {0.0, -1.0}) add_shape(scene, square(z), ThinDielectric{kPaneIor});
  return scene;
}

/// What a pane reflects straight back: R.
double pane_reflectance() {
  const double face = fresnel_dielectric(1.0f, kPaneIor);
  return 2.0 * face / (1.0 + face);
}

const Ray kThroughPanes{Vec3(0.1f, 0.2f, 1.0f), Vec3(0, 0, -1)};

/// 1 before the panes; of the fraction 1 - R that enters, D = 1 + (1 - R) + R^2 D between and behind them.
std::vector<Check> check_panes(const Effort& effort) {
  Scene scene = two_panes();
  scene.geometry.commit();
  finish(scene);
  Estimators estimators;
  estimators.volume.push_back(std::make_unique<EvenGlow>());
  const auto samples =
      sample_moments(1, effort.count(20'000, 400'000), effort.seed_of("panes"), [&](Rng& rng, double* out) {
        EyeScratch scratch;
        EyeCounters counters;
        EyeWork work{rng, counters, scratch};
        out[0] = eye_radiance({scene, estimators}, kThroughPanes, work).value.g;
      });
  const double r = pane_reflectance();
  return {check_mean("two panes", samples[0], 1.0 + (1.0 - r) * (2.0 - r) / (1.0 - r * r))};
}

/// A dark wall behind the panes, lit by a point 1 m before it, that shadow rays find: of its radiance I rho / pi the
/// panes let (1 - R)^2 / (1 - R^2) pass. The wall reflects so little that the light it sends back to itself over the
/// panes is less than 1e-4 of that.
std::vector<Check> check_combined_panes(const Effort& effort) {
  constexpr float kReflectance = 1e-3f;
  Scene scene = two_panes();
  add_shape(scene, square(-3.0), Lambertian{Rgb(kReflectance)});
  scene.lights.push_back(PointLight{Vec3(0.1f, 0.2f, -2.0f), Rgb(1.0f)});
  scene.camera =
      make_camera(kThroughPanes.origin, kThroughPanes.origin + kThroughPanes.direction, Vec3(0, 1, 0), 1.0f, {1, 1});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  settings.photons.emitted = 1;
  settings.surface.radius = settings.volume.radius = 0.01f;
  for (const TechniqueInfo& info : kTechniques)
    settings.combined.techniques.set(info.technique, info.technique == Technique::connections);
  const CombinedPass pass(scene, settings, 0);
  const auto samples =
      sample_moments(1, effort.count(40'000, 800'000), effort.seed_of("panes, combined"), [&](Rng& rng, double* out) {
        EyeScratch scratch;
        EyeCounters counters;
        EyeWork work{rng, counters, scratch};
        out[0] = pass.radiance(kThroughPanes, work).value.g * double{kPi} / double{kReflectance};
      });
  const double r = pane_reflectance();
  return {check_mean("two panes", samples[0], (1.0 - r) * (1.0 - r) / (1.0 - r * r), 1e-4)};
}

}  // namespace

std::vector<Experiment> pane_experiments() {
  return {{0, "eye paths through panes of glass", check_panes},
          {0, "panes of glass before what techniques find together", check_combined_panes}};
}

// The medium a path is in: known at every step from the boundaries it has crossed. What the next shape says can correct
// it, so that errors do no harm to pictures; here only rays that graze may need one.
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
  settings.photons.emitted = effort.count(20'000, 1'000'000);
  settings.samples_per_pixel = static_cast<int>(effort.count(20, 1000));
  settings.volume.radius = 0.1f;
  settings.single_scattering.type = DirectLight::shadow_rays;
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
