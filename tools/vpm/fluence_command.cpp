// vpm fluence: scene file in, fields inside its media out.
#include <fmt/format.h>
#include <algorithm>
#include <cstdio>

#include "commands.h"
#include "pass_run.h"
#include "this_process.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/grid/field_file.h"
#include "vpm/input/scene_file.h"
#include "vpm/job/fluence.h"
#include "vpm/job/messages.h"

namespace vpm::tools {
namespace {

Box box_of(const FluenceOptions& options, const Scene& scene) {
  if (options.box.empty()) return default_field_box(scene);
  const std::vector<float>& b = options.box;
  const Box box{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
  const Vec3 extent = box.extent();
  if (!(extent.x > 0.0f && extent.y > 0.0f && extent.z > 0.0f))
    throw InputError("--box x0 y0 z0 x1 y1 z1: the first corner must be below the second along each axis");
  return box;
}

}  // namespace

int fluence_command(const FluenceOptions& options) {
  set_threads(options.threads);
  const std::filesystem::path output =
      options.output.empty() ? std::filesystem::path(options.scene).stem().string() + ".fluence.npy" : options.output;
  RenderJob job = load_scene(options.scene, components_first(options.overrides));
  check_field_file(output);
  check_not_read(output, job);
  refuse_automatic(job, "vpm fluence");
  if (options.seed) job.settings.seed = *options.seed;
  print_notes(job);
  const CancelScope scope(stop_on_signals());
  const FluenceField field =
      measure_fluence(job.scene, job.settings, about_cubes(box_of(options, job.scene), options.resolution),
                      photon_run(options), options.flux);
  write_field(field, output);
  print_warnings(warnings_of(field.run.ledger));
  if (std::all_of(field.fluence.begin(), field.fluence.end(), [](const Rgb& fluence) { return is_black(fluence); }))
    print_warnings({"no photon flew through a medium in the box"});
  const auto& [lo, hi] = field.lattice.box;
  const double photons = static_cast<double>(field.run.ledger.emitted_count), volume = field.lattice.volume();
  Rgbd absorbed(0.0);
  for (const Rgb& power : field.absorbed) absorbed += volume * Rgbd(power);
  fmt::print("{}: {} x {} x {} cells of the box ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m, {}\n", output.string(),
             field.lattice.count.x, field.lattice.count.y, field.lattice.count.z, lo.x, lo.y, lo.z, hi.x, hi.y, hi.z,
             passes_text(field.run.passes));
  const Rgbd all = field.run.ledger.absorbed_in_media / photons;
  fmt::print("  absorbed in it ({:.6g}, {:.6g}, {:.6g}) W, in all media ({:.6g}, {:.6g}, {:.6g}) W\n", absorbed.r,
             absorbed.g, absorbed.b, all.r, all.g, all.b);
  return field.run.interrupted ? say_interrupted(photon_run(options).until, field.run.passes) : 0;
}

}  // namespace vpm::tools
