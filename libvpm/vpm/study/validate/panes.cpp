// Level 0: an eye path that follows both sides of smooth glass. Two panes reflect R each, and what the medium sends
// along a segment is 1 where the path travels away from the eye. The light that the eye sees is then the sum of a
// geometric series.
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

Scene two_panes() {
  Scene scene;
  for (const double z : {0.0, -1.0})
    add_shape(scene, quad_mesh(Vec3d(-1, -1, z), Vec3d(2, 0, 0), Vec3d(0, 2, 0)), ThinDielectric{kPaneIor});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// 1 before the panes; of the fraction 1 - R that enters, D = 1 + (1 - R) + R^2 D between and behind them.
std::vector<Check> check_panes(const Effort& effort) {
  const Scene scene = two_panes();
  Estimators estimators;
  estimators.volume.push_back(std::make_unique<EvenGlow>());
  const auto samples =
      sample_moments(1, effort.count(20'000, 400'000), effort.seed_of("panes"), [&](Rng& rng, double* out) {
        EyeScratch scratch;
        EyeCounters counters;
        EyeWork work{rng, counters, scratch};
        out[0] = eye_radiance({scene, estimators}, {Vec3(0.1f, 0.2f, 1.0f), Vec3(0, 0, -1)}, work).value.g;
      });
  const double face = fresnel_dielectric(1.0f, kPaneIor), r = 2.0 * face / (1.0 + face);
  return {check_mean("two panes", samples[0], 1.0 + (1.0 - r) * (2.0 - r) / (1.0 - r * r))};
}

}  // namespace

std::vector<Experiment> pane_experiments() { return {{0, "eye paths through panes of glass", check_panes}}; }

}  // namespace vpm
