// Building density grids and looking them up at points.
#include "vpm/medium/grid/density_grid.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/memory/huge_pages.h"
#include "vpm/base/memory/packed_tables.h"
#include "vpm/base/parallel.h"

namespace vpm {
namespace {

int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// The most bricks that tables may hold: 256 MiB of them, which span 2200^3 voxels.
constexpr double kMaxBricks = double(1u << 28) / 12.0;

/// The bricks whose densities a box of voxels decides: each reaches as far as its neighbours.
IndexBox bricks_of(const IndexBox& voxels) {
  IndexBox bricks;
  for (int a = 0; a < 3; ++a) {
    bricks.lo[a] = floor_div(voxels.lo[a] - 1, DensityGrid::kCells);
    bricks.hi[a] = floor_div(voxels.hi[a], DensityGrid::kCells);
  }
  return bricks;
}

double count_of(const IndexBox& bricks) {
  const Vec3d count = Vec3d(bricks.hi) - Vec3d(bricks.lo) + 1.0;
  return count.x * count.y * count.z;
}

/// The boxes that bricks are stored in, in bricks from the lower corner of all. One table of all is quicker, but to
/// walk from brick to brick where there are none takes longer than to find the next box.
BrickBoxes boxes_of(const IndexBox& all, const std::vector<IndexBox>& occupied) {
  constexpr double kFewerThanAll = 64.0;  // times
  std::vector<IndexBox> bricks;
  bricks.reserve(occupied.size());
  double filled = 0.0;  // those that several boxes reach into are counted as often
  for (const IndexBox& voxels : occupied) {
    const IndexBox box = bricks_of(voxels);
    bricks.push_back({box.lo - all.lo, box.hi - all.lo});
    filled += count_of(box);
  }
  const double table = count_of(all);
  if (bricks.empty() || (table <= kMaxBricks && kFewerThanAll * filled > table)) return BrickBoxes(all.hi - all.lo + 1);
  return BrickBoxes(std::move(bricks));
}

/// Bit by bit, for speed: zeros of opposite signs count as unequal, and its brick is found uniform by
/// its extrema.
bool all_equal(const float* values) {
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  return std::memcmp(values, values + 1, (DensityGrid::kBrickValues - 1) * sizeof(float)) == 0;
}

/// The values of the bricks that vary; equal bricks are kept once. The borders of large tiles are many and alike: a
/// file of a few kB could fill all memory with them.
class DistinctBricks {
 public:
  /// The number of a brick of these values, in units of kBrickValues.
  uint32_t add(const float* values) {
    constexpr size_t kBytes = DensityGrid::kBrickValues * sizeof(float);
    const std::hash<std::string_view> hash;
    const auto [known, added] = numbers_.try_emplace(hash({reinterpret_cast<const char*>(values), kBytes}), size_);
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    if (!added && std::memcmp(values, of(known->second), kBytes) == 0) return known->second;
    if (size_ % kOfPart == 0) parts_.emplace_back().reserve(kOfPart * DensityGrid::kBrickValues);
    parts_.back().insert(parts_.back().end(), values, values + DensityGrid::kBrickValues);
    return size_++;
  }

  /// All values, in one table. Parts are freed as they are copied: there are never two copies of all.
  LargeTable<float> take() {
    LargeTable<float> all;
    all.reserve(size_t{size_} * DensityGrid::kBrickValues);
    for (LargeTable<float>& part : parts_) {
      all.insert(all.end(), part.begin(), part.end());
      part = LargeTable<float>();  // {} would keep its memory
    }
    return all;
  }

 private:
  static constexpr uint32_t kOfPart = 2048;  // bricks, of 6 MB

  const float* of(uint32_t number) const {
    return parts_[number / kOfPart].data() + static_cast<size_t>(number % kOfPart) * DensityGrid::kBrickValues;
  }

