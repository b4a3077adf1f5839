// What is asked of photons: where their first random numbers come from, and how they are guided by importance.
#pragma once

#include <cstdint>

namespace vpm {

/// The first random numbers of photon paths are points of Sobol's sequence, which lie more evenly, so that sums over
/// many photons have less noise; or come from the generator, as all others.
enum class PhotonSequence { sobol, random };

/// How photons are guided. Whatever is chosen, results stay unbiased: importance decides how many photons go somewhere,
/// and their powers make up for it.
struct GuideSettings {
  uint64_t importons = 0;  // per pass; 0: photons are not guided
  bool aim = true;         // emit more where photons are worth more
  bool split = true;       // follow photons by several where they are worth more, by fewer where less
  bool scatter = false;    // scatter photons more into directions in which they are worth more
};

}  // namespace vpm
