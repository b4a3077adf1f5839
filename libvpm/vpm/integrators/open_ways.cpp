// Each integrator names its own; its check says which contradict the rest.
#include "vpm/integrators/open_ways.h"

#include <fmt/format.h>
#include <array>

#include "vpm/base/settings/setting_error.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/integrators/words.h"

namespace vpm {

OpenWays open_ways(const Scene& scene, const AutomaticSettings& automatic, const RenderSettings& settings) {
  constexpr std::array kIntegrators{Integrator::photon, Integrator::combined, Integrator::path};
  OpenWays open;
  for (const Integrator integrator : kIntegrators) {
    std::string last;  // several ways of an integrator have the same fault
    if (!automatic.has("integrator.type") && integrator != settings.integrator) continue;
    Way given{word_of(integrator), settings};
    given.settings.integrator = integrator;
    const auto ways = info_of(integrator).ways;
    for (Way& way : ways ? ways(scene, automatic, given) : std::vector<Way>{given}) {
      try {
        validate(way.settings, facts_of(scene));
        open.ways.push_back(std::move(way));
      } catch (const SettingError& error) {
        if (error.wrong() != last) open.refused += fmt::format("; not {}: {}", way.name, error.wrong());
        last = error.wrong();
      }
    }
  }
  return open;
}

}  // namespace vpm
