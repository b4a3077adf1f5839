// The grid, what of it is dense, and a stage around that.
#include "vpm/input/view_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "vpm/base/error.h"
#include "vpm/base/letters.h"
#include "vpm/medium/emission.h"
#include "vpm/medium/grid/density_grid_walk.h"

namespace vpm {
namespace {

bool is_level_set(const GridSummary& grid) { return grid.grid_class == "level set"; }
bool holds_values(const GridSummary& grid) { return grid.numbers && grid.active_voxels > 0; }

/// "density (float, fog volume), Cd (vec3s, unknown)".
std::string list_of(const std::vector<GridSummary>& grids) {
  std::vector<std::string> names;
  for (const GridSummary& grid : grids)
    names.push_back(fmt::format("{} ({}, {}{})", grid.name.empty() ? "(unnamed)" : grid.name, grid.value_type,
                                grid.grid_class, grid.active_voxels > 0 ? "" : ", no active voxels"));
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

constexpr int kColumns = 128;  // along an edge

/// What of a grid is dense.
struct DensePart {
  Box box;             // m
  double depth = 0.0;  // the integral of the density across, 1/m of extinction at density 1 times m
};

/// Calls visit(ray, length) for rays along an axis of the world through the middles of columns of a box.
void visit_columns(const Box& box, int axis, const std::function<void(const Ray& ray, double length)>& visit) {
  const Vec3d lo(box.lo), step = (Vec3d(box.hi) - lo) / double{kColumns};
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (int i = 0; i < kColumns; ++i)
    for (int j = 0; j < kColumns; ++j) {
      Vec3d origin = lo, direction(0.0);
      origin[u] += (i + 0.5) * step[u];
      origin[v] += (j + 0.5) * step[v];
      direction[axis] = 1.0;
      visit({Vec3(origin), Vec3(direction)}, kColumns * step[axis]);
    }
}

/// The largest density at the ends of a piece and in its middle.
double density_in(const DensityPiece& piece) {
  const double length = piece.length();
  return std::max({piece.c0, piece.density(0.5 * length), piece.density(length)});
}

/// What is measured along columns in all axes of the world, with exact integrals; the depth by those along `across`:
/// that below which nine tenths of the columns stay which meet something dense.
DensePart dense_part(const DensityGrid& grid, const Box& box, int across) {
  constexpr double kDense = 0.01;  // of the largest density
  constexpr double kShare = 0.9;
  double largest = 0.0;
  const auto visit = [&](int axis, const auto& each) {
    visit_columns(box, axis, [&](const Ray& ray, double length) {
      each(ray, Interval{0.0f, static_cast<float>(length)});
    });
  };
  for (int axis = 0; axis < 3; ++axis)
    visit(axis, [&](const Ray& ray, const Interval& interval) {
      grid.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
        largest = std::max(largest, density_in(piece));
        return true;
      });
    });
  const double dense = kDense * largest;
  DensePart part;
  std::vector<double> depths;
  for (int axis = 0; axis < 3; ++axis)
    visit(axis, [&](const Ray& ray, const Interval& interval) {
      double depth = 0.0;
      bool meets_dense = false;
      grid.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
        depth += piece.integral();
        if (density_in(piece) <= dense) return true;
        meets_dense = true;
        for (const double t : {piece.t0, piece.t1}) part.box.add(ray.at(static_cast<float>(t)));
        return true;
      });
      if (meets_dense && axis == across) depths.push_back(depth);
    });
  if (depths.empty()) return {};
  const auto high = depths.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(depths.size()));
  std::nth_element(depths.begin(), high, depths.end());
  part.depth = *high;
  return part;
}

