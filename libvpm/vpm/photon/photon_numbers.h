// The random numbers of photon paths, of which the first may be of low discrepancy.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "vpm/base/even_points.h"
#include "vpm/base/rng.h"
#include "vpm/photon/photon_settings.h"

namespace vpm {

/// Random numbers for the photon paths of one pass. Those of each path are uniform and independent of each other, and
/// those of different passes are independent; paths of one pass are so only where the sequence is random.
class PhotonNumbers {
 public:
  PhotonNumbers(PhotonSequence sequence, uint64_t seed, uint64_t pass);

  static constexpr size_t kLead = 13;
  /// The first draws of a path: emission (light, choice, face, place, direction), and twice flight (channel, distance)
  /// and scattering (choice, direction), as strategies without null collisions draw them. Others draw more, or no
  /// channel, and their draws have the dimensions of others.
  using Lead = std::array<uint64_t, kLead>;

  /// The random numbers of a path. `lead`, which they may refer to, must stay until they have been drawn.
  Rng of(uint64_t photon, Lead& lead) const;

 private:
  uint64_t seed_, pass_;
  std::optional<ScrambledSobol> sobol_;
};

}  // namespace vpm
