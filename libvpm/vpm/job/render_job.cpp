// Making jobs, and choosing what is left to choose.
#include "vpm/job/render_job.h"

#include <fmt/format.h>
#include <chrono>

#include "vpm/job/automatic.h"
#include "vpm/job/validate.h"

namespace vpm {
namespace {

/// What was chosen, and how to have it again.
void note_choices(RenderJob& job) {
  if (job.choices.empty()) return;
  std::string again;
  for (const Choice& choice : job.choices) {
    job.notes.push_back(fmt::format("chosen {} = {}: {}", choice.key, choice.value, choice.reason));
    again += fmt::format(" --set {}={}", choice.key, choice.value);
  }
  job.notes.push_back("the same picture again without choosing:" + again);
}

}  // namespace

RenderJob make_job(AssembledScene assembled, const RenderSettings& settings) {
  return {.scene = std::move(assembled.scene),
          .settings = settings,
          .automatic = {},
          .light_names = std::move(assembled.light_names),
          .notes = std::move(assembled.notes)};
}

void choose(RenderJob& job) {
  if (!job.automatic.any()) return;
  validate(job.settings, facts_of(job.scene));
  const auto start = std::chrono::steady_clock::now();
  job.choices = choose_settings(job.scene, job.automatic, job.settings);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  job.notes.push_back(fmt::format("choosing settings took {:.2g} s", seconds.count()));
  note_choices(job);
}

void choose_again(RenderJob& job, std::vector<Choice> choices) {
  job.choices = std::move(choices);
  for (const Choice& choice : job.choices) set_chosen(job.settings, choice.key, choice.value);
  note_choices(job);
}

}  // namespace vpm