  std::vector<LargeTable<float>> parts_;
  uint32_t size_ = 0;                             // bricks
  std::unordered_map<size_t, uint32_t> numbers_;  // by hash; of two bricks with one hash, the first
};

/// The sum over the voxels that belong to the brick alone (not to its upper neighbours).
double owned_sum(const float* values) {
  double sum = 0.0;
  for (int z = 0; z < DensityGrid::kCells; ++z)
    for (int y = 0; y < DensityGrid::kCells; ++y)
      for (int x = 0; x < DensityGrid::kCells; ++x)
        sum += values[(z * DensityGrid::kValues + y) * DensityGrid::kValues + x];
  return sum;
}

}  // namespace

struct DensityGrid::Tables {
  LargeTable<Brick> bricks;
  LargeTable<float> values;
  LargeTable<BrickBlocks> blocks;
};

DensityGrid::DensityGrid(const GridFrame& frame) : frame_(frame), world_to_index_(glm::inverse(frame.index_to_world)) {
  assert(glm::all(glm::lessThanEqual(frame.lo, frame.hi)) && frame.background >= 0.0f);
  const IndexBox all = bricks_of({frame.lo, frame.hi});
  brick_lo_ = all.lo;
  brick_count_ = all.hi - all.lo + 1;
  lattice_lo_ = Vec3d(brick_lo_ * kCells) - lattice_shift();
  lattice_size_ = Vec3d(brick_count_) * double{kCells};
  const Mat3d axes(frame.index_to_world);
  voxel_size_ =
      static_cast<float>(std::min(glm::length(axes[0]), std::min(glm::length(axes[1]), glm::length(axes[2]))));
}

DensityGrid::DensityGrid(const GridFrame& frame, const FillBrick& fill, const std::vector<IndexBox>& occupied,
                         const Passed& passed)
    : DensityGrid(frame) {
  if (glm::any(glm::greaterThanEqual(lattice_size_, Vec3d(std::numeric_limits<int>::max()))))
    throw InputError("its voxels lie 2^31 or more apart");
  boxes_ = boxes_of({brick_lo_, brick_lo_ + brick_count_ - 1}, occupied);
  double count = 0.0;
  for (const BrickBox& box : boxes_.all()) count += double(box.count.x) * box.count.y * box.count.z;
  if (count > kMaxBricks)
    throw InputError(
        fmt::format("{:.3g} bricks of 8^3 voxels would take {:.3g} GiB for their table alone; the limit is 0.25 GiB",
                    count, count * sizeof(Brick) / double(1u << 30)));
  const double sum = fill_bricks(fill, passed);
  find_walked();
  const Vec3d support = support_hi() - support_lo();
  const double cells = count * (kCells * kCells * kCells), volume = support.x * support.y * support.z;
  mean_density_ = std::max(0.0, sum + (volume - cells) * frame.background) / volume;
  mean_of_stored_ = boxes_.whole() ? mean_density_ : sum / cells;
}

DensityGrid::DensityGrid(TableUnpacker& packed, std::shared_ptr<const void> memory)
    : DensityGrid(packed.take_one<GridFrame>()) {
  boxes_ = BrickBoxes(packed);
  bricks_ = packed.take<Brick>();
  values_ = packed.take<float>();
  blocks_ = packed.take<BrickBlocks>();
  max_density_ = packed.take_one<float>();
  mean_density_ = packed.take_one<double>();
  mean_of_stored_ = packed.take_one<double>();
  memory_ = std::move(memory);
  find_walked();
}

void DensityGrid::pack(TablePacker& packer) const {
  packer.add_one(frame_);
  boxes_.pack(packer);
  packer.add(bricks_);
  packer.add(values_);
  packer.add(blocks_);
  packer.add_one(max_density_);
  packer.add_one(mean_density_);
  packer.add_one(mean_of_stored_);
}

double DensityGrid::fill_bricks(const FillBrick& fill, const Passed& passed) {
  constexpr size_t kWave = 1024, kChunk = 64;  // bricks: of 3 MB, and what one thread takes at once
  const auto tables = std::make_shared<Tables>();
  LargeTable<Brick>& bricks = tables->bricks;
  bricks.resize(boxes_.bricks());
  DistinctBricks distinct;
  const auto add_brick = [&](const Brick& brick, const float* of_brick) {
    const uint32_t first = distinct.add(of_brick);
    if (first == tables->blocks.size()) tables->blocks.emplace_back(of_brick, DensityBounds{brick.min, brick.max});
    return first;
  };
  std::vector<float> values(std::min(kWave, bricks.size()) * kBrickValues);
  std::vector<double> sums(kWave);
  std::vector<Filled> filled(kWave);
  double sum = 0.0;
  for (size_t wave = 0; wave < bricks.size(); wave += kWave) {
    const size_t count = std::min(kWave, bricks.size() - wave);
    parallel_for_chunks(count, kChunk, [&](size_t begin, size_t end, size_t) {
      const FillBrick own = fill;
      for (size_t i = begin; i < end; ++i) {
        float* const of_brick = &values[i * kBrickValues];
        filled[i] = own(origin_of(wave + i), of_brick);
        Brick& brick = bricks[wave + i];
        if (filled[i] == Filled::as_last) {
          brick = bricks[wave + i - 1];
          sums[i] = sums[i - 1];
          continue;
        }
        brick = filled[i] == Filled::one ? Brick{of_brick[0], of_brick[0], 0} : brick_of(of_brick);
        sums[i] = brick.uniform() ? double{of_brick[0]} * (kCells * kCells * kCells) : owned_sum(of_brick);
      }
    });
    cancellation_point();
    if (passed && boxes_.whole() && wave + count < bricks.size()) passed(origin_of(wave + count).z);
    for (size_t i = 0; i < count; ++i) {
      Brick& brick = bricks[wave + i];
      if (!brick.uniform())
        brick.first =
            filled[i] == Filled::as_last ? bricks[wave + i - 1].first : add_brick(brick, &values[i * kBrickValues]);
      max_density_ = std::max(max_density_, brick.max);
      sum += sums[i];
    }
  }
  values = std::vector<float>();
  tables->values = distinct.take();
  bricks_ = bricks;
  values_ = tables->values;
  tables->blocks.shrink_to_fit();
  blocks_ = tables->blocks;
  memory_ = tables;
  return sum;
}

void DensityGrid::find_walked() {
  walked_hi_ = lattice_size_;
  if (frame_.background > 0.0f) return;
  Vec3i lo = brick_count_, hi(0);
  for (const BrickBox& box : boxes_.all())
    for (size_t number = box.first; number < box.first + box.bricks(); ++number) {
      if (bricks_[number].max == 0.0f) continue;
      const Vec3i brick = box.brick(number);
      lo = glm::min(lo, brick);
      hi = glm::max(hi, brick + 1);
    }
  walked_lo_ = Vec3d(glm::min(lo, hi)) * double{kCells};
  walked_hi_ = Vec3d(hi) * double{kCells};
}

DensityGrid::Brick DensityGrid::brick_of(const float* values) {
  if (all_equal(values)) {
    assert(values[0] >= 0.0f && std::isfinite(values[0]));
    return {values[0], values[0], 0};
  }
  const auto [min, max] = std::minmax_element(values, values + kBrickValues);
  assert(*min >= 0.0f && std::isfinite(*max));
  return {*min, *max, 0};
}

double DensityGrid::extent() const {
  if (boxes_.whole()) return double{bounds().diagonal()};
  constexpr double kCellsOfBrick = double{kCells} * kCells * kCells;
  const double volume = static_cast<double>(bricks_.size()) * kCellsOfBrick *
                        std::abs(glm::determinant(Mat3d(frame_.index_to_world)));  // m^3
  return std::sqrt(3.0) * std::cbrt(volume);
}

Interval DensityGrid::clip(const Ray& ray, const Interval& interval) const {
  if (frame_.background > 0.0f) return interval;
  const auto [origin, direction] = to_index(ray);
  double t0 = interval.t0, t1 = interval.t1;
  clip_to_box(origin, direction, support_lo(), support_hi(), t0, t1);
  return t1 > t0 ? Interval{static_cast<float>(t0), static_cast<float>(t1)} : Interval{interval.t0, interval.t0};
}

bool DensityGrid::is_positive(const Box& world) const {
  Vec3d lo(kInfinity), hi(-kInfinity);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? world.hi.x : world.lo.x, corner & 2 ? world.hi.y : world.lo.y,
                 corner & 4 ? world.hi.z : world.lo.z);
    const Vec3d index = Vec3d(world_to_index_ * glm::dvec4(Vec3d(p), 1.0)) + lattice_shift();
    lo = glm::min(lo, index);
    hi = glm::max(hi, index);
  }
  const Vec3d from = glm::floor(lo / double{kCells}) - Vec3d(brick_lo_);
  const Vec3d to = glm::floor(hi / double{kCells}) - Vec3d(brick_lo_);
  const Vec3d last = Vec3d(brick_count_ - 1);
  const bool sticks_out = glm::any(glm::lessThan(from, Vec3d(0.0))) || glm::any(glm::greaterThan(to, last));
  if (sticks_out && !(frame_.background > 0.0f)) return false;
  // What lies beyond the lattice is cut off: it may be further away than integers reach.
  return bricks_are_positive(
      {Vec3i(glm::clamp(from, Vec3d(0.0), last + 1.0)), Vec3i(glm::clamp(to, Vec3d(-1.0), last))});
}

