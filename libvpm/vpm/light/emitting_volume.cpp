// A grid of bounds whose voxels are the cells, and sums over these.
#include "vpm/light/emitting_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <span>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr double kAbove = 1e-5;  // by which a bound is higher, relative
constexpr double kMostCells = double{1 << 22};

/// Cells; the boxes of them that may emit; and the boxes of the world that these must reach into, m. None: all.
struct Cells {
  GridFrame frame;
  std::vector<IndexBox> filled{};
  std::vector<Box> within{};

  bool may_emit(const Vec3i& cell) const {
    if (glm::any(glm::lessThan(cell, frame.lo)) || glm::any(glm::greaterThan(cell, frame.hi))) return false;
    const Mat3d axes(frame.index_to_world);
    const Vec3d reach = 0.5 * (glm::abs(axes[0]) + glm::abs(axes[1]) + glm::abs(axes[2]));
    const Vec3d middle(frame.index_to_world * glm::dvec4(Vec3d(cell), 1.0));
    return within.empty() || std::any_of(within.begin(), within.end(), [&](const Box& box) {
             return glm::all(glm::lessThanEqual(middle - reach, Vec3d(box.hi))) &&
                    glm::all(glm::greaterThanEqual(middle + reach, Vec3d(box.lo)));
           });
  }
};

double volume_of(const Box& box) {
  const Vec3d size = Vec3d(box.hi) - Vec3d(box.lo);
  return size.x * size.y * size.z;
}

/// The cells of the lattice of a grid, where it holds anything: voxels that fill them. Where there are too many, 2^3 or
/// more make one. Those of temperatures are halved where there are few, as light changes much within one.
Cells cells_of(const DensityGrid& grid, bool blackbody) {
  const GridFrame& lattice = grid.frame();
  Cells cells;
  GridFrame& frame = cells.frame;
  frame.interpolation = Interpolation::nearest;
  const bool nearest = lattice.interpolation == Interpolation::nearest;
  const Vec3d first = Vec3d(lattice.lo) - (nearest ? 0.5 : 1.0), last = Vec3d(lattice.hi) + (nearest ? 0.5 : 1.0);
  const std::vector<IndexBox> filled = grid.filled();
  // A brick of a trilinear grid reaches from its first voxel to the first one of the next.
  const double begin = nearest ? -0.5 : 0.0, end = nearest ? 0.5 : 1.0;
  double edge = blackbody && !nearest ? 0.5 : 1.0;
  const auto too_many = [&] {
    constexpr double kWidest = double{1 << 30};
    const Vec3d all = glm::ceil((last - first) / edge);
    if (all.x * all.y * all.z <= kMostCells) return false;
    double count = 0.0;
    for (const IndexBox& box : filled) {
      const Vec3d size = glm::ceil((Vec3d(box.hi - box.lo) + end - begin) / edge);
      count += size.x * size.y * size.z;
    }
    return count > kMostCells || glm::any(glm::greaterThan(all, Vec3d(kWidest)));
  };
  while (too_many()) edge *= 2.0;
  frame.hi = Vec3i(glm::ceil((last - first) / edge)) - 1;
  for (const IndexBox& box : filled) {
    const Vec3i lo(glm::floor((Vec3d(box.lo) + begin - first) / edge));
    const Vec3i hi(glm::ceil((Vec3d(box.hi) + end - first) / edge));
    cells.filled.push_back({glm::max(lo, Vec3i(0)), glm::min(hi - 1, frame.hi)});
  }
  const Mat4d at = glm::translate(Mat4d(1.0), first + 0.5 * edge);
  frame.index_to_world = lattice.index_to_world * at * glm::scale(Mat4d(1.0), Vec3d(edge));
  return cells;
}

/// A box as one cell.
Cells cell_of(const Box& box) {
  GridFrame frame;
  frame.interpolation = Interpolation::nearest;
  const Vec3d size = Vec3d(box.hi) - Vec3d(box.lo);
  frame.index_to_world =
      glm::translate(Mat4d(1.0), 0.5 * (Vec3d(box.lo) + Vec3d(box.hi))) * glm::scale(Mat4d(1.0), size);
  return {frame};
}

