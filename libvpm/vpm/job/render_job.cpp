// Making jobs, and choosing what is left to choose.
#include "vpm/job/render_job.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "vpm/base/error.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/forecast.h"
#include "vpm/job/lost_light.h"
#include "vpm/render/pass_time.h"
#include "vpm/render/render.h"
#include "vpm/tune/automatic.h"

namespace vpm {
namespace {

/// The share of a time that is asked for which a look ahead may take, each.
constexpr double kLookShare = 0.1;

constexpr double kLeastTime = 0.01;  // s: pilots for less are as for this

/// What is left of the time that is asked for, s; infinite where none is.
double time_left(const RenderJob& job, const Clock& clock) {
  const double seconds = job.settings.until.seconds;
  return seconds > 0.0 ? std::max(seconds - clock.seconds(), 0.0) : double{kInfinity};
}

/// "about 210000 integrator.photons.emitted, or integrator.volume.radius = 0.12 would fit"; either may be missing.
std::string what_fits_text(const std::string& photons, const std::string& radius, double of_rays) {
  if (photons.empty() && radius.empty())
    return fmt::format("the eye's rays alone take {:.2g} s; fewer pixels or samples_per_pixel take less", of_rays);
  return fmt::format("{}{}{} would fit", photons, photons.empty() || radius.empty() ? "" : ", or ", radius);
}

/// The keys of radii that the settings do not give, whichever maps there are: in code that may change.
AutomaticSettings::Keys default_radii_of(const RenderSettings& settings) {
  AutomaticSettings::Keys keys;
  if (!settings.volume.radius.is_given()) keys.insert("integrator.volume.radius");
  if (!settings.surface.radius.is_given()) keys.insert("integrator.surface.radius");
  if (!settings.caustics.radius.is_given()) keys.insert("integrator.caustics.radius");
  return keys;
}

/// What was chosen, and how to have it again.
void note_choices(RenderJob& job) {
  if (job.choices.empty()) return;
  // A scene says of its integrator what holds no more where that was to be chosen, though it be chosen again.
  std::string again = job.choices.front().key == "integrator.type" ? " --set integrator.type=auto" : "";
  for (const Choice& choice : job.choices) {
    job.notes.push_back(fmt::format("chosen {} = {}: {}", choice.key, choice.value, choice.reason));
    again += fmt::format(" --set {}={}", choice.key, choice.value);
  }
  job.notes.push_back("the same settings again without choosing:" + again);
}

/// Chooses what is "auto", by what is left of the time that is asked for.
void choose_automatic(RenderJob& job, const Clock& clock) {
  const double begin = clock.seconds(), left = time_left(job, clock);
  const double asked = job.settings.until.seconds;
  RenderSettings settings = job.settings;
  if (asked > 0.0) settings.until.seconds = std::max(left, kLeastTime);
  job.choices = choose_settings(job.scene, job.automatic, clock, settings);
  settings.until.seconds = asked;
  job.settings = settings;
  if (!job.choices.empty())
    job.notes.push_back(fmt::format("choosing settings took {:.2g} s", clock.seconds() - begin));
  note_choices(job);
}

}  // namespace

RenderJob make_job(AssembledScene assembled, const RenderSettings& settings) {
  return {.scene = std::move(assembled.scene),
          .settings = settings,
          .automatic = {.default_radii = default_radii_of(settings)},
          .light_names = std::move(assembled.light_names),
          .notes = std::move(assembled.notes)};
}

void choose(RenderJob& job, const Clock& clock) {
  // Of scenes made in code radii may have been given since.
  const AutomaticSettings::Keys default_radii = default_radii_of(job.settings);
  std::erase_if(job.automatic.default_radii, [&](const std::string& key) { return !default_radii.contains(key); });
  if (!job.automatic.any()) return;
  validate(job.settings, facts_of(job.scene));
  const double asked = job.settings.until.seconds;
  const auto all = [&] { job.automatic.keys.empty() ? choose_default_radii(job) : choose_automatic(job, clock); };
  if (!clock.finish_by(asked > 0.0 ? kMostOfFirst * asked : double{kInfinity}, all))
    throw NoPassFits(asked, 0.0, spent_text(clock.seconds(), asked));
}

void choose_default_radii(RenderJob& job) {
  if (!job.automatic.keys.empty()) return;
  validate(job.settings, facts_of(job.scene));
  RenderSettings settings = job.settings;
  job.choices = choose_default_radii(job.scene, job.automatic, settings);
  job.settings = settings;
}

void choose_again(RenderJob& job, std::vector<Choice> choices) {
  // A radius that was left out then may be given now.
  std::erase_if(choices, [&](const Choice& choice) {
    const std::optional<Setting> setting = find_setting(job.settings, choice.key);
    return setting && setting->default_chosen && !job.automatic.has(choice.key);
  });
  job.choices = std::move(choices);
  for (const Choice& choice : job.choices) set_chosen(job.settings, choice.key, choice.value);
  if (!job.automatic.keys.empty()) note_choices(job);
}

void refuse_automatic(const RenderJob& job, const std::string& command) {
  if (!job.automatic.keys.empty())
    throw InputError(fmt::format(
        "{} chooses no settings: name a value of {} where it is \"auto\"; vpm render prints those that it chooses",
        command, fmt::join(job.automatic.to_be_named(), ", ")));
}

void check_not_read(const std::filesystem::path& path, const RenderJob& job) {
  std::vector<std::string> read = job.files;
  read.push_back(job.source);
  for (const std::string& file : read)
    if (std::error_code none; std::filesystem::equivalent(path, file, none))
      throw InputError(
          fmt::format("cannot write '{}': the scene is read from '{}'; name another output", path.string(), file));
}

void foresee(RenderJob& job, const Clock& clock) {
  validate(job.settings, facts_of(job.scene));
  check_memory(job.scene, job.settings, PassOf::picture, physical_memory());
  if (std::string text = text_of_kernel_light(job.scene, job.settings, job.light_names); !text.empty())
    job.notes.push_back(std::move(text));
  const double left = time_left(job, clock), looking = std::min(kLookShare * left, 1.0);
  const auto within = [&](double seconds, const std::function<void()>& look) {
    return clock.finish_by(clock.seconds() + seconds, look);
  };
  std::string wide;
  if (!within(looking, [&] { wide = wide_gather_text(job.scene, job.settings); }))
    wide = fmt::format("a look of {:.2g} s is too short to count the photons that a ray gathers", looking);
  if (!wide.empty()) job.notes.push_back(std::move(wide));
  if (std::isinf(left)) return;
  ForeseenPass pass;
  if (!within(2.0 * looking, [&] { pass = foresee_pass(job.scene, job.settings, looking, clock); })) {
    job.notes.push_back(fmt::format("a look of {:.2g} s is too short to time a pass", 2.0 * looking));
    return;
  }
  job.foreseen_pass = pass.seconds;
  const double fits = time_left(job, clock);
  if (job.foreseen_pass <= fits) return;
  std::string radius;
  within(looking, [&] { radius = radius_that_fits(job.scene, job.settings, fits, looking, clock); });
  job.what_fits = what_fits_text(photons_that_fit(pass, job.settings, fits), radius, pass.of_rays);
  job.notes.push_back(fmt::format("one pass takes about {:.2g} s, longer than the {:.2g} s that are left: {}",
                                  job.foreseen_pass, fits, job.what_fits));
}

void foresee_light_map(const RenderJob& job) {
  validate_light_map(job.settings, facts_of(job.scene));
  check_memory(job.scene, job.settings, PassOf::light_map, physical_memory());
}

}  // namespace vpm
