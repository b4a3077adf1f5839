// Direction numbers, and their scrambling.
#include "vpm/base/even_points.h"

#include <bit>

namespace vpm {
namespace {

/// A primitive polynomial over the field of two elements, without its first and last coefficient, which are 1, and the
/// first direction numbers [Joe2008, table new-joe-kuo-6].
struct Primitive {
  int degree;
  uint32_t coefficients;
  std::array<uint32_t, 6> first;
};

constexpr std::array<Primitive, ScrambledSobol::kDimensions - 1> kPrimitives{{{1, 0, {1}},
                                                                              {2, 1, {1, 3}},
                                                                              {3, 1, {1, 3, 1}},
                                                                              {3, 2, {1, 1, 1}},
                                                                              {4, 1, {1, 1, 3, 3}},
                                                                              {4, 4, {1, 3, 5, 13}},
                                                                              {5, 2, {1, 1, 5, 5, 17}},
                                                                              {5, 4, {1, 1, 5, 5, 5}},
                                                                              {5, 7, {1, 1, 7, 11, 19}},
                                                                              {5, 11, {1, 1, 5, 1, 1}},
                                                                              {5, 13, {1, 1, 1, 3, 11}},
                                                                              {5, 14, {1, 3, 5, 5, 31}},
                                                                              {6, 1, {1, 3, 3, 9, 7, 49}},
                                                                              {6, 13, {1, 1, 1, 15, 21, 21}},
                                                                              {6, 16, {1, 3, 1, 13, 27, 49}}}};

using Column = std::array<uint32_t, 32>;

/// Direction numbers of one dimension, as digits from the left: the first is van der Corput's [Bratley1988, eq. 2].
Column direction_numbers(int dimension) {
  Column v;
  if (dimension == 0) {
    for (unsigned i = 0; i < 32; ++i) v[i] = 1u << (31u - i);
    return v;
  }
  const Primitive& p = kPrimitives[static_cast<size_t>(dimension) - 1];
  const auto degree = static_cast<unsigned>(p.degree);
  for (unsigned i = 0; i < 32; ++i) {
    if (i < degree) {
      v[i] = p.first[i] << (31u - i);
      continue;
    }
    v[i] = v[i - degree] ^ (v[i - degree] >> degree);
    for (unsigned k = 1; k < degree; ++k)
      if ((p.coefficients >> (degree - 1 - k)) & 1u) v[i] ^= v[i - k];
  }
  return v;
}

}  // namespace

ScrambledSobol::ScrambledSobol(Rng rng) {
  for (int d = 0; d < kDimensions; ++d) {
    Column rows;  // of the scrambling: digit k of a product is the parity of row k and what is multiplied
    for (unsigned k = 0; k < 32; ++k) {
      const uint32_t before = k == 0 ? 0 : ~0u << (32u - k), own = 1u << (31u - k);
      rows[k] = (static_cast<uint32_t>(rng.bits() >> 32) & before) | own;
    }
    const Column numbers = direction_numbers(d);
    for (unsigned i = 0; i < 32; ++i)
      for (unsigned k = 0; k < 32; ++k)
        columns_[i][d] |= static_cast<uint32_t>(std::popcount(rows[k] & numbers[i]) & 1) << (31u - k);
    shift_[d] = static_cast<uint32_t>(rng.bits() >> 32);
  }
}

}  // namespace vpm
