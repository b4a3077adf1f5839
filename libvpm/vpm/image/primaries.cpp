// Primaries as matrices to X, Y and Z, and white points adapted between them.
#include "vpm/image/primaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vpm/base/error.h"
#include "vpm/base/letters.h"

namespace vpm {
namespace {

glm::dvec3 xyz_of(const glm::dvec2& xy) { return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y}; }

/// So that red, green and blue of 1 each are white of luminance 1. Primaries of no luminance have directions alone.
glm::dmat3 to_xyz(const Primaries& p) {
  const auto direction = [](const glm::dvec2& xy) { return glm::dvec3(xy.x, xy.y, 1.0 - xy.x - xy.y); };
  const glm::dmat3 columns(direction(p.red), direction(p.green), direction(p.blue));
  const glm::dvec3 amounts = glm::inverse(columns) * xyz_of(p.white);
  return {amounts.x * columns[0], amounts.y * columns[1], amounts.z * columns[2]};
}

/// Scales what cones answer, as Bradford's matrix has it, from one white to another.
glm::dmat3 adaptation(const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dmat3 cones =
      glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
  const glm::dvec3 scale = (cones * xyz_of(to)) / (cones * xyz_of(from));
  return glm::inverse(cones) * glm::dmat3(scale.x, 0.0, 0.0, 0.0, scale.y, 0.0, 0.0, 0.0, scale.z) * cones;
}

}  // namespace

bool Primaries::are_those_of_rec709() const {
  if (*this == Primaries{glm::dvec2(0.0), glm::dvec2(0.0), glm::dvec2(0.0), glm::dvec2(0.0)}) return true;
  constexpr double kDigits = 1e-4;
  const Primaries rec709;
  const auto near = [](const glm::dvec2& a, const glm::dvec2& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= kDigits;
  };
  return near(red, rec709.red) && near(green, rec709.green) && near(blue, rec709.blue) && near(white, rec709.white);
}

bool is_encoded(const std::string& colour_space) {
  const std::string name = small_letters(colour_space);
  for (const char* begin : {"srgb", "g22", "g24", "g18", "gamma", "rec709_display", "acescc"})
    if (name.starts_with(begin) && name != "acescg") return true;
  return false;
}

/// Of Rec. 2020 [ITU2017]; AP0 and AP1 of SMPTE ST 2065-1 and of the Academy's S-2014-004; P3 of SMPTE RP 431-2 with
/// the white of D65.
std::optional<Primaries> primaries_named(const std::string& colour_space) {
  const std::string name = small_letters(colour_space);
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const glm::dvec2 of_aces(0.32168, 0.33767);
  if (is({"lin_rec709_scene", "lin_rec709", "linear", "scene_linear", "lin_srgb", "linear rec.709 (srgb)"}))
    return Primaries{};
  if (is({"lin_ap1_scene", "lin_ap1", "acescg"}))
    return Primaries{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, of_aces};
  if (is({"lin_ap0_scene", "lin_ap0", "aces2065-1", "aces2065_1"}))
    return Primaries{{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, of_aces};
  if (is({"lin_rec2020_scene", "lin_rec2020", "linear rec.2020"}))
    return Primaries{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}};
  if (is({"lin_p3d65_scene", "lin_p3d65", "linear p3-d65"}))
    return Primaries{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}};
  return std::nullopt;
}

std::string conversion_text(const Primaries& primaries) {
  const auto xy = [](const glm::dvec2& p) { return fmt::format("({:.4g}, {:.4g})", p.x, p.y); };
  return fmt::format("its colours, of the primaries {}, {}, {} and the white {}, are converted to Rec. 709",
                     xy(primaries.red), xy(primaries.green), xy(primaries.blue), xy(primaries.white));
}

glm::dmat3 to_rec709(const Primaries& primaries) {
  const Primaries rec709;
  const glm::dmat3 matrix =
      glm::inverse(to_xyz(rec709)) * adaptation(primaries.white, rec709.white) * to_xyz(primaries);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!std::isfinite(matrix[i][j])) throw InputError("its primaries (attribute 'chromaticities') span no colours");
  return matrix;
}

}  // namespace vpm
