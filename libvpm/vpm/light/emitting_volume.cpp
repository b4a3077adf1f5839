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

/// The cells of a grid's lattice: voxels that fill them. Where there are too many, 2^3 or more make one. Those of
/// temperatures are halved where there are few, as light changes much within one.
GridFrame cells_of(const GridFrame& lattice, bool blackbody) {
  GridFrame cells;
  cells.interpolation = Interpolation::nearest;
  const bool nearest = lattice.interpolation == Interpolation::nearest;
  const Vec3d first = Vec3d(lattice.lo) - (nearest ? 0.5 : 1.0), last = Vec3d(lattice.hi) + (nearest ? 0.5 : 1.0);
  double edge = blackbody && !nearest ? 0.5 : 1.0;
  const auto count = [&] { return glm::ceil((last - first) / edge); };
  while (count().x * count().y * count().z > kMostCells) edge *= 2.0;
  cells.hi = Vec3i(count()) - 1;
  const Mat4d at = glm::translate(Mat4d(1.0), first + 0.5 * edge);
  cells.index_to_world = lattice.index_to_world * at * glm::scale(Mat4d(1.0), Vec3d(edge));
  return cells;
}

/// A box as one cell.
GridFrame cell_of(const Box& box) {
  GridFrame cells;
  cells.interpolation = Interpolation::nearest;
  const Vec3d size = Vec3d(box.hi) - Vec3d(box.lo);
  cells.index_to_world =
      glm::translate(Mat4d(1.0), 0.5 * (Vec3d(box.lo) + Vec3d(box.hi))) * glm::scale(Mat4d(1.0), size);
  return cells;
}

/// Where the medium emits outside the grid of its source, too, that of the density decides, if anything does.
GridFrame frame_of(const Medium& medium, const Box& around) {
  if (!medium.emission_grid && medium.emission->meaning == MediumEmission::Meaning::volume) return cell_of(around);
  const bool ends = medium.emission_grid && medium.emission->source(0.0) == Rgbd(0.0);
  const DensityGrid* grid = ends ? medium.emission_grid.get() : medium.grid.get();
  if (!grid || grid->frame().background != 0.0f) return cell_of(around);
  return cells_of(grid->frame(), medium.emission->blackbody);
}

/// The largest value of a grid (null: 1) in the box of cells `lo` to `hi` of another lattice.
double largest_in(const DensityGrid* grid, const GridFrame& cells, const Vec3d& lo, const Vec3d& hi) {
  if (!grid) return 1.0;
  const Mat4d to_index = glm::inverse(grid->frame().index_to_world) * cells.index_to_world;
  Vec3d first(kInfinity), last(-kInfinity);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z);
    const Vec3d index(to_index * glm::dvec4(p, 1.0));
    first = glm::min(first, index);
    last = glm::max(last, index);
  }
  return grid->largest(first, last);
}

/// A bound of the mean of the channels' emission coefficients in a box of cells.
double bound_in(const Medium& medium, const GridFrame& cells, const Vec3d& lo, const Vec3d& hi) {
  const Rgbd source = medium.emission->source(largest_in(medium.emission_grid.get(), cells, lo, hi));
  Rgbd coefficient = source;
  if (medium.emission->meaning == MediumEmission::Meaning::thermal && source != Rgbd(0.0))
    coefficient *= Rgbd(medium.sigma_t - medium.sigma_s) * largest_in(medium.grid.get(), cells, lo, hi);
  return (coefficient.r + coefficient.g + coefficient.b) / 3.0;
}

std::shared_ptr<const DensityGrid> bounds_of(const Medium& medium, const GridFrame& cells) {
  constexpr int kValues = DensityGrid::kValues;
  return std::make_shared<const DensityGrid>(cells, [&](const Vec3i& origin, float* values) {
    const Vec3d corner = Vec3d(origin) - 0.5;
    if (bound_in(medium, cells, corner, corner + double{kValues}) == 0.0) {
      values[0] = 0.0f;
      return DensityGrid::Filled::one;
    }
    for (int z = 0, n = 0; z < kValues; ++z)
      for (int y = 0; y < kValues; ++y)
        for (int x = 0; x < kValues; ++x, ++n) {
          const Vec3i voxel = origin + Vec3i(x, y, z);
          const bool inside =
              glm::all(glm::greaterThanEqual(voxel, cells.lo)) && glm::all(glm::lessThanEqual(voxel, cells.hi));
          const Vec3d lo = Vec3d(voxel) - 0.5;
          const double bound = inside ? bound_in(medium, cells, lo, lo + 1.0) : 0.0;
          values[n] = static_cast<float>((1.0 + kAbove) * bound);
        }
    return DensityGrid::Filled::all;
  });
}

}  // namespace

EmittingVolume::EmittingVolume(const Medium& medium, const Box& around)
    : bounds_(bounds_of(medium, frame_of(medium, around))) {
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
  const GridFrame& frame = bounds_->frame();
  for (int z = frame.lo.z; z <= frame.hi.z; ++z)
    for (int y = frame.lo.y; y <= frame.hi.y; ++y)
      for (int x = frame.lo.x; x <= frame.hi.x; ++x) {
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
