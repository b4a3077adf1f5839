// A small pass with few photons says what either costs.
#include "vpm/integrators/default_photons.h"

#include <fmt/format.h>
#include <algorithm>

#include "vpm/base/counters.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/small_pass.h"

namespace vpm {

std::optional<Choice> choose_default_photons(const Scene& scene, const AutomaticSettings& automatic,
                                             RenderSettings& settings) {
  constexpr const char* kKey = "integrator.photons.emitted";
  constexpr double kPilot = 20'000.0, kFewest = 1000.0;  // photons
  if (!automatic.has(kKey) || settings.integrator == Integrator::path || !kCounts) return std::nullopt;
  RenderSettings few = settings;
  few.seed = ~few.seed;
  few.radii = RadiusSchedule::constant;
  few.photons.emitted = static_cast<uint64_t>(kPilot);
  few.caustics.emitted = std::min(few.caustics.emitted, few.photons.emitted);
  const SmallPass pass = render_small(scene, few, 0, WallClock());
  if (pass.photon_steps == 0) return std::nullopt;
  const double balanced = pass.eye_steps / static_cast<double>(pass.photon_steps) * pass.photons;
  const double most = std::max(kFewest, pass.most_photons());
  std::string reason = "as many rays and look-ups as from the eye";
  if (balanced < kFewest) reason = "the least; fewer have " + reason;
  if (balanced > most) reason = "maps of 1.3 GB, the most; more have " + reason;
  settings.photons.emitted = static_cast<uint64_t>(rounded(std::clamp(balanced, kFewest, most), 2));
  return Choice{kKey, fmt::format("{}", settings.photons.emitted), reason};
}

}  // namespace vpm
