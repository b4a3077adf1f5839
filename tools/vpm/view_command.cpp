// vpm view: a scene around a grid, and pictures of it.
#include <fmt/format.h>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "commands.h"
#include "pass_run.h"
#include "picture_run.h"
#include "slice_picture.h"
#include "this_process.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/ranks/alone.h"
#include "vpm/render/render.h"

namespace vpm::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kFirstPictureShare = 0.2;  // of the time that is asked for
constexpr double kRewritten = 2.0;          // s, after which better pictures are written, unless --preview says

/// Where the scene is to be written, which is also the name under which it is read; else a name that is no file's.
std::string scene_name(const ViewOptions& options) {
  if (options.scene_output.empty()) return "scene of " + fs::path(options.scene).filename().string();
  const fs::path output = options.scene_output;
  if (output.extension() != ".toml")
    throw InputError(fmt::format("{}: a scene's name must end in .toml", output.string()));
  if (fs::exists(output))
    throw InputError(
        fmt::format("'{}' is there already, and may have been edited: name another --scene, or render it "
                    "with vpm render",
                    output.string()));
  return output;
}

ViewScene make_scene(const ViewOptions& options) {
  ViewWishes wishes = options.wishes;
  if (const size_t x = options.size.find('x'); x != std::string::npos)
    wishes.aspect = std::stod(options.size.substr(0, x)) / std::stod(options.size.substr(x + 1));
  const fs::path grid = options.scene, output = options.scene_output;
  const bool written = !options.scene_output.empty();
  return make_view_scene(grid, written ? fs::proximate(grid, fs::absolute(output).parent_path()) : grid, wishes);
}

/// The grid is loaded already, unless options ask for another, or for it in another way.
GridLoader loader_of(const ViewScene& made) {
  return [&made](const GridName&, const GridRequest& request) {
    GridRequest same = request;
    if (std::error_code none; fs::equivalent(request.path, made.request.path, none)) same.path = made.request.path;
    return same == made.request ? made.grid : load_grid(request);
  };
}

constexpr const char* kFewPasses = "integrator.type=photon-map";

/// A pilot of integrators takes longer than a few passes do: where these are counted, photons are gathered.
std::vector<std::string> overrides_of_view(const ViewOptions& options) {
  std::vector<std::string> overrides = overrides_of(options);
  if (options.passes) overrides.insert(overrides.begin(), kFewPasses);
  return overrides;
}

/// Files that are written before there is a picture: they go where there is none in the end.
class EarlyFiles {
 public:
  ~EarlyFiles() {
    for (const fs::path& path : written_) fs::remove(path, ignored_);
  }
  void add(const fs::path& path) { written_.push_back(path); }
  void keep() { written_.clear(); }

 private:
  std::vector<fs::path> written_;
  std::error_code ignored_;
};

/// One pass of few photons, before anything is chosen: a picture to look at while a pilot runs. None where it would
/// take more than its part of the time, or in the place of an earlier one, which stays until there is a better one.
void show_first_picture(const ViewOptions& options, const Outputs& outputs, const RenderJob& job, EarlyFiles& early) {
  RenderSettings settings = job.settings;
  settings.until = {.passes = 1};
  settings.photons.emitted = 50'000;
  const double seconds = job.settings.until.seconds;
  const double end = seconds > 0.0 ? kFirstPictureShare * seconds : double{kInfinity};
  std::optional<Image> first;
  clock_of_process()->finish_by(end, [&] {
    const RenderResult made = render(job.scene, settings, nothing_rendered(job.scene.camera));
    cancellation_point();
    first = made.film.mean();
  });
  if (!first || fs::exists(outputs.png)) return;
  early.add(outputs.png);
  write_preview(outputs, options.exposure, *first, without_fire(job.scene, *first));
}

int draw_slice(const ViewOptions& options) {
  const fs::path output = options.output.empty() ? fs::path(options.scene).stem().string() + ".svg" : options.output;
  if (output.extension() != ".svg") throw InputError(fmt::format("{}: slices are drawn as .svg", output.string()));
  check_writable(output, 0);
  const std::string name = grid_to_show(options.scene, list_headings(options.scene), options.wishes.grid);
  const LoadedGrid loaded = load_grid({.path = options.scene, .name = name, .interpolation = Interpolation::nearest});
  const std::string title = name + " of " + fs::path(options.scene).filename().string();
  write_text(output, slice_drawing(*loaded.grid, slice_wish(options.slice), title, unit_of_grid(name)));
  for (const std::string& note : loaded.notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print("{}\n", output.string());
  return 0;
}

}  // namespace

int view_command(const ViewOptions& options) {
  set_threads(options.threads);
  if (!options.slice.empty()) return draw_slice(options);
  const Outputs outputs = output_paths(options.output, fs::path(options.scene).stem().string());
  const std::string name = scene_name(options);
  const ViewScene made = make_scene(options);
  RenderJob job = load_scene(SceneText{name, made.text}, overrides_of_view(options),
                             options.passes ? LeftOut::automatic : LeftOut::defaults, loader_of(made));
  apply_run_options(options, job);
  for (const std::string& note : made.notes) job.notes.push_back(note);
  if (options.passes && job.settings.integrator == Integrator::photon)
    job.notes.push_back(fmt::format("{} as passes are counted: choosing would take longer than few", kFewPasses));
  const PixelRect rendered = job.scene.camera.rendered();
  check_outputs(outputs, static_cast<uint64_t>(rendered.width()) * rendered.height(), false, job);
  EarlyFiles early;
  if (!options.scene_output.empty()) {
    early.add(name);
    write_text(name, made.text);
  }
  show_first_picture(options, outputs, job, early);
  RenderOptions watched = options;
  if (!watched.watch.preview) watched.watch.preview = kRewritten;
  Alone alone;
  const RenderEnd end = render_picture(watched, outputs, std::move(job), alone);
  if (end.passes > 0) early.keep();
  return end.status;
}

}  // namespace vpm::tools
