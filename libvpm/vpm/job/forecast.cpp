// Estimates by what a pilot's photons and rays cost.
#include "vpm/job/forecast.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/job/automatic.h"

namespace vpm {
namespace {

constexpr uint64_t kSafePhotons = 10'000'000;  // that fit everywhere, unless each is stored hundreds of times
constexpr double kMapBytes = 64.0;       // a stored photon takes while maps are built (62 in scenes/street_lamp.toml)
constexpr double kMostIndexed = 0x1p32;  // photons of a map: their numbers have 32 bits

}  // namespace

double longest_time(double seconds) { return 1.3 * seconds + 1.0; }

std::string too_long_text(const PassCost& cost, const RenderSettings& settings) {
  const double photons = photons_of_pass(settings, cost.stored_per_photon), seconds = settings.until.seconds;
  const double pass = cost.eye + photons * cost.photon;
  if (pass <= longest_time(seconds)) return "";
  const std::string text =
      fmt::format("one pass takes about {:.2g} s, longer than the {:g} s asked for: ", pass, seconds);
  const double fit = cost.photon > 0.0 ? (seconds - cost.eye) / cost.photon : 0.0;
  if (fit >= static_cast<double>(kLeastCount)) return text + fmt::format("about {:.2g} photons.emitted would fit", fit);
  return text +
         fmt::format("the eye's rays alone take {:.2g} s; fewer pixels or samples_per_pixel take less", cost.eye);
}

void check_memory(const Scene& scene, const RenderSettings& settings, double memory) {
  if (settings.integrator == Integrator::path) return;
  if (settings.photons_emitted <= kSafePhotons && settings.photons_stored <= kSafePhotons) return;
  RenderSettings few = settings;
  few.photons_emitted = 10'000;
  const double each = time_pass(scene, few, 0.2).stored_per_photon, stored = each * photons_of_pass(settings, each);
  const double most = std::min(memory / kMapBytes, kMostIndexed);
  if (stored <= most) return;
  throw InputError(fmt::format(
      "photons.emitted: the maps of a pass would hold about {:.2g} photons and take {:.2g} GB of memory; this "
      "machine has {:.2g} GB, enough for photons.emitted = {:.1g}; more passes do what more photons would",
      stored, kMapBytes * stored * 1e-9, memory * 1e-9, 0.5 * most / each));
}

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace vpm
