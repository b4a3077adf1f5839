// A scene that several renders share, each with settings of its own.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vpm/job/render_job.h"

namespace vpm::python {

/// A job as it was loaded. Its scene is immutable; what a render changes of the rest is that render's.
struct SceneJob {
  RenderJob job;
  std::mutex busy{};
};

/// What a render changes of a job.
struct JobState {
  RenderSettings settings;
  AutomaticSettings automatic;
  std::vector<Choice> choices;
  std::vector<std::string> notes;
  double foreseen_pass = 0.0;
  std::string what_fits;

  explicit JobState(const RenderJob& job)
      : settings(job.settings),
        automatic(job.automatic),
        choices(job.choices),
        notes(job.notes),
        foreseen_pass(job.foreseen_pass),
        what_fits(job.what_fits) {}

  void exchange(RenderJob& job) {
    std::swap(settings, job.settings);
    std::swap(automatic, job.automatic);
    std::swap(choices, job.choices);
    std::swap(notes, job.notes);
    std::swap(foreseen_pass, job.foreseen_pass);
    std::swap(what_fits, job.what_fits);
  }
};

/// Calls use(RenderJob&) with the scene's job in that state. One at a time: the others wait. Do not hold the
/// interpreter's lock.
template <class Use>
auto with_job(SceneJob& scene, JobState& state, Use&& use) {
  const std::scoped_lock lock(scene.busy);
  state.exchange(scene.job);
  struct Back {
    SceneJob& scene;
    JobState& state;
    ~Back() { state.exchange(scene.job); }
  } const back{scene, state};
  return use(scene.job);
}

}  // namespace vpm::python