float DensityGrid::largest(const Vec3d& lo, const Vec3d& hi) const {
  constexpr double kRounding = 1e-6;  // voxels
  constexpr double kFew = 27.0;
  const double reach = frame_.interpolation == Interpolation::nearest ? 0.5 : 1.0;  // of a voxel's value
  const Vec3d first = glm::max(glm::ceil(lo + kRounding - reach), Vec3d(frame_.lo) - 1.0);
  const Vec3d last = glm::min(glm::floor(hi - kRounding + reach), Vec3d(frame_.hi) + 1.0);
  if (glm::any(glm::greaterThan(first, last))) return frame_.background;
  const Vec3d count = last - first + 1.0;
  if (count.x * count.y * count.z > kFew) return largest_of_voxels(Vec3i(first), Vec3i(last));
  float most = 0.0f;
  for (double z = first.z; z <= last.z; ++z)
    for (double y = first.y; y <= last.y; ++y)
      for (double x = first.x; x <= last.x; ++x) {
        Vec3d at(x, y, z);
        if (frame_.interpolation == Interpolation::trilinear)
          at = glm::clamp(at, lo, hi);  // largest at corners of cells
        most = std::max(most, density_at(at - lattice_lo_));
      }
  return most;
}

float DensityGrid::largest_of_voxels(const Vec3i& first, const Vec3i& last) const {
  const auto brick_of_voxel = [](const Vec3i& voxel) {
    return Vec3i(floor_div(voxel.x, kCells), floor_div(voxel.y, kCells), floor_div(voxel.z, kCells));
  };
  const Vec3i from = glm::max(brick_of_voxel(first) - brick_lo_, Vec3i(0));
  const Vec3i to = glm::min(brick_of_voxel(last) - brick_lo_, brick_count_ - 1);
  float most = frame_.background;
  for (int z = from.z; z <= to.z; ++z)
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) {
        const Vec3i at(x, y, z), corner = (brick_lo_ + at) * kCells;
        const BrickBox* const box = boxes_.find(at);
        if (!box) continue;
        const Brick& brick = bricks_[box->number(at)];
        if (brick.max <= most) continue;
        const Vec3i lo = glm::max(first - corner, Vec3i(0)), hi = glm::min(last - corner, Vec3i(kCells - 1));
        if (brick.uniform() || glm::all(glm::equal(hi - lo, Vec3i(kCells - 1)))) {
          most = brick.max;
          continue;
        }
        const float* const values = values_of(brick);
        for (int k = lo.z; k <= hi.z; ++k)
          for (int j = lo.y; j <= hi.y; ++j)
            for (int i = lo.x; i <= hi.x; ++i) most = std::max(most, values[(k * kValues + j) * kValues + i]);
      }
  return most;
}

