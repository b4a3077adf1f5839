// Slabs as scenes: the extinction in grids that represent it exactly, wide boundaries, and the light.
#include <fmt/format.h>
#include <array>

#include "base/error.h"
#include "medium/make_grid.h"
#include "scene/build.h"
#include "study/estimates/slab.h"

namespace vpm {
namespace {

constexpr double kHalfWidth = 1e3;  // in thicknesses
constexpr int kFinest = 1 << 14;    // lattice intervals in a section

/// A range of nodes.
struct Section {
  size_t first, last;
};

/// The ranges of nodes between jumps.
std::vector<Section> continuous_sections(const Slab& slab) {
  std::vector<Section> sections{{0, 0}};
  for (size_t i = 1; i < slab.depth.size(); ++i) {
    if (slab.depth[i] == slab.depth[i - 1])
      sections.push_back({i, i});
    else
      sections.back().last = i;
  }
  return sections;
}

bool is_constant(const Slab& slab, const Section& s) {
  for (size_t i = s.first; i <= s.last; ++i)
    if (slab.sigma_t[i] != slab.sigma_t[s.first]) return false;
  return true;
}

/// The least number of equal intervals that have all nodes of the section among their ends.
int lattice_intervals(const Slab& slab, const Section& s) {
  const double lo = slab.depth[s.first], extent = slab.depth[s.last] - lo;
  for (int n = 1; n <= kFinest; ++n) {
    bool fits = true;
    for (size_t i = s.first; i <= s.last && fits; ++i) {
      const double place = (slab.depth[i] - lo) / extent * n;
      fits = std::abs(place - std::round(place)) < 1e-6;
    }
    if (fits) return n;
  }
  throw InputError(fmt::format("slab: its depths lie on no lattice of at most {} intervals", kFinest));
}

double extinction_at(const Slab& slab, const Section& s, double depth) {
  for (size_t i = s.first + 1; i <= s.last; ++i) {
    if (depth > slab.depth[i]) continue;
    const double share = (depth - slab.depth[i - 1]) / (slab.depth[i] - slab.depth[i - 1]);
    return slab.sigma_t[i - 1] + share * (slab.sigma_t[i] - slab.sigma_t[i - 1]);
  }
  return slab.sigma_t[s.last];
}

/// A grid of 2 x n x 2 voxels, wider than the slab, whose voxel j stands for the depth `top` + (j + offset) step.
GridFrame wide_frame(double width, double top, double step, double offset, int voxels) {
  GridFrame frame;
  frame.hi = Vec3i(1, voxels - 1, 1);
  frame.index_to_world = Mat4d(4.0 * width, 0, 0, 0, 0, -step, 0, 0, 0, 0, 4.0 * width, 0, -2.0 * width,
                               -(top + offset * step), -2.0 * width, 1);
  return frame;
}

/// The section's extinction in a medium: sigma_t = 1/m at density 1.
Medium section_medium(const Slab& slab, const Section& s, Interpolation interpolation) {
  const int n = lattice_intervals(slab, s);
  const double top = slab.depth[s.first], step = (slab.depth[s.last] - top) / n;
  const bool nearest = interpolation == Interpolation::nearest;
  GridFrame frame = wide_frame(kHalfWidth * slab.thickness(), top, step, nearest ? 0.5 : 0.0, nearest ? n : n + 1);
  frame.interpolation = interpolation;
  const auto value = [&](int, int j, int) { return extinction_at(slab, s, top + (j + (nearest ? 0.5 : 0.0)) * step); };
  return make_medium(make_grid(frame, value), Rgb(1.0f));
}

/// The steps of a slab in one grid: a section that holds all nodes, jumps included.
bool is_steps(const Slab& slab, const std::vector<Section>& sections) {
  for (const Section& s : sections)
    if (!is_constant(slab, s)) return false;
  return sections.size() > 1;
}

/// A boundary across all of the slab; off its centre, so that the diagonal that divides the quad is far from the light.
void add_plane(Scene& scene, double depth, double width, const Interface& media) {
  const Vec3d corner(-1.1 * width, -depth, -1.4 * width);
  add_shape(scene, quad_mesh(corner, Vec3d(0.0, 0.0, 2.5 * width), Vec3d(2.5 * width, 0.0, 0.0)), Boundary{}, &media);
}

/// Mirrors at x = +-width and z = +-width, higher than the slab by as little as leaves no gap.
void add_walls(Scene& scene, double thickness, double width) {
  const double gap = 1e-6 * thickness;
  const Vec3d up(0.0, thickness + 2.0 * gap, 0.0), bottom(0.0, -thickness - gap, 0.0);
  for (const double side : {-1.0, 1.0}) {
    const double far = 1.01 * width;
    add_shape(scene, quad_mesh(bottom + Vec3d(side * width, 0.0, -far), up, Vec3d(0.0, 0.0, 2.0 * far)), Mirror{});
    add_shape(scene, quad_mesh(bottom + Vec3d(-far, 0.0, side * width), up, Vec3d(2.0 * far, 0.0, 0.0)), Mirror{});
  }
}

void add_medium(Scene& scene, const Slab& slab, Medium medium) {
  medium.sigma_s = static_cast<float>(slab.albedo) * medium.sigma_t;
  if (slab.g != 0.0) medium.phase = HenyeyGreenstein{static_cast<float>(slab.g)};
  scene.media.push_back(std::move(medium));
}

Light light_on(const Slab& slab, SlabLight light) {
  const auto size = static_cast<float>(slab.thickness());
  if (slab.incidence == Incidence::collimated) {
    if (light == SlabLight::everywhere) return DirectionalLight{};
    return BeamLight{Vec3(0.0f, size, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.01f * size, Rgb(1.0f)};
  }
  if (light == SlabLight::everywhere) {
    std::vector<Rgb> sky{Rgb(1.0f / kPi), Rgb(0.0f)};  // above, below
    return EnvironmentMap{std::make_shared<const ImageEnvironment>(1, 2, std::move(sky))};
  }
  return QuadLight{0.5f * size * Vec3(-1.0f, 0.002f, -1.0f), Vec3(size, 0.0f, 0.0f), Vec3(0.0f, 0.0f, size),
                   Rgb(1.0f / (kPi * size * size))};
}

}  // namespace

Slab homogeneous_slab(double optical_thickness, double albedo, double g, Incidence incidence) {
  return {{0.0, 1.0}, {optical_thickness, optical_thickness}, albedo, g, incidence};
}

Scene slab_scene(const Slab& slab, SlabLight light) {
  const double width = kHalfWidth * slab.thickness();
  const std::vector<Section> sections = continuous_sections(slab);
  Scene scene;
  add_plane(scene, 0.0, width, {0, kVacuum});
  if (is_steps(slab, sections)) {
    add_medium(scene, slab, section_medium(slab, {0, slab.depth.size() - 1}, Interpolation::nearest));
  } else {
    for (const Section& s : sections) {
      const bool constant = is_constant(slab, s);
      add_medium(scene, slab,
                 constant ? make_medium(nullptr, Rgb(static_cast<float>(slab.sigma_t[s.first])))
                          : section_medium(slab, s, Interpolation::trilinear));
      const auto below = static_cast<MediumId>(scene.media.size());
      if (s.last + 1 < slab.depth.size()) add_plane(scene, slab.depth[s.last], width, {below, below - 1});
    }
  }
  add_plane(scene, slab.thickness(), width, {kVacuum, static_cast<MediumId>(scene.media.size()) - 1});
  add_walls(scene, slab.thickness(), width);
  scene.lights.push_back(light_on(slab, light));
  scene.geometry.commit();
  finish(scene);
  return scene;
}

}  // namespace vpm
