// Checks of the values, layer by layer, and the bricks made of them.
#include "vpm/input/grid/grid_values.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/base/parallel.h"

namespace vpm {
namespace {

/// What there is of one kind of value.
struct Found {
  uint64_t count = 0;
  Vec3i first{0};
};

/// What the values of a layer, those of one i, are.
struct Survey {
  Vec3i lo{std::numeric_limits<int>::max()}, hi{-1};  // of values other than 0
  Found broken, negative;

  void add(const Vec3i& voxel, float value) {
    if (value == 0.0f) return;
    lo = glm::min(lo, voxel);
    hi = glm::max(hi, voxel);
    if (Found* fault = !std::isfinite(value) ? &broken : value < 0.0f ? &negative : nullptr; fault)
      if (fault->count++ == 0) fault->first = voxel;
  }
  void merge(const Survey& later) {
    lo = glm::min(lo, later.lo);
    hi = glm::max(hi, later.hi);
    for (Found Survey::*fault : {&Survey::broken, &Survey::negative}) {
      if ((this->*fault).count == 0) (this->*fault).first = (later.*fault).first;
      (this->*fault).count += (later.*fault).count;
    }
  }
};

Survey survey_of(const GridValues& values) {
  std::vector<Survey> layers(static_cast<size_t>(values.count.x));
  parallel_for_chunks(layers.size(), 1, [&](size_t begin, size_t, size_t) {
    for (Vec3i p(static_cast<int>(begin), 0, 0); p.y < values.count.y; ++p.y)
      for (p.z = 0; p.z < values.count.z; ++p.z) layers[begin].add(p, values.at(p));
  });
  Survey all;
  for (const Survey& layer : layers) all.merge(layer);
  return all;
}

[[noreturn]] void refuse_values(const GridValues& values, const Found& fault, const std::string& kind,
                                const std::string& remedy) {
  const Vec3i& p = fault.first;
  throw InputError(fmt::format("the array has {} {} value{}, the first ({}) at [{}, {}, {}]{}", fault.count, kind,
                               fault.count == 1 ? "" : "s", values.at(p), p.x, p.y, p.z, remedy));
}

Mat4d world_matrix_of(const GridValues& values, const GridRequest& request) {
  const Mat4d& own = values.index_to_world;
  for (int i = 0; i < 4; ++i)
    if (own[i][3] != (i == 3 ? 1.0 : 0.0))
      throw InputError(
          "the last row of the array's transform must be 0, 0, 0, 1: the translation is the fourth column");
  const Mat4d m = request.object_to_world * own;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(m[i][j])) throw InputError("the array has a transform that is not finite");
  const double box = glm::length(Vec3d(m[0])) * glm::length(Vec3d(m[1])) * glm::length(Vec3d(m[2]));
  if (!(std::abs(glm::determinant(Mat3d(m))) > 1e-9 * box))
    throw InputError("the array has a transform that flattens space");
  return m;
}

}  // namespace

LoadedGrid density_of(const GridValues& values, const GridRequest& request) {
  const Mat4d index_to_world = world_matrix_of(values, request);
  const Survey survey = survey_of(values);
  if (survey.broken.count > 0) refuse_values(values, survey.broken, "NaN or infinite", "");
  if (survey.negative.count > 0 && !request.clamp_negative)
    refuse_values(values, survey.negative, "negative", "; clamp_negative = true reads them as 0");
  if (survey.hi.x < 0) throw InputError("the array has no value other than 0");
  const GridFrame frame{index_to_world, survey.lo, survey.hi, request.interpolation, 0.0f};
  const auto fill = [&](const Vec3i& origin, float* brick) {
    for (int z = 0; z < DensityGrid::kValues; ++z)
      for (int y = 0; y < DensityGrid::kValues; ++y)
        for (int x = 0; x < DensityGrid::kValues; ++x, ++brick) {
          const Vec3i p = origin + Vec3i(x, y, z);
          const bool inside = glm::all(glm::greaterThanEqual(p, frame.lo)) && glm::all(glm::lessThanEqual(p, frame.hi));
          *brick = inside ? std::max(0.0f, values.at(p)) : 0.0f;
        }
    return DensityGrid::Filled::all;
  };
  return {std::make_shared<const DensityGrid>(frame, fill), survey.negative.count};
}

std::string hash_of(const GridValues& values) {
  Fnv1a hash;
  const auto add = [&](const auto* first, size_t count) {
    hash.add({reinterpret_cast<const char*>(first), count * sizeof(*first)});
  };
  add(&values.count.x, 3);
  add(&values.index_to_world[0][0], 16);
  std::vector<float> row(static_cast<size_t>(values.count.z));
  for (Vec3i p(0); p.x < values.count.x; ++p.x)
    for (p.y = 0; p.y < values.count.y; ++p.y) {
      for (p.z = 0; p.z < values.count.z; ++p.z) row[static_cast<size_t>(p.z)] = values.at(p);
      add(row.data(), row.size());
    }
  return hash.digits();
}

}  // namespace vpm
