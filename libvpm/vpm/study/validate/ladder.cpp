// The list of levels.
#include "vpm/study/validate/ladder.h"

#include <array>
#include <cassert>

#include "vpm/base/rng.h"

namespace vpm {

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
