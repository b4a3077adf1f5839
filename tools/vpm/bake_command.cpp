// vpm bake: scene file and the name of a shape in, light map and report out.
#include <fmt/format.h>
#include <cstdio>

#include "commands.h"
#include "pass_run.h"
#include "report.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/image/exr.h"
#include "vpm/image/png.h"
#include "vpm/input/source.h"

namespace vpm::tools {
namespace {

constexpr int kDilation = 2;  // texels

/// A name apart from that of the scene's pictures.
std::string usual_name(const BakeOptions& options) {
  return std::filesystem::path(options.scene).stem().string() + "." + options.mesh;
}

void check_settings(const RenderSettings& settings) {
  if (settings.integrator != Integrator::photon)
    throw InputError(
        "light maps are made of photon maps, but render.integrator is \"path\"; add: --set render.integrator=photon");
  if (settings.radii == RadiusSchedule::per_pixel)
    throw InputError(
        "texels of a light map have no radii of their own, but render.radii is \"per-pixel\"; add: --set "
        "render.radii=per-pass");
  if (settings.error > 0.0)
    throw InputError("a light map is not baked until an error is reached, as render.error asks; add: --passes N");
}

uint32_t find_shape(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const Shape& shape : scene.shapes) {
    if (shape.name == name) return static_cast<uint32_t>(names.size());
    names.push_back(shape.name);
  }
  throw InputError(fmt::format("--mesh {}: there is no such shape\n  {}", name, suggest(name, names, "there are")));
}

UvLayout lay_out(const Scene& scene, const BakeOptions& options) {
  const uint32_t shape = find_shape(scene, options.mesh);
  try {
    return lay_out_light_map(scene, shape, options.resolution);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--mesh {}: {}", options.mesh, error.what()));
  }
}

Image grey_image(const UvLayout& layout, const std::vector<float>& values) {
  Image image(layout.resolution, layout.resolution);
  std::transform(values.begin(), values.end(), image.pixels.begin(), [](float value) { return Rgb(value); });
  return image;
}

void write_outputs(const Outputs& outputs, const BakeOptions& options, const LoadedScene& loaded,
                   const UvLayout& layout, const RenderResult& result) {
  const Film& film = result.film;
  const Image map = dilated(film.mean(), layout, kDilation);
  const Image coverage = grey_image(layout, layout.coverage);
  const Image variance = film.passes() > 1 ? result.errors->variance : Image();
  std::vector<ExrLayer> layers{{"coverage", coverage}};
  if (film.passes() > 1) layers.push_back({"variance", variance});
  Metadata metadata = provenance(options, loaded, film);
  metadata.emplace_back("vpm.mesh", options.mesh);
  metadata.emplace_back("vpm.quantity",
                        "irradiance on the side of the outward normal, W/m^2; variance.*: variance of the mean of "
                        "passes; coverage.*: share of the texel that the mesh covers");
  metadata.emplace_back(
      "vpm.uncovered",
      fmt::format("texels of coverage 0, {} of {}: black, but within {} texels of covered ones the mean of their "
                  "neighbours; their variance is given as 0",
                  layout.texels() - layout.covered_texels(), layout.texels(), kDilation));
  write_exr(outputs.exr, map, layers, metadata);
  write_png(outputs.png, map, auto_exposure(map));
  write_text(outputs.json, light_map_report(options.scene, outputs.exr.string(), options.mesh, loaded, layout, result));
}

}  // namespace

int bake_command(const BakeOptions& options) {
  set_threads(options.threads);
  const Outputs outputs = output_paths(options, usual_name(options));
  LoadedScene loaded = load_scene(options.scene, options.overrides);
  refuse_automatic(loaded, "vpm bake");
  apply_options(options, loaded.settings);
  check_settings(loaded.settings);
  const UvLayout layout = lay_out(loaded.scene, options);
  check_outputs(outputs, layout.texels(), false, options, loaded);
  print_notes(loaded);
  const std::atomic<bool>& stop = stop_on_signals();
  const RenderResult result = bake_light_map(loaded.scene, loaded.settings, layout, stop, options.progress);
  print_warnings({.surfaces = true}, loaded.settings, result.statistics);
  if (layout.flat_triangles > 0)
    fmt::print(stderr, "warning: {} triangles have no area in texture coordinates: no texel shows them\n",
               layout.flat_triangles);
  if (result.film.passes() == 0) {
    fmt::print(stderr, "interrupted before the first pass was finished: nothing is written\n");
    return kInterrupted;
  }
  write_outputs(outputs, options, loaded, layout, result);
  fmt::print("{}: {} passes in {:.1f} s; {} of {} texels covered; preview {}, report {}\n", outputs.exr.string(),
             result.film.passes(), result.seconds, layout.covered_texels(), layout.texels(), outputs.png.string(),
             outputs.json.string());
  return stop ? kInterrupted : 0;
}

}  // namespace vpm::tools
