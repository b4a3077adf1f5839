// Steps of a factor, first to wider radii, and where the first does not help, to narrower ones.
#include "vpm/job/scale_radii.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vpm/job/automatic.h"
#include "vpm/job/choice_rules.h"
#include "vpm/job/forecast.h"
#include "vpm/job/pilot.h"
#include "vpm/job/pilot_error.h"

namespace vpm {
namespace {

constexpr double kStep = 1.5;
constexpr int kMostSteps = 3;          // in either direction
constexpr double kSurelyLess = 0.95;   // of an error, that a step must leave, as pilots are noisy
constexpr double kPassesShare = 0.75;  // of the seconds of a render, which a pilot leaves

/// The radii that were chosen.
std::vector<Choice*> chosen_radii(std::vector<Choice>& choices) {
  std::vector<Choice*> radii;
  for (Choice& choice : choices)
    if (choice.key.ends_with(".radius")) radii.push_back(&choice);
  return radii;
}

double value_of(const Choice& radius) { return std::stod(radius.value); }

std::string scaled_value(const Choice& radius, double factor) {
  return fmt::format("{}", rounded_radius(factor * value_of(radius)));
}

RenderSettings with_radii(RenderSettings settings, const std::vector<Choice*>& radii, double factor) {
  for (const Choice* radius : radii) set_chosen(settings, radius->key, scaled_value(*radius, factor));
  return settings;
}

/// What passes are told to leave, after as many as there will be.
double error_left(const Scene& scene, const RenderSettings& settings, double limit) {
  constexpr double kMostPasses = 10'000.0, kUsual = 64.0;
  const PassCost cost = time_pass(scene, settings, limit);
  const PassError error = error_of_pass(scene, settings, cost, limit).pass;
  double passes = settings.until.counts_passes() ? double(settings.until.passes) : kUsual;
  if (const double seconds = kPassesShare * settings.until.seconds; seconds > 0.0)
    passes = seconds / cost.seconds(photons_of_pass(settings, cost.stored_per_photon));
  return error_after(error, settings, static_cast<int>(std::clamp(passes, 1.0, kMostPasses)));
}

}  // namespace

void scale_radii(const Scene& scene, double limit, RenderSettings& settings, std::vector<Choice>& choices) {
  const std::vector<Choice*> radii = chosen_radii(choices);
  if (radii.empty()) return;
  const double largest = kLargestRadius * scene.bounds.diagonal();
  const auto too_wide = [&](double factor) {
    return std::any_of(radii.begin(), radii.end(),
                       [&](const Choice* radius) { return factor * value_of(*radius) > largest; });
  };
  double best = 1.0, least = error_left(scene, settings, limit);
  for (const double step : {kStep, 1.0 / kStep}) {
    for (int i = 0; i < kMostSteps && !too_wide(step * best); ++i) {
      const double error = error_left(scene, with_radii(settings, radii, step * best), limit);
      if (!(error < kSurelyLess * least)) break;
      best *= step;
      least = error;
    }
    if (best != 1.0) break;
  }
  if (best == 1.0) return;
  settings = with_radii(settings, radii, best);
  for (Choice* radius : radii) {
    radius->value = scaled_value(*radius, best);
    radius->reason += fmt::format("; {:.2g} times that leaves less error in a pilot", best);
  }
}

}  // namespace vpm
