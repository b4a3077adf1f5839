// Densities at evenly spaced places of a ray, all at once: in lanes of AVX-512 where the processor has them, which take
// two thirds of the time of one after another. Either way they are the bits of DensityGrid::density().
#include "vpm/medium/grid/density_grid.h"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace vpm {

void DensityGrid::densities(const LatticeRay& ray, double t, double step, std::span<float> densities) const {
  assert(densities.size() <= kAtOnce);
  if (boxes_.whole()) return densities_in_box(ray, t, step, densities);
  for (size_t i = 0; i < densities.size(); ++i)
    densities[i] = density_in_boxes(ray.origin + (t + static_cast<double>(i) * step) * ray.direction);
}

#if defined(__AVX512F__)

namespace {

__m512i joined(const __m256i (&halves)[2]) {
  return _mm512_inserti64x4(_mm512_castsi256_si512(halves[0]), halves[1], 1);
}
__m512 joined(const __m256 (&halves)[2]) {
  const __m512d low = _mm512_castps_pd(_mm512_castps256_ps512(halves[0]));
  return _mm512_castpd_ps(_mm512_insertf64x4(low, _mm256_castps_pd(halves[1]), 1));
}
__m256i half_of(__m512i lanes, int half) {
  return half == 0 ? _mm512_castsi512_si256(lanes) : _mm512_extracti64x4_epi64(lanes, 1);
}

/// a * factor + b
__m512i times_plus(__m512i a, int factor, __m512i b) {
  return _mm512_add_epi32(_mm512_mullo_epi32(a, _mm512_set1_epi32(factor)), b);
}
/// From a to b, as trilinear() rounds.
__m512 between(__m512 a, __m512 b, __m512 f) { return _mm512_add_ps(a, _mm512_mul_ps(f, _mm512_sub_ps(b, a))); }

/// Sixteen places of a lattice.
struct PlaceLanes {
  __mmask16 inside;
  __m512i cell[3];     // 0 outside
  __m512 fraction[3];  // position within the cell, along each axis
};

/// Those at t, t + step, ... of a ray in units of cells.
PlaceLanes places_of(const DensityGrid::LatticeRay& ray, double t, double step, const Vec3d& lattice_size) {
  const __m512d numbers[2] = {_mm512_setr_pd(0, 1, 2, 3, 4, 5, 6, 7), _mm512_setr_pd(8, 9, 10, 11, 12, 13, 14, 15)};
  __mmask8 inside[2];
  __m256i cells[3][2];
  __m256 fractions[3][2];
  for (int half = 0; half < 2; ++half) {
    const __m512d at = _mm512_add_pd(_mm512_set1_pd(t), _mm512_mul_pd(numbers[half], _mm512_set1_pd(step)));
    __m512d p[3];
    inside[half] = 0xff;
    for (int a = 0; a < 3; ++a) {
      p[a] = _mm512_add_pd(_mm512_set1_pd(ray.origin[a]), _mm512_mul_pd(at, _mm512_set1_pd(ray.direction[a])));
      inside[half] &= _mm512_cmp_pd_mask(p[a], _mm512_setzero_pd(), _CMP_GE_OQ) &
                      _mm512_cmp_pd_mask(p[a], _mm512_set1_pd(lattice_size[a]), _CMP_LT_OQ);
    }
    for (int a = 0; a < 3; ++a) {
      cells[a][half] = _mm512_maskz_cvttpd_epi32(inside[half], p[a]);
      fractions[a][half] = _mm512_cvtpd_ps(_mm512_sub_pd(p[a], _mm512_cvtepi32_pd(cells[a][half])));
    }
  }
  return {static_cast<__mmask16>(inside[0] | inside[1] << 8),
          {joined(cells[0]), joined(cells[1]), joined(cells[2])},
          {joined(fractions[0]), joined(fractions[1]), joined(fractions[2])}};
}

/// The values of bricks at the lower corners of cells, and at their neighbours.
class CornerLanes {
 public:
  /// `first`: where the brick of each lane begins, in units of bricks. Only the lanes of the mask are read.
  CornerLanes(const float* values, __m512i first, const PlaceLanes& places, __mmask16 mask) : values_(values) {
    constexpr int kRow = DensityGrid::kValues;
    const __m512i in_brick = _mm512_set1_epi32(DensityGrid::kCells - 1);
    __m512i local = _mm512_and_si512(places.cell[2], in_brick);
    for (const int a : {1, 0}) local = times_plus(local, kRow, _mm512_and_si512(places.cell[a], in_brick));
    for (int half = 0; half < 2; ++half) {
      mask_[half] = static_cast<__mmask8>(mask >> (8 * half));
      const __m512i bricks = _mm512_cvtepu32_epi64(half_of(first, half));
      offsets_[half] = _mm512_add_epi64(_mm512_mul_epu32(bricks, _mm512_set1_epi64(DensityGrid::kBrickValues)),
                                        _mm512_cvtepu32_epi64(half_of(local, half)));
    }
  }

