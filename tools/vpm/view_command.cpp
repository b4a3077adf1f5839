// vpm view: a scene around a grid, and pictures of it.
#include <fmt/format.h>
#include <filesystem>

#include "commands.h"
#include "pass_run.h"
#include "picture_run.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"
#include "vpm/job/render.h"

namespace vpm::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kRewritten = 2.0;  // s, after which better pictures are written, unless --preview says

/// The scene, and the name under which it is read: that of the file that is written, where one is.
struct MadeScene {
  ViewScene scene;
  std::string name;
};
MadeScene make_scene(const ViewOptions& options) {
  const fs::path grid = options.scene;
  ViewWishes wishes = options.wishes;
  if (const size_t x = options.size.find('x'); x != std::string::npos)
    wishes.aspect = std::stod(options.size.substr(0, x)) / std::stod(options.size.substr(x + 1));
  if (options.scene_output.empty())
    return {make_view_scene(grid, grid, wishes), "scene of " + grid.filename().string()};
  const fs::path output = options.scene_output;
  if (output.extension() != ".toml")
    throw InputError(fmt::format("{}: a scene's name must end in .toml", output.string()));
  const fs::path folder = fs::absolute(output).parent_path();
  MadeScene made{make_view_scene(grid, fs::absolute(grid).lexically_proximate(folder), wishes), output};
  write_text(output, made.scene.text);
  return made;
}

/// A pilot of integrators takes longer than a few passes do: where these are counted, photons are gathered.
std::vector<std::string> overrides_of_view(const ViewOptions& options) {
  std::vector<std::string> overrides = overrides_of(options);
  if (options.passes) overrides.insert(overrides.begin(), "render.integrator=photon");
  return overrides;
}

/// One pass of few photons, before anything is chosen: a picture to look at while a pilot runs.
void show_first_picture(const ViewOptions& options, const Outputs& outputs, const RenderJob& job) {
  RenderSettings settings = job.settings;
  settings.until = {.passes = 1};
  settings.photons_emitted = 50'000;
  const RenderResult first = render(job.scene, settings, nothing_rendered(job.scene.camera));
  write_preview(outputs, options, first.film.mean());
}

}  // namespace

int view_command(const ViewOptions& options) {
  set_threads(options.threads);
  const Outputs outputs = output_paths(options, fs::path(options.scene).stem().string());
  const MadeScene made = make_scene(options);
  RenderJob job = load_scene(SceneText{made.name, made.scene.text}, overrides_of_view(options));
  for (const std::string& note : made.scene.notes) job.notes.push_back(note);
  const PixelRect rendered = job.scene.camera.rendered();
  check_outputs(outputs, static_cast<uint64_t>(rendered.width()) * rendered.height(), false, job);
  show_first_picture(options, outputs, job);
  RenderOptions watched = options;
  if (!watched.watch.preview) watched.watch.preview = kRewritten;
  return render_picture(watched, outputs, std::move(job));
}

}  // namespace vpm::tools