/// Axes of the picture in the world.
struct Axes {
  Vec3d right, up, ahead;  // unit
};
Axes axes_of(UpAxis up) {
  if (up == UpAxis::y) return {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  return {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
}

/// Where things stand, m.
struct Stage {
  Vec3d target, camera, floor, lamp;
  double floor_radius, lamp_angle;  // half of the cone's, degrees
  double lamp_distance;
};

constexpr double kFov = 35.0;  // degrees

/// The distance from which all corners of a box are seen, in a frame with some air.
double distance_to_see(const Box& box, const Vec3d& middle, const Vec3d& towards_camera, const Axes& axes,
                       double aspect) {
  constexpr double kFilled = 0.85;  // of the frame
  const Vec3d right = glm::normalize(glm::cross(axes.up, towards_camera)), up = glm::cross(towards_camera, right);
  const double slope = kFilled * std::tan(glm::radians(0.5 * kFov));
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p =
        Vec3d(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z) -
        middle;
    const double off = std::max(std::abs(glm::dot(p, right)) / aspect, std::abs(glm::dot(p, up)));
    distance = std::max(distance, glm::dot(p, towards_camera) + off / slope);
  }
  return distance;
}

Stage stage_for(const Box& box, const ViewWishes& wishes) {
  const Axes axes = axes_of(wishes.up);
  const Vec3d lo(box.lo), hi(box.hi), middle = 0.5 * (lo + hi);
  const double radius = 0.5 * glm::length(hi - lo), height = glm::dot(hi - lo, axes.up);
  const Vec3d towards_camera = glm::normalize(0.2 * axes.right + 0.22 * axes.up - axes.ahead);
  const Vec3d towards_lamp = glm::normalize(-1.0 * axes.right + 1.1 * axes.up + 0.35 * axes.ahead);
  Stage stage{};
  stage.target = middle;
  stage.camera = middle + distance_to_see(box, middle, towards_camera, axes, wishes.aspect) * towards_camera;
  stage.floor = middle - 0.52 * height * axes.up;
  stage.floor_radius = 3.0 * radius;
  stage.lamp_distance = 3.5 * radius;
  stage.lamp = middle + stage.lamp_distance * towards_lamp;
  stage.lamp_angle = glm::degrees(std::asin(1.15 * radius / stage.lamp_distance));
  return stage;
}

/// As floats, which is what a scene makes of them: the shortest text that reads back.
std::string toml_vector(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
std::string toml_string(const std::string& s) {
  std::string out = "\"";
  for (const char c : s) out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return out + '"';
}

/// A grid beside the density that tells of fire, and how its values are read as kelvin.
struct ShownFire {
  std::string grid, reading;
  double scale = 1.0, offset = 0.0;
};

/// What is read of the grid.
struct ShownGrid {
  std::string path_in_scene, name;
  bool from_level_set, clamp_negative;
  std::optional<Box> bounds;  // m, where it has a background that would fill all space
  std::optional<ShownFire> fire{};
};

/// A shape that ends a medium with a background.
std::string bounds_text(const std::optional<Box>& bounds) {
  if (!bounds) return "";
  return fmt::format(
      "[[shapes]]\nname = \"bounds\"  # the box of the grid's voxels: its background would fill all space\ntype = "
      "\"box\"\nmaterial = {{ type = \"boundary\" }}\nmin = {}\nmax = {}\ninside = \"medium\"\n\n",
      toml_vector(bounds->lo), toml_vector(bounds->hi));
}

/// The largest value of the first grid of these names beside that of the density; nothing where there is none above 0.
struct LargestOfGrid {
  std::string grid;
  double value = 0.0;
};
std::optional<LargestOfGrid> find_glowing(const std::string& path, const std::vector<GridSummary>& grids,
                                          const std::string& density, std::initializer_list<std::string_view> names,
                                          std::vector<std::string>& notes) {
  for (const std::string_view name : names)
    for (const GridSummary& grid : grids) {
      if (small_letters(grid.name) != name || grid.name == density || !holds_values(grid) || is_level_set(grid))
        continue;
      try {
        const double largest = load_grid({.path = path, .name = grid.name, .density = false}).grid->max_density();
        if (largest > 0.0) return LargestOfGrid{grid.name, largest};
      } catch (const InputError& error) {
        notes.push_back(fmt::format("grid '{}' is not shown as fire: {}", grid.name, error.what()));
      }
    }
  return std::nullopt;
}

/// What a file has beside the density that may glow: temperatures first. Files do not say what their numbers mean.
std::optional<ShownFire> find_fire(const std::string& path, const std::vector<GridSummary>& grids,
                                   const std::string& density, std::vector<std::string>& notes) {
  constexpr double kUsual = 2000.0, kAmbient = 200.0;        // K
  constexpr double kFlameCold = 1500.0, kFlameHot = 3000.0;  // K: as Blender shows flames of 0 to 1
  const auto find = [&](std::initializer_list<std::string_view> names) {
    return find_glowing(path, grids, density, names, notes);
  };
  const std::optional<LargestOfGrid> temperature = find({"temperature", "temperatures", "heat"});
  if (temperature && temperature->value >= kColdestFire && temperature->value <= kHottestFire)
    return ShownFire{temperature->grid, fmt::format("as kelvin, up to {:.4g}", temperature->value)};
  const std::optional<LargestOfGrid> flame = find({"flame", "flames", "fire", "burn"});
  if (flame && flame->value <= 1.0)
    return ShownFire{flame->grid, fmt::format("of 0 to 1 as {:g} to {:g} K", kFlameCold, kFlameHot),
                     kFlameHot - kFlameCold, kFlameCold};
  const std::optional<LargestOfGrid>& other = temperature ? temperature : flame;
  if (!other || (other->value >= kAmbient && other->value < kColdestFire)) return std::nullopt;  // air or warm smoke
  return ShownFire{other->grid, fmt::format("such that the largest, {:.4g}, is {:g} K", other->value, kUsual),
                   kUsual / other->value};
}

std::string emission_text(const std::optional<ShownFire>& fire) {
  if (!fire) return "";
  return fmt::format(
      "emission = {{ temperature = {{ grid = {}, scale = {:.6g}, offset = {:g} }} }}  # values {}: offset + scale * "
      "value\n",
      toml_string(fire->grid), fire->scale, fire->offset, fire->reading);
}

std::string scene_text(const ShownGrid& grid, double sigma_t, const ViewWishes& wishes, const Stage& stage) {
  const Vec3d up = axes_of(wishes.up).up;
  const double irradiance = 10.0;  // W/m^2, of the lamp in the middle
  const Vec3d intensity = irradiance * stage.lamp_distance * stage.lamp_distance * Vec3d(1.0, 0.8, 0.55);
  std::string keys;
  if (!grid.name.empty()) keys += fmt::format("grid = {}\n", toml_string(grid.name));
  if (grid.from_level_set) keys += "from_level_set = true  # a fog of density 1 inside\n";
  if (grid.clamp_negative) keys += "clamp_negative = true  # negative densities are read as 0\n";
  return fmt::format(
      R"(# A grid of {path}, as vpm view shows it: a medium over a round floor, lit by a warm spot and a dim sky. What is
# "auto" is chosen by vpm render after a short pilot.

[camera]
position = {camera}
target = {target}
up = {up}
fov = {fov}

[film]
width = 512
height = 512
filter = "gaussian"

[media.medium]
type = "grid"
path = {path}
{keys}sigma_t = {sigma_t:.4g}  # 1/m at density 1: an optical depth of about {depth:g} across
albedo = {albedo}
phase = {{ type = "henyey-greenstein", g = 0.3 }}
{emission}
[materials.floor]
type = "lambertian"
reflectance = [0.32, 0.30, 0.28]

[[shapes]]
name = "floor"
type = "disc"
material = "floor"
center = {floor}
normal = {up}
radius = {floor_radius}

{bounds}[[lights]]
name = "lamp"
type = "spot"
position = {lamp}
target = {target}
inner_angle = {inner:.4g}  # degrees from the axis: all of the medium is lit
outer_angle = {outer:.4g}
intensity = {intensity}  # W/sr

[[lights]]
name = "sky"
type = "environment"
radiance = [0.045, 0.065, 0.11]  # W/(m^2 sr)

[render]
seconds = 20

[integrator]
type = "auto"
)",
      fmt::arg("path", toml_string(grid.path_in_scene)), fmt::arg("camera", toml_vector(Vec3(stage.camera))),
      fmt::arg("target", toml_vector(Vec3(stage.target))), fmt::arg("up", toml_vector(Vec3(up))), fmt::arg("fov", kFov),
      fmt::arg("keys", keys), fmt::arg("emission", emission_text(grid.fire)),
      fmt::arg("albedo", grid.fire ? "0.8  # soot" : "[0.96, 0.95, 0.94]"), fmt::arg("sigma_t", sigma_t),
      fmt::arg("depth", wishes.optical_depth), fmt::arg("floor", toml_vector(Vec3(stage.floor))),
      fmt::arg("floor_radius", static_cast<float>(stage.floor_radius)), fmt::arg("bounds", bounds_text(grid.bounds)),
      fmt::arg("lamp", toml_vector(Vec3(stage.lamp))), fmt::arg("inner", stage.lamp_angle),
      fmt::arg("outer", 1.25 * stage.lamp_angle), fmt::arg("intensity", toml_vector(Vec3(intensity))));
}

}  // namespace