std::vector<IndexBox> DensityGrid::filled() const {
  std::vector<IndexBox> boxes;
  for (size_t number = 0; number < bricks_.size(); ++number)
    if (bricks_[number].max > 0.0f) boxes.push_back({origin_of(number), origin_of(number) + (kCells - 1)});
  return boxes;
}

float DensityGrid::density_in_boxes(const Vec3d& p) const {
  const bool inside = glm::all(glm::greaterThanEqual(p, Vec3d(0.0))) && glm::all(glm::lessThan(p, lattice_size_));
  if (!inside) return frame_.background;
  const Vec3i cell(p), at = cell >> kCellBits;
  const BrickBox* const box = boxes_.find(at);
  if (!box) return frame_.background;
  const Place place = place_in(bricks_[box->number(at)], p, cell);
  return place.values ? read(place) : place.density;
}

bool DensityGrid::bricks_are_positive(const IndexBox& bricks) const {
  const auto volume = [](const Vec3i& lo, const Vec3i& hi) {
    const Vec3d extent = glm::max(Vec3d(hi) - Vec3d(lo) + 1.0, Vec3d(0.0));
    return extent.x * extent.y * extent.z;
  };
  double stored = 0.0;
  for (const BrickBox& box : boxes_.all()) {
    const Vec3i lo = glm::max(bricks.lo, box.lo), hi = glm::min(bricks.hi, box.lo + box.count - 1);
    stored += volume(lo, hi);
    for (int z = lo.z; z <= hi.z; ++z)
      for (int y = lo.y; y <= hi.y; ++y)
        for (int x = lo.x; x <= hi.x; ++x)
          if (!(bricks_[box.number({x, y, z})].min > 0.0f)) return false;
  }
  return frame_.background > 0.0f || stored == volume(bricks.lo, bricks.hi);
}

