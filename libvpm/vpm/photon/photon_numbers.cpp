// Which dimension of the sequence each draw takes.
#include "vpm/photon/photon_numbers.h"

namespace vpm {
namespace {

constexpr int kGenerator = -1;
constexpr uint64_t kPoints = uint64_t{1} << 32;  // of the sequence

/// The dimensions of a draw: of its upper 32 bits, and of its lower ones where it is drawn for two numbers.
struct Dimensions {
  int upper, lower = kGenerator;
};

// The first dimensions of the sequence are spread best together: the place and direction of emission have them, and
// the first distance, which all beams and photons in media depend on.
constexpr std::array<Dimensions, PhotonNumbers::kLead> kDimensions{
    {{5}, {6}, {7}, {0, 1}, {2, 3}, {15}, {4}, {8}, {9, 10}, {kGenerator}, {11}, {12}, {13, 14}}};

}  // namespace

PhotonNumbers::PhotonNumbers(PhotonSequence sequence, uint64_t seed, uint64_t pass) : seed_(seed), pass_(pass) {
  if (sequence == PhotonSequence::sobol) sobol_.emplace(Rng(seed, rng_stream(RngUse::sequence, pass), 0));
}

Rng PhotonNumbers::of(uint64_t photon, Lead& lead) const {
  Rng rng(seed_, rng_stream(RngUse::photon, pass_), photon);
  if (!sobol_ || photon >= kPoints) return rng;
  const ScrambledSobol::Point point = (*sobol_)[static_cast<uint32_t>(photon)];
  for (size_t i = 0; i < kLead; ++i) {
    const auto [upper, lower] = kDimensions[i];
    const auto half = [&](int dimension) -> uint64_t {
      return dimension == kGenerator ? rng.bits() >> 32 : point[static_cast<size_t>(dimension)];
    };
    lead[i] = half(upper) << 32;
    lead[i] |= half(lower);
  }
  rng.lead(lead);
  return rng;
}

}  // namespace vpm