std::string grid_to_show(const std::string& path, const std::vector<GridSummary>& grids, const std::string& wish) {
  /// The grid of this name, or else the only one in other letters of which may_be is true; "" where there is none.
  const auto named = [&](const std::string& name, auto may_be) {
    std::vector<std::string> in_other_letters;
    for (const GridSummary& grid : grids) {
      if (!may_be(grid)) continue;
      if (grid.name == name) return name;
      if (small_letters(grid.name) == small_letters(name)) in_other_letters.push_back(grid.name);
    }
    return in_other_letters.size() == 1 ? in_other_letters[0] : "";
  };
  if (!wish.empty()) {
    const std::string found = named(wish, [](const GridSummary&) { return true; });
    if (found.empty())
      throw InputError(fmt::format("{}: there is no grid '{}'; there are: {}", path, wish, list_of(grids)));
    return found;
  }
  if (const std::string density = named("density", holds_values); !density.empty()) return density;
  std::vector<std::string> names;
  for (const GridSummary& grid : grids)
    if (holds_values(grid)) names.push_back(grid.name);
  if (names.size() == 1) return names[0];
  if (names.empty())
    throw InputError(
        fmt::format("{}: no grid can be a density, which is of one number a voxel and has active voxels; "
                    "there are: {}",
                    path, list_of(grids)));
  throw InputError(fmt::format("{}: several grids could be meant; name one with --grid, as --grid '{}': {}", path,
                               names[0], list_of(grids)));
}

