// Transforms: a list of steps becomes one affine matrix.
#include <glm/gtc/matrix_transform.hpp>

#include "vpm/input/sections.h"

namespace vpm {
namespace {

Vec3d to_vector(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

Vec3d read_scale(TableReader& step) {
  if (step.require("scale").array()) return to_vector(step.numbers("scale", 3));
  return Vec3d(step.number("scale", kAny));
}

Mat4d read_rotation(TableReader& step) {
  std::optional<TableReader> rotation = step.table("rotate", "'rotate' of " + step.title());
  const Vec3 axis = rotation->direction("axis");
  const double degrees = rotation->number("degrees", kAny);
  rotation->finish();
  return glm::rotate(Mat4d(1.0), glm::radians(degrees), glm::normalize(Vec3d(axis)));
}

/// 16 numbers, row by row; the last row is 0 0 0 1.
Mat4d read_matrix(TableReader& step) {
  const std::vector<double> m = step.numbers("matrix", 16);
  if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
    step.fail("matrix", "the last row of a matrix must be 0, 0, 0, 1",
              "write it row by row: the translation is the fourth column");
  Mat4d matrix(1.0);
  for (size_t i = 0; i < m.size(); ++i) matrix[static_cast<int>(i % 4)][static_cast<int>(i / 4)] = m[i];
  return matrix;
}

Mat4d read_step(TableReader& step) {
  const bool translate = step.has("translate"), scale = step.has("scale"), rotate = step.has("rotate"),
             matrix = step.has("matrix");
  step.finish();
  if (translate + scale + rotate + matrix != 1)
    step.fail_here(step.title() + " must hold exactly one key",
                   "write one of translate, scale, rotate, matrix in each step");
  if (translate) return glm::translate(Mat4d(1.0), to_vector(step.numbers("translate", 3)));
  if (scale) return glm::scale(Mat4d(1.0), read_scale(step));
  return rotate ? read_rotation(step) : read_matrix(step);
}

}  // namespace

Mat4d read_transform(TableReader& table, const std::string& key) {
  Mat4d transform(1.0);
  if (!table.has(key)) return transform;
  for (TableReader& step : table.tables(key, "'" + key + "' of " + table.title() + ", step"))
    transform = read_step(step) * transform;
  const Mat3d linear(transform);
  const double volume = std::abs(glm::determinant(linear));
  const double edges = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  if (!(volume > 1e-12 * edges))
    table.fail(key, "the transform of " + table.title() + " flattens space: it has no inverse");
  return transform;
}

}  // namespace vpm
