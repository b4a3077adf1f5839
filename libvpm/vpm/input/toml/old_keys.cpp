// The table of old keys, and what is said where a file has one.
#include "vpm/input/toml/old_keys.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>

namespace vpm {
namespace {

constexpr std::array kOldKeys{
    OldKey{"render.integrator", "integrator.type"},
    OldKey{"render.radii", "integrator.radii"},
    OldKey{"render.max_optical_step", "integrator.max_optical_step"},
    OldKey{"photons.stored", "integrator.photons.stored"},
    OldKey{"photons.emitted", "integrator.photons.emitted"},
    OldKey{"photons.block", "integrator.photons.block"},
    OldKey{"photons.sequence", "integrator.photons.sequence"},
    OldKey{"photons.in_cube", "integrator.photons.in_cube"},
    OldKey{"photons.flights", "integrator.volume.flights"},
    OldKey{"photons.planes", "integrator.volume.planes"},
    OldKey{"importance.importons", "integrator.importance.importons"},
    OldKey{"importance.aim", "integrator.importance.aim"},
    OldKey{"importance.split", "integrator.importance.split"},
    OldKey{"importance.scatter", "integrator.importance.scatter"},
    OldKey{"distance.strategy", "integrator.distance.type"},
    OldKey{"distance.step", "integrator.distance.step"},
    OldKey{"distance.optical_step", "integrator.distance.optical_step"},
    OldKey{"distance.extinction_floor", "integrator.distance.extinction_floor"},
    OldKey{"distance.majorant", "integrator.distance.majorant"},
    OldKey{"transmittance.estimator", "integrator.transmittance.type"},
    OldKey{"transmittance.step", "integrator.transmittance.step"},
    OldKey{"transmittance.samples", "integrator.transmittance.samples"},
    OldKey{"volume.gather", "integrator.volume.type"},
    OldKey{"volume.radius", "integrator.volume.radius"},
    OldKey{"volume.count", "integrator.volume.count"},
    OldKey{"volume.kernel", "integrator.volume.kernel"},
    OldKey{"volume.form", "integrator.volume.form"},
    OldKey{"volume.boundary", "integrator.volume.boundary"},
    OldKey{"volume.density_floor", "integrator.volume.density_floor"},
    OldKey{"volume.direct", "integrator.single_scattering.type"},
    OldKey{"volume.direct_samples", "integrator.single_scattering.samples"},
    OldKey{"volume.beams", "integrator.volume.length"},
    OldKey{"volume.planes", "integrator.volume.share"},
    OldKey{"surface.gather", "integrator.surface.type"},
    OldKey{"surface.radius", "integrator.surface.radius"},
    OldKey{"surface.count", "integrator.surface.count"},
    OldKey{"surface.kernel", "integrator.surface.kernel"},
    OldKey{"surface.boundary", "integrator.surface.boundary"},
    OldKey{"surface.method", "integrator.direct.type and integrator.indirect.type"},
    OldKey{"surface.direct", "integrator.direct.type"},
    OldKey{"surface.direct_samples", "integrator.direct.samples"},
    OldKey{"surface.indirect", "integrator.indirect.type"},
    OldKey{"surface.gather_rays", "integrator.indirect.rays"},
    OldKey{"surface.gather_by", "integrator.indirect.rays_by"},
    OldKey{"surface.irradiance", "integrator.indirect.irradiance"},
    OldKey{"caustics.gather", "integrator.caustics.type"},
    OldKey{"caustics.radius", "integrator.caustics.radius"},
    OldKey{"caustics.count", "integrator.caustics.count"},
    OldKey{"caustics.kernel", "integrator.caustics.kernel"},
    OldKey{"caustics.emitted", "integrator.caustics.emitted"},
    OldKey{"combined.techniques", "integrator.techniques"},
    OldKey{"combined.heuristic", "integrator.heuristic"},
    OldKey{"combined.layers", "integrator.layers"},
};

constexpr std::array kOldTables{"photons", "importance", "distance", "transmittance",
                                "volume",  "surface",    "caustics", "combined"};

/// Refuses an old key of a table.
void refuse_in(const std::string& table, const Node::Table& entries) {
  for (const Entry& entry : entries) {
    const std::string key = table + "." + entry.key;
    const auto found =
        std::find_if(kOldKeys.begin(), kOldKeys.end(), [&](const OldKey& old) { return old.old_key == key; });
    if (found != kOldKeys.end())
      fail_at(entry.place, fmt::format("'{}' of [{}] is {} now", entry.key, table, found->key),
              "'vpm upgrade FILE' rewrites all such keys of a file");
  }
}

}  // namespace

std::span<const OldKey> old_keys() { return kOldKeys; }

void refuse_old_keys(TableReader& root) {
  if (const Node* const render = root.find("render"); render && render->table()) refuse_in("render", *render->table());
  for (const char* const name : kOldTables) {
    const std::vector<std::string> keys = root.keys();
    if (std::find(keys.begin(), keys.end(), name) == keys.end()) continue;
    const Node& table = root.require(name);
    if (table.table()) refuse_in(name, *table.table());
    root.fail(name, fmt::format("there is no table [{}] any more: what it said stands in tables of [integrator]", name),
              "scenes/README.md lists them; 'vpm upgrade FILE' rewrites a file");
  }
}

}  // namespace vpm