ViewScene make_view_scene(const std::string& path, const std::string& path_in_scene, const ViewWishes& wishes) {
  std::vector<GridSummary> grids = list_headings(path);
  if (std::none_of(grids.begin(), grids.end(), holds_values))
    grids = list_grids(path);  // of files that state no voxels
  const std::string name = grid_to_show(path, grids, wishes.grid);
  const bool level_set = is_level_set(
      *std::find_if(grids.begin(), grids.end(), [&](const GridSummary& grid) { return grid.name == name; }));
  ViewScene scene;
  scene.request = {.path = path,
                   .name = name,
                   .from_level_set = level_set,
                   .clamp_negative = !level_set,
                   .has_bounding_shape = !level_set};
  scene.grid = load_grid(scene.request);
  const DensityGrid& loaded = *scene.grid.grid;
  scene.request.clamp_negative = scene.grid.clamped_values > 0;
  scene.request.has_bounding_shape = loaded.frame().background > 0.0f;
  const GridFrame& frame = loaded.frame();
  std::optional<Box> bounds;
  if (scene.request.has_bounding_shape) bounds = world_box(frame.index_to_world, frame.lo, frame.hi);
  const DensePart part = dense_part(loaded, bounds.value_or(loaded.bounds()), wishes.up == UpAxis::y ? 2 : 1);
  if (part.depth == 0.0)
    throw InputError(
        loaded.max_density() > 0.0f
            ? fmt::format("{}: what the grid '{}' holds is too little to be met by {} x {} columns across its box, by "
                          "which the view would go: write a scene file for it",
                          path, name, kColumns, kColumns)
            : fmt::format("{}: the grid '{}' is 0 everywhere", path, name));
  const double sigma_t = wishes.optical_depth / part.depth;
  const std::optional<ShownFire> fire = find_fire(path, grids, name, scene.notes);
  scene.text = scene_text({path_in_scene, name, level_set, scene.request.clamp_negative, bounds, fire}, sigma_t, wishes,
                          stage_for(part.box, wishes));
  scene.notes.push_back(
      fmt::format("grid '{}'{}: sigma_t {:.4g} 1/m at density 1, an optical depth of {:g} across (--optical-depth)",
                  name, level_set ? ", a level set, as a fog of density 1 inside" : "", sigma_t, wishes.optical_depth));
  if (fire)
    scene.notes.push_back(fmt::format(
        "grid '{}' glows, its values read {} unless --set media.medium.emission.temperature.scale=..., or .offset, "
        "says otherwise; --set media.medium.emission_scale=0.1 dims it",
        fire->grid, fire->reading));
  return scene;
}

}  // namespace vpm
