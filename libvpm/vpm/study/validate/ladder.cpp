// The list of levels, and the lists of groups that make them.
#include "vpm/study/validate/ladder.h"

#include <array>
#include <cassert>

#include "vpm/base/rng.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

// Level 0: single draws follow their laws.
std::vector<Experiment> distribution_experiments() {
  std::vector<Experiment> all;
  for (const auto& group : {flight_experiments(), transmittance_experiments(), phase_experiments(),
                            outcome_experiments(), material_experiments(), filter_experiments(), emission_experiments(),
                            irradiance_experiments(), photon_map_experiments(), border_experiments(),
                            guide_experiments(), pane_experiments(), technique_experiments()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

// Level 1: identities that hold in whole scenes and need no reference.
std::vector<Experiment> identity_experiments() {
  std::vector<Experiment> all;
  for (const auto& group : {furnace_experiments(), slanted_slab_experiments(), convex_body_experiments(),
                            infinite_medium_experiments(), track_length_experiments(), balance_experiments(),
                            symmetry_experiments(), medium_experiments(), picture_experiments()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

// Level 2: reflection, transmission, absorption, radiance and fluence against exact solutions of transport theory.
std::vector<Experiment> transport_experiments() {
  std::vector<Experiment> all;
  for (const auto& group : {slab_experiments(), slab_radiance_experiments(), source_experiments()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

uint64_t Effort::seed_of(std::string_view name) const {
  // Each character turns the seed into an unrelated one: Rng hashes its address.
  uint64_t hash = seed;
  for (const char c : name) hash = Rng(hash, rng_stream(RngUse::test, 0), static_cast<unsigned char>(c)).bits();
  return hash;
}

std::string_view level_title(int level) {
  static constexpr std::array<std::string_view, kLevels> kTitles{
      "distributions of single draws", "identities that need no reference", "transport theory",
      "agreement between estimators", "convergence"};
  assert(level >= 0 && level < kLevels);
  return kTitles[static_cast<size_t>(level)];
}

std::vector<Experiment> experiments(int level) {
  std::vector<Experiment> all;
  const auto add = [&](int number, std::vector<Experiment> found) {
    if (level >= 0 && level != number) return;
    for (Experiment& e : found) {
      assert(e.level == number);
      all.push_back(std::move(e));
    }
  };
  add(0, distribution_experiments());
  add(1, identity_experiments());
  add(2, transport_experiments());
  add(3, agreement_experiments());
  add(4, convergence_experiments());
  return all;
}

}  // namespace vpm
