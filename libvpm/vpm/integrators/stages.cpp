// Strategies and estimators with what their lists say of them.
#include "vpm/integrators/stages.h"

#include <fmt/format.h>

#include <span>

namespace vpm {
namespace {

/// A strategy or an estimator with what its list says of it: "regular (exact in any medium: ...)", "ray-march (biased;
/// ...)".
template <class Info>
std::string described(const std::string& name, std::span<const Info> infos) {
  for (const Info& info : infos)
    if (info.name == name) return fmt::format("{} ({}{})", name, info.unbiased ? "" : "biased; ", info.summary);
  return name;
}

}  // namespace

std::string distances_text(const RenderSettings& settings) {
  return ", distances by " + described(settings.distance.strategy, distance_strategies());
}

std::string transmittance_text(const RenderSettings& settings) {
  return ", transmittance by " + described(settings.transmittance.estimator, transmittance_estimators());
}

std::string channels_text(const Scene& scene) {
  return scene.grey ? "all coefficients are grey" : "coefficients differ between channels";
}

}  // namespace vpm
