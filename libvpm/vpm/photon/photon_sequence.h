// Where photon paths have their first random numbers from.
#pragma once

namespace vpm {

/// The first random numbers of photon paths are points of Sobol's sequence, which lie more evenly, so that sums over
/// many photons have less noise; or come from the generator, as all others.
enum class PhotonSequence { sobol, random };

}  // namespace vpm