/// Boxes of the world as cells: one around all, unless that would be mostly empty. Then there are some across the
/// narrowest box.
Cells cells_in(const std::vector<Box>& around) {
  constexpr double kAcross = 4.0, kMost = double{1 << 16}, kWidest = double{1 << 20};
  Box all;
  double filled = 0.0, edge = kInfinity;
  for (const Box& box : around) {
    all.add(box.lo);
    all.add(box.hi);
    filled += volume_of(box);
    const Vec3d size = Vec3d(box.hi) - Vec3d(box.lo);
    edge = std::min({edge, size.x / kAcross, size.y / kAcross, size.z / kAcross});
  }
  if (2.0 * filled > volume_of(all) || !(edge > 0.0)) return cell_of(all);
  const Vec3d lo(all.lo), size = Vec3d(all.hi) - lo;
  edge = std::max({edge, std::cbrt(filled / kMost), std::max({size.x, size.y, size.z}) / kWidest});
  Cells cells{{}, {}, around};
  cells.frame.interpolation = Interpolation::nearest;
  cells.frame.hi = Vec3i(glm::ceil(size / edge)) - 1;
  cells.frame.index_to_world = glm::translate(Mat4d(1.0), lo + 0.5 * edge) * glm::scale(Mat4d(1.0), Vec3d(edge));
  for (const Box& box : around)
    cells.filled.push_back({Vec3i(glm::floor((Vec3d(box.lo) - lo) / edge)),
                            glm::min(Vec3i(glm::floor((Vec3d(box.hi) - lo) / edge)), cells.frame.hi)});
  return cells;
}

/// Of the grid that says where something is emitted.
Cells cells_for(const Medium& medium, const std::vector<Box>& around) {
  constexpr size_t kMostBoxes = 64;  // that each cell is compared with
  const DensityGrid* grid = medium.emission_grid.get();
  if (!grid && medium.emission->meaning == MediumEmission::Meaning::thermal) grid = medium.grid.get();
  if (!grid || grid->frame().background != 0.0f || grid->max_density() == 0.0f) return cells_in(around);
  Cells cells = cells_of(*grid, medium.emission->blackbody);
  if (around.size() <= kMostBoxes) cells.within = around;
  return cells;
}

/// A grid, or none, whose value is 1 everywhere, as the cells of another lattice see it.
class SeenGrid {
 public:
  SeenGrid(const DensityGrid* grid, const GridFrame& cells) : grid_(grid) {
    if (grid) to_index_ = glm::inverse(grid->frame().index_to_world) * cells.index_to_world;
  }

  /// The largest value in a box of cells, or more.
  double largest(const Vec3d& lo, const Vec3d& hi) const {
    if (!grid_) return 1.0;
    Vec3d first(kInfinity), last(-kInfinity);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d p(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z);
      const Vec3d index(to_index_ * glm::dvec4(p, 1.0));
      first = glm::min(first, index);
      last = glm::max(last, index);
    }
    return grid_->largest(first, last);
  }

 private:
  const DensityGrid* grid_;
  Mat4d to_index_{1.0};
};

/// Bounds of the mean of the channels' emission coefficients in cells.
class Bounds {
 public:
  Bounds(const Medium& medium, const GridFrame& cells)
      : medium_(medium), source_(medium.emission_grid.get(), cells), density_(medium.grid.get(), cells) {}

  double in(const Vec3d& lo, const Vec3d& hi) const {
    Rgbd coefficient = medium_.emission->source(source_.largest(lo, hi));
    if (medium_.emission->meaning == MediumEmission::Meaning::thermal && coefficient != Rgbd(0.0))
      coefficient *= Rgbd(medium_.sigma_t - medium_.sigma_s) * density_.largest(lo, hi);
    return (coefficient.r + coefficient.g + coefficient.b) / 3.0;
  }

 private:
  const Medium& medium_;
  SeenGrid source_, density_;
};

std::shared_ptr<const DensityGrid> bounds_of(const Medium& medium, const Cells& cells) {
  constexpr int kValues = DensityGrid::kValues;
  const GridFrame& frame = cells.frame;
  const Bounds bounds(medium, frame);
  const auto fill = [&](const Vec3i& origin, float* values) {
    const Vec3d corner = Vec3d(origin) - 0.5;
    if (bounds.in(corner, corner + double{kValues}) == 0.0) {
      values[0] = 0.0f;
      return DensityGrid::Filled::one;
    }
    for (int z = 0, n = 0; z < kValues; ++z)
      for (int y = 0; y < kValues; ++y)
        for (int x = 0; x < kValues; ++x, ++n) {
          const Vec3i voxel = origin + Vec3i(x, y, z);
          const Vec3d lo = Vec3d(voxel) - 0.5;
          values[n] = static_cast<float>(cells.may_emit(voxel) ? (1.0 + kAbove) * bounds.in(lo, lo + 1.0) : 0.0);
        }
    return DensityGrid::Filled::all;
  };
  return std::make_shared<const DensityGrid>(frame, fill, cells.filled);
}

}  // namespace

