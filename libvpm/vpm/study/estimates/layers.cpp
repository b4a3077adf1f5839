// From nodes to grids.
#include "vpm/study/estimates/layers.h"

#include <fmt/format.h>

#include "vpm/base/error.h"
#include "vpm/medium/grid/make_grid.h"

namespace vpm {
namespace {

constexpr int kFinest = 1 << 14;  // lattice intervals in a section, at most
// More voxels than the layers need: interpolation makes the density fall to zero in the cells outside, and those
// should not count for much in the mean density, at which a strategy draws.
constexpr int kCoarsest = 16;  // lattice intervals in a section, at least
constexpr int kAcross = 8;     // intervals in x and z

/// A range of nodes.
struct Section {
  size_t first, last;
};

/// The ranges of nodes between jumps.
std::vector<Section> continuous_sections(const Layers& layers) {
  std::vector<Section> sections{{0, 0}};
  for (size_t i = 1; i < layers.depth.size(); ++i) {
    if (layers.depth[i] == layers.depth[i - 1])
      sections.push_back({i, i});
    else
      sections.back().last = i;
  }
  return sections;
}

bool is_constant(const Layers& layers, const Section& s) {
  for (size_t i = s.first; i <= s.last; ++i)
    if (layers.sigma_t[i] != layers.sigma_t[s.first]) return false;
  return true;
}

/// The least number of equal intervals that have all nodes of the section among their ends.
int lattice_intervals(const Layers& layers, const Section& s) {
  const double lo = layers.depth[s.first], extent = layers.depth[s.last] - lo;
  for (int n = 1; n <= kFinest; ++n) {
    bool fits = true;
    for (size_t i = s.first; i <= s.last && fits; ++i) {
      const double place = (layers.depth[i] - lo) / extent * n;
      fits = std::abs(place - std::round(place)) < 1e-6;
    }
    if (fits) return n;
  }
  throw InputError(fmt::format("layers: the depths lie on no lattice of at most {} intervals", kFinest));
}

double extinction_at(const Layers& layers, const Section& s, double depth) {
  for (size_t i = s.first + 1; i <= s.last; ++i) {
    if (depth > layers.depth[i]) continue;
    const double share = (depth - layers.depth[i - 1]) / (layers.depth[i] - layers.depth[i - 1]);
    return layers.sigma_t[i - 1] + share * (layers.sigma_t[i] - layers.sigma_t[i - 1]);
  }
  return layers.sigma_t[s.last];
}

/// A grid of voxels across, wider than the layers, whose voxel j stands for the depth `top` + (j + offset) step.
GridFrame wide_frame(double width, double top, double step, double offset, int voxels) {
  const double across = 2.0 * width / kAcross;
  GridFrame frame;
  frame.hi = Vec3i(kAcross, voxels - 1, kAcross);
  frame.index_to_world =
      Mat4d(across, 0, 0, 0, 0, -step, 0, 0, 0, 0, across, 0, -width, -(top + offset * step), -width, 1);
  return frame;
}

/// The section's extinction in a medium: sigma_t = 1/m at density 1.
Medium section_medium(const Layers& layers, const Section& s, double width, Interpolation interpolation) {
  const int least = lattice_intervals(layers, s), n = least * ((kCoarsest + least - 1) / least);
  const double top = layers.depth[s.first], step = (layers.depth[s.last] - top) / n;
  const bool nearest = interpolation == Interpolation::nearest;
  GridFrame frame = wide_frame(width, top, step, nearest ? 0.5 : 0.0, nearest ? n : n + 1);
  frame.interpolation = interpolation;
  const auto value = [&](int, int j, int) {
    return extinction_at(layers, s, top + (j + (nearest ? 0.5 : 0.0)) * step);
  };
  return make_medium(make_grid(frame, value), Rgb(1.0f));
}

/// Are there jumps, and nothing but constant parts between them?
bool is_steps(const Layers& layers, const std::vector<Section>& sections) {
  for (const Section& s : sections)
    if (!is_constant(layers, s)) return false;
  return sections.size() > 1;
}

}  // namespace

LayeredMedia layered_media(const Layers& layers, double width) {
  const std::vector<Section> sections = continuous_sections(layers);
  if (is_steps(layers, sections)) {
    const Section all{0, layers.depth.size() - 1};
    return {{section_medium(layers, all, width, Interpolation::nearest)}, {layers.thickness()}};
  }
  LayeredMedia result;
  for (const Section& s : sections) {
    result.media.push_back(is_constant(layers, s)
                               ? make_medium(nullptr, Rgb(static_cast<float>(layers.sigma_t[s.first])))
                               : section_medium(layers, s, width, Interpolation::trilinear));
    result.bottoms.push_back(layers.depth[s.last]);
  }
  return result;
}

}  // namespace vpm
