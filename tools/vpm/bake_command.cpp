// vpm bake: scene file and the name of a shape in, light map and report out.
#include <fmt/format.h>
#include <cstdio>

#include "commands.h"
#include "pass_run.h"
#include "this_process.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"
#include "vpm/input/source.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/bake.h"
#include "vpm/job/messages.h"
#include "vpm/job/picture.h"
#include "vpm/job/report.h"

namespace vpm::tools {
namespace {

/// A name apart from that of the scene's pictures.
std::string usual_name(const BakeOptions& options) {
  return std::filesystem::path(options.scene).stem().string() + "." + options.mesh;
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

void write_outputs(const Outputs& outputs, const BakeOptions& options, const RenderJob& job, const UvLayout& layout,
                   const LightMap& baked) {
  write_light_map(outputs.exr, job, options.mesh, layout, baked.render);
  const Image light = light_map_of(layout, baked.render);
  write_preview(outputs, options.exposure, light, light);
  write_text(outputs.json, light_map_report(job, outputs.exr.string(), options.mesh, layout, baked));
}

}  // namespace

int bake_command(const BakeOptions& options) {
  set_threads(options.threads);
  const Outputs outputs = output_paths(options.output, usual_name(options));
  RenderJob job = load_scene(options.scene, components_first(options.overrides));
  refuse_automatic(job, "vpm bake");
  apply_options(options, job.settings);
  validate_light_map(job.settings, facts_of(job.scene));
  const UvLayout layout = lay_out(job.scene, options);
  check_outputs(outputs, layout.texels(), false, job);
  foresee_light_map(job);
  print_notes(job);
  const LightMap baked = bake_light_map(job.scene, job.settings, layout, {options.progress, {}, clock_of_process()});
  const RenderResult& result = baked.render;
  if (result.film.passes() == 0) return say_interrupted(job.settings.until, 0);
  const bool stopped = is_cancelled();
  const CancelledWith nothing(nullptr);  // what is finished is written
  if (layout.flat_triangles > 0)
    fmt::print(stderr, "warning: {} triangles have no area in texture coordinates: no texel shows them\n",
               layout.flat_triangles);
  print_warnings(warnings_of_light_map(job, result));
  write_outputs(outputs, options, job, layout, baked);
  fmt::print("{}: {} in {:.1f} s; {} of {} texels covered; preview {}, report {}\n", outputs.exr.string(),
             passes_text(result.film.passes()), result.seconds, layout.covered_texels(), layout.texels(),
             outputs.png.string(), outputs.json.string());
  return stopped ? say_interrupted(job.settings.until, result.film.passes()) : 0;
}

}  // namespace vpm::tools
