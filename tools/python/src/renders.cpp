// Renders: passes of a scene so far, each further set of passes a new value; and what is read off them.
#include <fmt/format.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings.h"
#include "joined_ranks.h"
#include "scene_job.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/image/png.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/messages.h"
#include "vpm/job/picture.h"
#include "vpm/job/report.h"
#include "vpm/ranks/messages.h"
#include "vpm/ranks/together.h"
#include "vpm/render/render.h"

namespace vpm::python {
namespace {

/// The passes of a render so far; immutable once it is made.
struct Passes {
  std::shared_ptr<SceneJob> scene;
  JobState state;
  RenderResult result;
  JoinedRanks* together = nullptr;  // those that make them; null: this process by itself

  /// Calls use(const RenderJob&) without the interpreter's lock.
  template <class Use>
  auto with(Use&& use) const {
    const py::gil_scoped_release others_run;
    JobState own = state;
    return with_job(*scene, own, [&](const RenderJob& job) { return use(job); });
  }
};

StopRule stop_rule(std::optional<int> passes, std::optional<double> seconds, std::optional<double> error,
                   StopRule otherwise) {
  if (passes) return {.passes = *passes};
  if (seconds) otherwise.seconds = *seconds;
  if (error) otherwise.error = *error;
  return otherwise;
}

/// Is it this process that writes files, and sends the others their work?
bool leads(JoinedRanks* together) { return !together || together->ranks().leads(); }

/// run_interruptibly() of what processes do together, or of what this one does by itself.
std::optional<py::error_already_set> run(JoinedRanks* together, const std::function<void()>& work) {
  if (!together) return run_interruptibly(work);
  JoinedRanks::Turn turn(*together);
  auto raised = run_interruptibly(work);
  if (!raised) turn.finish();
  return raised;
}

/// Before the first pass: chooses what is "auto", and looks ahead as the command line does.
std::shared_ptr<Passes> begin(const std::shared_ptr<SceneJob>& scene, std::optional<int> passes,
                              std::optional<double> seconds, std::optional<double> error, std::optional<uint64_t> seed,
                              bool together) {
  auto begun = std::make_shared<Passes>(Passes{scene,
                                               [&] {
                                                 const py::gil_scoped_release others_run;
                                                 const std::scoped_lock lock(scene->busy);
                                                 return JobState(scene->job);
                                               }(),
                                               nothing_rendered(scene->job.scene.camera),
                                               together ? &JoinedRanks::own() : nullptr});
  RenderSettings& settings = begun->state.settings;
  settings.until = stop_rule(passes, seconds, error, settings.until);
  if (seed) settings.seed = *seed;
  const WallClock clock;
  auto raised = run(begun->together, [&] {
    with_job(*scene, begun->state, [&](RenderJob& job) {
      if (leads(begun->together)) {
        choose(job, clock);
        foresee(job, clock);
        if (begun->together) send_render(begun->together->ranks(), identity_of(job));
      } else {
        adopt_render(job, receive_render(begun->together->ranks()));
      }
    });
  });
  if (raised) throw *std::move(raised);
  begun->result.seconds = clock.seconds();
  return begun;
}

/// The same render with another stop rule; a render by passes adds none below those that it has.
std::shared_ptr<Passes> until(const Passes& before, std::optional<int> passes, std::optional<double> seconds,
                              std::optional<double> error) {
  auto after = std::make_shared<Passes>(before);
  after->state.settings.until = stop_rule(passes, seconds, error, before.state.settings.until);
  return after;
}

/// Renders until the stop rule is met. Of several processes all return what they have made together.
RenderResult render_with(JoinedRanks* together, const RenderJob& job, RenderResult begun, const RunControl& control) {
  if (!together) return render(job.scene, job.settings, std::move(begun), control);
  Ranks& ranks = together->ranks();
  if (!ranks.leads()) {
    make_render(ranks, job.scene, job.settings);
    return receive_result(ranks);
  }
  RenderResult result = lead_render(ranks, job.scene, job.settings, std::move(begun), control);
  if (!is_cancelled()) send_result(ranks, result);  // else the others may be gone
  return result;
}

/// Renders until the stop rule is met, or one pass; and what a signal's handler raised meanwhile, or None.
std::pair<std::shared_ptr<Passes>, py::object> advance(const Passes& before, bool one_pass, bool progress) {
  auto after = std::make_shared<Passes>(before);
  std::atomic<bool> enough{false};
  std::function<void(const RenderResult&)> finished;
  if (one_pass) finished = [&](const RenderResult&) { enough = true; };
  RunControl control{progress ? ProgressMode::automatic : ProgressMode::never, finished};
  control.foreseen = before.state.foreseen_pass;
  control.what_fits = before.state.what_fits;
  auto raised = run(after->together, [&] {
    with_job(*after->scene, after->state, [&](RenderJob& job) {
      const CancelScope one(enough);
      after->result = render_with(after->together, job, std::move(after->result), control);
    });
  });
  if (raised && !raised->matches(PyExc_KeyboardInterrupt)) throw *std::move(raised);
  return {after, raised ? raised->value() : py::none()};
}

py::object stated_error_dict(const Passes& passes) {
  const std::optional<StatedError> stated = stated_error_of(passes.result);
  if (!stated) return py::none();
  py::dict error;
  error["total"] = stated->total.value;
  error["total_standard_error"] = stated->total.standard_error;
  error["variance"] = stated->variance.value;
  error["variance_standard_error"] = stated->variance.standard_error;
  error["squared_bias"] = stated->squared_bias.value;
  error["squared_bias_standard_error"] = stated->squared_bias.standard_error;
  error["highest"] = stated->highest;
  return error;
}

/// Arrays (height, width, channels), or (height, width) where there is one channel.
py::dict layers_of(const Passes& passes) {
  py::dict layers;
  for (NamedLayer& layer : picture_layers(passes.state.settings, passes.result)) {
    const py::array image = array_of(std::move(layer.image));
    const bool single = layer.letters.size() == 1;
    layers[py::str(layer.name)] = single ? py::object(image[py::make_tuple(py::ellipsis(), 0)]) : py::object(image);
  }
  return layers;
}

/// One of the pictures of the film's errors; None below two passes.
py::object error_picture(const py::object& self, Image FilmErrors::*picture) {
  const auto& passes = self.cast<const Passes&>();
  return passes.result.errors ? py::object(view_of((*passes.result.errors).*picture, self)) : py::none();
}

void write(const Passes& passes, const std::string& path, std::optional<float> exposure) {
  if (!leads(passes.together)) return;
  const std::filesystem::path exr = path;
  if (exr.extension() != ".exr")
    throw InputError(fmt::format("{}: the image is an EXR file, its name must end in .exr", path));
  if (passes.result.film.passes() == 0) throw InputError(path + ": no pass is finished, and nothing is written");
  const std::filesystem::path png = std::filesystem::path(exr).replace_extension(".png"),
                              json = std::filesystem::path(exr).replace_extension(".json");
  passes.with([&](const RenderJob& job) {
    for (const std::filesystem::path& target : {exr, png, json}) check_not_read(target, job);
    const Image picture = passes.result.film.mean();
    write_picture(exr, job, passes.result);
    write_png(png, picture, exposure ? *exposure : auto_exposure(picture));
    write_text(json, render_report(job, path, passes.result));
  });
}

}  // namespace

void bind_renders(py::module_& module) {
  py::class_<Passes, std::shared_ptr<Passes>>(module, "Passes")
      .def_property_readonly("count", [](const Passes& p) { return p.result.film.passes(); })
      .def_property_readonly("seconds", [](const Passes& p) { return p.result.seconds; })
      .def_property_readonly("seed", [](const Passes& p) { return p.state.settings.seed; })
      .def_property_readonly("window",
                             [](const Passes& p) {
                               const auto& [x0, y0, x1, y1] = p.scene->job.scene.camera.rendered();
                               return py::make_tuple(x0, y0, x1, y1);
                             })
      .def_property_readonly("size",
                             [](const Passes& p) {
                               const Camera& camera = p.scene->job.scene.camera;
                               return py::make_tuple(camera.width, camera.height);
                             })
      .def_property_readonly("notes", [](const Passes& p) { return p.state.notes; })
      .def("warnings", [](const Passes& p) { return p.with([&](auto& job) { return warnings_of(job, p.result); }); })
      .def("report",
           [](const Passes& p) { return p.with([&](auto& job) { return render_report(job, "", p.result); }); })
      .def("radiance", [](const Passes& p) { return array_of(p.result.film.mean()); })
      .def("variance", [](const py::object& self) { return error_picture(self, &FilmErrors::variance); })
      .def("bias",
           [](const py::object& self) {
             const auto& passes = self.cast<const Passes&>();
             return passes.result.film.shows_bias() ? error_picture(self, &FilmErrors::bias) : py::none();
           })
      .def("variance_of_means",
           [](const Passes& p) -> py::object {
             if (!p.result.errors) return py::none();
             const Rgbd& means = p.result.errors->variance_of_channel_means;
             return py::make_tuple(means.r, means.g, means.b);
           })
      .def("layers", &layers_of)
      .def("stated_error", &stated_error_dict)
      .def("write", &write)
      .def("until", &until)
      .def("advance", &advance);
  module.def("begin", &begin);
}

}  // namespace vpm::python
