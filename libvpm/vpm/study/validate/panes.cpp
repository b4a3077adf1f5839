// Level 0: an eye path that follows both sides of smooth glass. Two panes reflect R each, and what the medium sends
// along a segment is 1 where the path travels away from the eye. The light that the eye sees is then the sum of a
// geometric series.
#include "vpm/render/combined_pass.h"
#include "vpm/render/eye_path.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/surface/fresnel.h"

namespace vpm {
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
  settings.photons_emitted = 1;
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

}  // namespace vpm
