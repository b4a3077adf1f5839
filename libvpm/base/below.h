// Which of sixteen numbers lie below a limit, as bits.
#pragma once

#include <cstdint>

#if defined(__AVX512F__) || defined(__AVX__)
#include <immintrin.h>
#endif

namespace vpm {

/// Bit i tells whether values[i] < limit, i < 16.
inline uint32_t bits_below(const float* values, float limit) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask(_mm512_loadu_ps(values), _mm512_set1_ps(limit), _CMP_LT_OQ);
#elif defined(__AVX__)
  const __m256 most = _mm256_set1_ps(limit);
  const auto half = [&](const float* v) {
    return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(_mm256_loadu_ps(v), most, _CMP_LT_OQ)));
  };
  return half(values) | half(values + 8) << 8;
#else
  uint32_t bits = 0;
  for (int i = 0; i < 16; ++i) bits |= (values[i] < limit ? 1u : 0u) << i;
  return bits;
#endif
}

}  // namespace vpm