void DensityGrid::cell_piece(const float* v, const Vec3& local, const Vec3& step, DensityPiece& piece) const {
  if (frame_.interpolation == Interpolation::nearest) {
    piece.c0 = *v;
    return;
  }
  // The trilinear polynomial in (x, y, z), each linear in the distance s: x = local.x + s step.x, ... Multiplied out
  // one axis at a time.
  constexpr int kY = kValues;
  constexpr int kZ = kValues * kValues;
  const double x = local.x, y = local.y, z = local.z;
  const double dx = step.x, dy = step.y, dz = step.z;
  double a[4], b[4];  // along x, at the four (y, z) edges: a + b s
  for (int i = 0; i < 4; ++i) {
    const float* edge = v + (i & 1) * kY + (i >> 1) * kZ;
    const double rise = double(edge[1]) - edge[0];
    a[i] = edge[0] + x * rise;
    b[i] = dx * rise;
  }
  double p[2][3];  // along y, at the two z faces: quadratics
  for (int i = 0; i < 2; ++i) {
    const double rise_a = a[2 * i + 1] - a[2 * i];
    const double rise_b = b[2 * i + 1] - b[2 * i];
    p[i][0] = a[2 * i] + y * rise_a;
    p[i][1] = b[2 * i] + y * rise_b + dy * rise_a;
    p[i][2] = dy * rise_b;
  }
  const double r0 = p[1][0] - p[0][0], r1 = p[1][1] - p[0][1], r2 = p[1][2] - p[0][2];
  piece.c0 = std::max(0.0, p[0][0] + z * r0);  // rounding can leave a hair below zero at an empty corner
  piece.c1 = p[0][1] + z * r1 + dz * r0;
  piece.c2 = p[0][2] + z * r2 + dz * r1;
  piece.c3 = dz * r2;
}

Vec3d DensityGrid::support_lo() const {
  return Vec3d(frame_.lo) - (frame_.interpolation == Interpolation::nearest ? 0.5 : 1.0);
}

Vec3d DensityGrid::support_hi() const {
  return Vec3d(frame_.hi) + (frame_.interpolation == Interpolation::nearest ? 0.5 : 1.0);
}

Box DensityGrid::bounds() const {
  Box box;
  const Vec3d lo = support_lo(), hi = support_hi();
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z, 1.0);
    box.add(Vec3(frame_.index_to_world * p));
  }
  return box;
}

size_t DensityGrid::memory_bytes() const {
  return sizeof(*this) + bricks_.size_bytes() + values_.size_bytes() + blocks_.size_bytes() + boxes_.memory_bytes();
}

}  // namespace vpm