  /// Those so many values further on, and, in `next`, those after them: both are read at once.
  __m512 read(int further, __m512& next) const {
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    __m512 pairs[2];
    for (int half = 0; half < 2; ++half)
      pairs[half] = _mm512_castpd_ps(
          _mm512_mask_i64gather_pd(_mm512_setzero_pd(), mask_[half], offsets_[half], values_ + further, sizeof(float)));
    next = _mm512_permutex2var_ps(pairs[0], _mm512_add_epi32(even, _mm512_set1_epi32(1)), pairs[1]);
    return _mm512_permutex2var_ps(pairs[0], even, pairs[1]);
  }

 private:
  const float* values_;
  __mmask8 mask_[2];
  __m512i offsets_[2];  // of the lower corners
};

__m512 trilinear(const CornerLanes& corners, const __m512 (&fraction)[3]) {
  constexpr int kRow = DensityGrid::kValues, kSlice = kRow * kRow;
  const auto along_x = [&](int further) {
    __m512 next;
    const __m512 value = corners.read(further, next);
    return between(value, next, fraction[0]);
  };
  const auto along_y = [&](int further) { return between(along_x(further), along_x(further + kRow), fraction[1]); };
  return between(along_y(0), along_y(kSlice), fraction[2]);
}

}  // namespace

void DensityGrid::densities_in_box(const LatticeRay& ray, double t, double step, std::span<float> densities) const {
  const auto wanted = static_cast<__mmask16>((1u << densities.size()) - 1);
  PlaceLanes places = places_of(ray, t, step, lattice_size_);
  places.inside &= wanted;
  __m512i brick = _mm512_srli_epi32(places.cell[2], kCellBits);
  for (const int a : {1, 0}) brick = times_plus(brick, brick_count_[a], _mm512_srli_epi32(places.cell[a], kCellBits));
  // The columns of the table of bricks, in units of their entries' numbers.
  static_assert(sizeof(Brick) == 3 * sizeof(float));
  brick = times_plus(brick, 3, _mm512_setzero_si512());
  const __m512 background = _mm512_set1_ps(frame_.background);
  const __m512 min = _mm512_mask_i32gather_ps(background, places.inside, brick, &bricks_.data()->min, 4);
  const __m512 max = _mm512_mask_i32gather_ps(background, places.inside, brick, &bricks_.data()->max, 4);
  const __mmask16 varying = _mm512_mask_cmp_ps_mask(places.inside, min, max, _CMP_NEQ_UQ);
  __m512 result = min;
  if (varying != 0) {
    const __m512i first =
        _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), varying, brick, &bricks_.data()->first, 4);
    const CornerLanes corners(values_.data(), first, places, varying);
    __m512 next;
    result = _mm512_mask_mov_ps(result, varying,
                                frame_.interpolation == Interpolation::nearest
                                    ? corners.read(0, next)
                                    : _mm512_max_ps(trilinear(corners, places.fraction), _mm512_setzero_ps()));
  }
  _mm512_mask_storeu_ps(densities.data(), wanted, result);
}

#else

void DensityGrid::densities_in_box(const LatticeRay& ray, double t, double step, std::span<float> densities) const {
  Place varying[kAtOnce];
  size_t numbers[kAtOnce], count = 0;
  for (size_t i = 0; i < densities.size(); ++i) {
    const Place& place = varying[count] = find(ray.origin + (t + static_cast<double>(i) * step) * ray.direction);
    densities[i] = place.density;
    numbers[count] = i;
    if (!place.values) continue;
    DensityStretch::prefetch_cell(place.values);
    ++count;
  }
  for (size_t i = 0; i < count; ++i) densities[numbers[i]] = read(varying[i]);
}

#endif

}  // namespace vpm
