// The settings of [distance] and [transmittance]: how photons and paths fly, and how shadow rays are attenuated.
#include "vpm/job/declare.h"

namespace vpm {
namespace {

/// A step of a march, voxels: shorter ones would never come to an end.
constexpr Range kVoxels{1e-3, kNoLimit, false, true};

/// Photons are many and fly far: what a flight costs is most of their time, and null collisions cost less of it than
/// cells. Of paths and techniques combined most of the time is elsewhere (papers/distance-sampling.md).
SettingValue usual_strategy(const RenderSettings& s) {
  return s.integrator == Integrator::photon ? "delta-local" : RenderSettings{}.distance.strategy;
}

}  // namespace

std::vector<Setting> flight_settings() {
  using S = RenderSettings;
  using D = DistanceSettings;
  using T = TransmittanceSettings;
  return {
      {.key = "distance.strategy",
       .member = at<&S::distance, &D::strategy>(),
       .domain = names_of(distance_strategies()),
       .meaning = "how photons and paths fly; [papers/distance-strategies.md](../papers/distance-strategies.md) tells "
                  "what each is and how it fails. `\"homogeneous\"` is refused in grids, `\"weighted\"` for photons "
                  "(`integrator = \"path\"` alone)",
       .default_text = "`\"delta-local\"` for `integrator = \"photon\"`, else `\"regular\"`",
       .automatic = true,
       .decided_by = {.value = &usual_strategy, .chosen_with = "render.integrator"}},
      {.key = "distance.step",
       .member = at<&S::distance, &D::step>(),
       .domain = Numbers{kVoxels},
       .meaning = "ray-march: length of a step; ray-march-adaptive: of the longest one",
       .unit = "voxels"},
      {.key = "distance.optical_step",
       .member = at<&S::distance, &D::optical_step>(),
       .domain = Numbers{{1e-4, kNoLimit, false, true}},
       .meaning = "ray-march-adaptive: optical thickness of a step under the largest density around; steps are not "
                  "below a sixteenth of `step`"},
      {.key = "distance.extinction_floor",
       .member = at<&S::distance, &D::extinction_floor>(),
       .domain = Numbers{kPositive},
       .meaning = "local-extinction: least rate as a fraction of the mean one"},
      {.key = "distance.majorant",
       .member = at<&S::distance, &D::majorant>(),
       .domain = Numbers{{1e-6, 1.0, false, false}},
       .meaning =
           "progressive-null: in the first pass densities above this fraction of the medium's largest are cut to "
           "it; it doubles with every pass, so that the mean over passes converges; weighted: above this "
           "fraction, the same in all passes, weights make up for it"},
      {.key = "transmittance.estimator",
       .member = at<&S::transmittance, &T::estimator>(),
       .domain = names_of(transmittance_estimators()),
       .meaning = "towards lights: `\"regular\"` is exact, `\"ray-march\"` and `\"jackknife\"` are biased, the others "
                  "noisy and right on average; others than `\"regular\"` are refused where no shadow ray is cast: "
                  "[papers/transmittance.md](../papers/transmittance.md)"},
      {.key = "transmittance.step",
       .member = at<&S::transmittance, &T::step>(),
       .domain = Numbers{kVoxels},
       .meaning = "ray-march and jackknife: length of a step",
       .unit = "voxels"},
      {.key = "transmittance.samples",
       .member = at<&S::transmittance, &T::samples>(),
       .domain = Numbers{{1e-3, 1e6, false, false}},
       .meaning = "unbiased-ray-march: samples of a march over those of the paper"},
  };
}

}  // namespace vpm