EmittingVolume::EmittingVolume(const Medium& medium, const std::vector<Box>& around)
    : bounds_(bounds_of(medium, cells_for(medium, around))) {
  volume_ = std::abs(glm::determinant(glm::dmat3(bounds_->frame().index_to_world)));
  add_cells();
  constexpr size_t kChunk = 1024;
  std::vector<Rgbd> sums(chunk_count(cells_.size(), kChunk), Rgbd(0.0));
  parallel_for_chunks(cells_.size(), kChunk, [&](size_t begin, size_t end, size_t chunk) {
    for (size_t i = begin; i < end; ++i) sums[chunk] += power_in(medium, cells_[i].voxel);
  });
  Rgbd power(0.0);
  for (const Rgbd& sum : sums) power += sum;
  power_ = Rgb(power);
  grey_ = is_grey(medium.emission->colour) && !medium.emission->blackbody &&
          (medium.emission->meaning == MediumEmission::Meaning::volume || medium.grey());
  if (!(total_ > 0.0)) throw InputError("the medium '" + medium.name + "' emits nothing anywhere");
}

void EmittingVolume::add_cells() {
  for (const IndexBox& box : bounds_->filled())
    for (int z = box.lo.z; z <= box.hi.z; ++z)
      for (int y = box.lo.y; y <= box.hi.y; ++y)
        for (int x = box.lo.x; x <= box.hi.x; ++x) {
          const Vec3i voxel(x, y, z);
          const double bound = bounds_->largest(Vec3d(voxel), Vec3d(voxel));
          if (bound == 0.0) continue;
          cells_.push_back({voxel, total_});
          total_ += bound * volume_;
        }
}

Rgbd EmittingVolume::power_in(const Medium& medium, const Vec3i& voxel) const {
  // Of two and of four points from -1/2 to 1/2; the weights of either sum to 1.
  struct Point {
    double at, weight;
  };
  static constexpr std::array kTwo{Point{-0.28867513459481287, 0.5}, Point{0.28867513459481287, 0.5}};
  static constexpr std::array kFour{
      Point{-0.43056815579702629, 0.17392742256872693}, Point{-0.16999052179242813, 0.32607257743127307},
      Point{0.16999052179242813, 0.32607257743127307}, Point{0.43056815579702629, 0.17392742256872693}};
  constexpr double kDim = 0.01;  // of the brightest cell
  const bool few = !medium.emission->blackbody ||
                   bounds_->largest(Vec3d(voxel), Vec3d(voxel)) < kDim * double{bounds_->max_density()};
  const std::span<const Point> points = few ? std::span<const Point>(kTwo) : std::span<const Point>(kFour);
  Rgbd sum(0.0);
  for (const Point& x : points)
    for (const Point& y : points)
      for (const Point& z : points)
        sum += x.weight * y.weight * z.weight *
               emission_coefficient(medium, Vec3(to_world(Vec3d(voxel) + Vec3d(x.at, y.at, z.at))));
  return 4.0 * kPiD * volume_ * sum;
}

EmittingVolume::Place EmittingVolume::draw(double choice, double x, const Vec2& yz) const {
  const double target = choice * total_;
  const auto after = std::upper_bound(cells_.begin() + 1, cells_.end(), target,
                                      [](double t, const Cell& cell) { return t < cell.before; });
  const Cell& cell = *(after - 1);
  const double end = after == cells_.end() ? total_ : after->before;
  const Vec3d index = Vec3d(cell.voxel) - 0.5 + Vec3d(x, double{yz.x}, double{yz.y});
  return {Vec3(to_world(index)), (end - cell.before) / volume_, (target - cell.before) / (end - cell.before)};
}

double EmittingVolume::direction_density(const Ray& ray) const {
  double sum = 0.0;
  bounds_->visit_pieces(ray, {0.0f, kInfinity}, [&](const DensityPiece& piece) {
    sum += piece.c0 * piece.length() * (piece.t0 * piece.t0 + piece.t0 * piece.t1 + piece.t1 * piece.t1) / 3.0;
    return true;
  });
  return sum / total_;
}

}  // namespace vpm
