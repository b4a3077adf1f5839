// vpm info: what a file holds.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>

#include "commands.h"
#include "vpm/base/error.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/image/metrics.h"
#include "vpm/input/grid/grid_file.h"
#include "vpm/input/scene_file.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/forecast.h"
#include "vpm/job/lost_light.h"
#include "vpm/render/render.h"

namespace vpm::tools {
namespace {

std::string text(const Vec3d& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }
std::string text(const Vec3& v) { return text(Vec3d(v)); }
std::string rgb(const Rgb& c) { return is_grey(c) ? fmt::format("{:.6g}", c.r) : text(c); }
std::string mebibytes(uint64_t bytes) {
  return fmt::format("{:.2f} MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

void print_grid(const GridSummary& g) {
  fmt::print("grid {}: {}, {}\n", g.name, g.value_type, g.grid_class);
  if (!g.problem.empty()) fmt::print("  cannot be read: {}\n", g.problem);
  if (g.lo.x <= g.hi.x) fmt::print("  world box {} to {} m\n", text(g.world_box.lo), text(g.world_box.hi));
  if (g.values)
    fmt::print("  active values {:.6g} to {:.6g}, mean {:.6g}\n", g.values->min, g.values->max, g.values->mean);
  if (!g.index_to_world)
    fmt::print("  transform not affine\n");
  else
    fmt::print("  voxel size {} m, axes {}\n", text(g.voxel_size),
               g.axis_aligned ? "along the world's" : "rotated or sheared");
  fmt::print("  active voxels {}{}\n", g.active_voxels,
             g.memory_bytes > 0 ? ", memory " + mebibytes(g.memory_bytes) : "");
}

/// What only those ask for who look for a fault.
void print_details(const GridSummary& g) {
  if (g.index_to_world) {
    const Mat3d steps(*g.index_to_world);
    fmt::print("  transform: translation {} m; a step along the axes of the grid is {}, {}, {} m\n",
               text(g.translation), text(steps[0]), text(steps[1]), text(steps[2]));
  }
  if (g.lo.x <= g.hi.x)
    fmt::print("  index box ({}, {}, {}) to ({}, {}, {})\n", g.lo.x, g.lo.y, g.lo.z, g.hi.x, g.hi.y, g.hi.z);
  fmt::print("  active voxels in tiles {}\n", g.active_tiles);
  if (g.background) fmt::print("  background {:.6g}\n", *g.background);
}

/// What a medium emits, and how its grid is read.
void print_emission(const Medium& m) {
  if (!m.emits()) return;
  const MediumEmission& e = *m.emission;
  const DensityGrid* grid = m.emission_grid.get();
  if (e.blackbody)
    fmt::print("  emits {}as a black body of {:.6g} + {:.6g} times the value of its grid: {:.6g} K at the largest\n",
               e.colour == Rgb(1.0f) ? "" : rgb(e.colour) + " times ", e.offset, e.scale,
               e.kelvin(grid ? grid->max_density() : 1.0));
  else if (e.meaning == MediumEmission::Meaning::thermal)
    fmt::print("  emits with absorption and density: a thick layer is of the radiance {} W/(m^2 sr){}\n", rgb(e.colour),
               grid ? " times the value of its grid" : "");
  else
    fmt::print("  emits {} W/m^3{}, whatever the density\n", rgb(e.colour * (4.0f * kPi)),
               grid ? " times the value of its grid" : "");
  if (!grid) return;
  const Box box = grid->bounds();
  fmt::print("  its grid: bounds {} to {} m, voxel {:.6g} m, value mean {:.6g}, max {:.6g}, memory {}\n", text(box.lo),
             text(box.hi), grid->voxel_size(), grid->mean_density(), grid->max_density(),
             mebibytes(grid->memory_bytes()));
}

/// "power 3 W", and of media that emit in lumens, too: watts of vpm are as the eye counts them.
std::string power_text(const Light& light, const Box& bounds) {
  constexpr double kLumens = 683.002;  // of a watt
  const Rgb power = light_power(light, bounds);
  const std::string watts = fmt::format("power {} W", rgb(power));
  if (!std::holds_alternative<VolumeLight>(light)) return watts;
  return fmt::format("{}, about {:.4g} lm", watts, kLumens * luminance(power));
}

void print_medium(const Medium& m) {
  fmt::print("medium {}: {}\n  sigma_s {} 1/m, sigma_t {} 1/m, albedo {}\n", m.name,
             m.homogeneous() ? "homogeneous" : "grid", rgb(m.sigma_s), rgb(m.sigma_t), rgb(m.albedo()));
  if (m.grid) {
    const Box box = m.grid->bounds();
    fmt::print("  bounds {} to {} m, voxel {:.6g} m, density mean {:.6g}, max {:.6g}, memory {}\n", text(box.lo),
               text(box.hi), m.grid->voxel_size(), m.grid->mean_density(), m.grid->max_density(),
               mebibytes(m.grid->memory_bytes()));
  }
  const double densest = m.grid ? m.grid->max_density() : 1.0;
  fmt::print("  mean free path {:.6g} m at the mean density, {:.6g} m at the largest\n",
             1.0 / (mean_channel(m.sigma_t) * m.mean_density()), 1.0 / (mean_channel(m.sigma_t) * densest));
  print_emission(m);
}

std::string until_text(const StopRule& until) {
  if (until.counts_passes()) return passes_text(until.passes);
  const std::string time = fmt::format("{:.6g} s are over", until.seconds);
  const std::string error = fmt::format("the relative MSE is {:.3g}", until.error);
  return "passes until " + (until.error == 0.0 ? time : until.seconds == 0.0 ? error : time + " or " + error);
}

std::string photons_text(const RenderSettings& settings) {
  const std::string stored = fmt::format("until a map holds {}", settings.photons.stored);
  if (settings.photons.emitted == 0) return "photons " + stored;
  return fmt::format("{} photons{}", settings.photons.emitted, settings.photons.stored > 0 ? " or " + stored : "");
}

/// "0.018 m in smoke, 0.05 m on surfaces": of what scatters.
std::string radii_text(const Scene& scene, const RenderSettings& settings) {
  std::vector<std::string> radii;
  const bool combined = settings.integrator == Integrator::combined;
  if (combined && facts_of(scene).scattering_media)
    radii.push_back(fmt::format("{:.6g} m in media", first_radius_of_merges(settings.volume, scene)));
  for (const Medium& m : scene.media)
    if (m.scatters() && !combined)
      radii.push_back(fmt::format("{:.6g} m in {}", first_radius(settings.volume, scene, m), m.name));
  if (facts_of(scene).rough_surfaces)
    radii.push_back(fmt::format("{:.6g} m on surfaces", first_radius(settings.surface, scene)));
  return radii.empty() ? "none: nothing stores photons" : fmt::format("{}", fmt::join(radii, ", "));
}

/// How much a render would do, and how finely.
void print_effort(const RenderJob& job) {
  const RenderSettings& settings = job.settings;
  if (settings.integrator == Integrator::path) {
    fmt::print("renders {}, in each {} {} a pixel\n", until_text(settings.until), settings.samples_per_pixel,
               settings.samples_per_pixel == 1 ? "path" : "paths");
    if (const std::string lost = text_of_lost_light(job.scene, settings, job.light_names); !lost.empty())
      fmt::print("warning: {}\n", lost);
    return;
  }
  fmt::print("renders {}, in each {}\n", until_text(settings.until), photons_text(settings));
  if (!job.automatic.keys.empty()) {
    fmt::print("vpm render chooses {}, which are \"auto\", and then the radii that are left out\n",
               fmt::join(job.automatic.keys, ", "));
    return;
  }
  fmt::print("gather radii of the first pass: {}\nmaps of a {}: about {:.3g} MiB while they are made\n",
             radii_text(job.scene, settings), settings.photons.block > 0 ? "block" : "pass",
             bytes_of_maps(job.scene, settings, PassOf::picture) / (1024.0 * 1024.0));
}

std::string medium_text(const Scene& scene, MediumId medium) {
  if (medium == kSeveralMedia) return "several media: on a boundary";
  return medium == kVacuum ? "vacuum" : "medium " + scene.media[medium].name;
}

std::string crop_text(const Camera& camera) {
  if (!camera.crop) return "";
  const auto& [x0, y0, x1, y1] = *camera.crop;
  return fmt::format(", of which ({}, {}) to ({}, {}) are rendered", x0, y0, x1 - 1, y1 - 1);
}

/// What a render would run; what it would skip, and why, where that is asked for.
void print_stages(const RenderJob& job, bool all) {
  size_t skipped = 0;
  for (const std::string& line : stage_lines(job.scene, job.settings, facts_of(job.scene))) {
    const bool skips = line.starts_with("skips ");
    skipped += skips;
    if (all || !skips) fmt::print("{}\n", line);
  }
  if (!all && skipped > 0) fmt::print("skips {} other stages: --all lists which and why\n", skipped);
}

void print_scene(const InfoOptions& options) {
  RenderJob job = load_scene(options.file, components_first(options.overrides));
  choose_default_radii(job);
  if (job.automatic.keys.empty()) check_memory(job.scene, job.settings, PassOf::picture, physical_memory());
  const Scene& scene = job.scene;
  const Box box = scene.geometry.bounds();
  fmt::print("scene {}, hash {}\n", options.file, job.hash);
  print_effort(job);
  for (const Choice& radius : job.choices)
    fmt::print("{} = {} m by default: {}\n", radius.key, radius.value, radius.reason);
  for (const std::string& note : job.notes) fmt::print("note: {}\n", note);
  print_stages(job, options.all);
  for (const Medium& m : scene.media) print_medium(m);
  fmt::print("camera at {} m, {} x {} pixels{}, in {}\n", text(scene.camera.position), scene.camera.width,
             scene.camera.height, crop_text(scene.camera), medium_text(scene, scene.camera_medium));
  if (box.empty())
    fmt::print("no shapes\n");
  else
    fmt::print("{} shapes in {} to {} m\n", scene.shapes.size(), text(box.lo), text(box.hi));
  fmt::print("around everything: {}\n", medium_text(scene, scene.world_medium));
  for (size_t i = 0; i < scene.lights.size(); ++i)
    fmt::print("light {}{}: {}, {}, chosen with probability {:.4g}\n", i,
               job.light_names[i].empty() ? "" : ", " + job.light_names[i], light_kind(scene.lights[i]),
               power_text(scene.lights[i], scene.bounds), scene.light_probability[i]);
}

}  // namespace

int info_command(const InfoOptions& options) {
  const std::string extension = std::filesystem::path(options.file).extension().string();
  if (extension == ".vdb") {
    for (const GridSummary& grid : list_grids(options.file)) {
      print_grid(grid);
      if (options.all) print_details(grid);
    }
  } else if (extension == ".toml") {
    print_scene(options);
  } else {
    throw InputError(fmt::format("{}: not a scene (.toml) and not a grid file (.vdb)", options.file));
  }
  return 0;
}

}  // namespace vpm::tools
