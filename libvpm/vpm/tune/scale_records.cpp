// All factors are estimated from two measurements, at the chosen radii and at others.
#include "vpm/tune/scale_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "vpm/render/pass_time.h"
#include "vpm/render/render.h"
#include "vpm/tune/automatic.h"
#include "vpm/tune/choice_rules.h"
#include "vpm/tune/choose_records.h"
#include "vpm/tune/pilot.h"

namespace vpm {
namespace {

// The other radii that are measured are wide, as bias there stands out best from noise, but no wider than the widest;
// narrow ones where some nearly are.
constexpr double kWider = 4.0, kLeastWider = 1.4, kNarrower = 0.5;
constexpr double kOfOrders = 2.5;  // at edges squared bias is four times that of corrections: a middle

bool is_radius(const Choice& choice) { return choice.key.ends_with(".radius"); }
bool is_number(const Choice& choice) { return choice.key == "integrator.photons.emitted"; }

std::string scaled(const Choice& choice, const RecordFactors& factors, double diagonal) {
  const double value = std::stod(choice.value);
  if (is_number(choice)) return fmt::format("{}", static_cast<uint64_t>(rounded(factors.photons * value, 2)));
  const double most = std::max(value, kLargestRadius * diagonal);
  const float radius = rounded_radius(std::min(factors.radius * value, most));
  return factors.radius > 1.0 && radius <= value ? choice.value : fmt::format("{}", radius);
}

}  // namespace

ScaledPasses::ScaledPasses(const Scene& scene, double limit, const RenderSettings& settings,
                           const std::vector<Choice>& choices)
    : settings_(settings),
      scales_radii_(std::any_of(choices.begin(), choices.end(), is_radius)),
      scales_photons_(!settings.until.counts_passes() && std::any_of(choices.begin(), choices.end(), is_number)),
      power_of_noise_(crosses_flights(settings) ? 1.0 : 2.0) {
  const PassCost cost = time_pass(scene, settings, limit);
  const double photons = photons_of_pass(settings, cost.stored_per_photon);
  photon_seconds_ = photons * cost.photon;
  other_seconds_ = cost.rest();
  stored_ = photons * cost.stored_per_photon;
  shown_ = error_of_pass(scene, settings, cost, limit);
  other_noise_ = shown_.pass.photons;
  bias2_ = shown_.pass.bias2;
  if (!scales_radii_) return;
  const double diagonal = scene.bounds.diagonal();
  double factor = kWider;
  for (const Choice& choice : choices)
    if (is_radius(choice)) factor = std::min(factor, kLargestRadius * diagonal / std::stod(choice.value));
  if (factor < kLeastWider) factor = kNarrower;
  RenderSettings others = settings;
  std::vector<Choice> other_choices = choices;
  scale(scene, {.radius = factor}, others, other_choices);
  const PassCost other_cost = time_pass(scene, others, limit);
  gather_seconds_ = std::clamp((other_cost.eye - cost.eye) / (factor * factor - 1.0), 0.0, cost.eye);
  other_seconds_ -= gather_seconds_;
  const PassError other = error_of_pass(scene, others, other_cost, limit).pass;
  const double lessened = (other_noise_ - other.photons) / (1.0 - std::pow(factor, -power_of_noise_));
  kernel_noise_ = std::clamp(lessened, 0.0, other_noise_);
  other_noise_ -= kernel_noise_;
  if (factor > 1.0) bias2_ = other.bias2 * std::pow(factor, -kPowerOfBias);
}

double ScaledPasses::seconds_of_pass(const RecordFactors& factors) const {
  return other_seconds_ + factors.photons * (photon_seconds_ + factors.radius * factors.radius * gather_seconds_);
}

double ScaledPasses::error_after_passes(double passes, const RecordFactors& factors, double unseen) const {
  PassError error = shown_.pass;
  error.rays += unseen;
  error.photons = (other_noise_ + kernel_noise_ * std::pow(factors.radius, -power_of_noise_)) / factors.photons;
  error.bias2 = kOfOrders * bias2_ * std::pow(factors.radius, kPowerOfBias);
  return error_after(error, settings_, static_cast<int>(passes));
}

/// As many as are asked for or fit into the seconds, 0 where none does; where neither is given, as many as take as long
/// as usual ones.
double ScaledPasses::passes_of(const RecordFactors& factors) const {
  constexpr double kManyPasses = 10'000.0, kUsual = 64.0;
  if (settings_.until.counts_passes()) return settings_.until.passes;
  const double each = seconds_of_pass(factors), seconds = settings_.until.seconds;
  if (seconds == 0.0) return kUsual * seconds_of_pass({}) / each;
  if (each > longest_time(seconds)) return 0.0;
  return std::clamp(kPassesShare * seconds / each, 1.0, kManyPasses);
}

/// Infinite where no pass fits into the time, where passes of more photons would be few, or maps full.
double ScaledPasses::error_left(const RecordFactors& factors) const {
  const double passes = passes_of(factors);
  const bool more = factors.photons > 1.0;
  if (passes < (more ? 2.0 * kLeastPasses : 1.0) || (more && factors.photons * stored_ > kMostStored)) return kInfinity;
  return error_after_passes(passes, factors);
}

RecordFactors ScaledPasses::best_factors() const {
  constexpr std::array kRadii{0.5, 0.7, 1.0, 1.4, 2.0};
  constexpr std::array kPhotons{0.5, 1.0, 2.0};
  constexpr double kClearlyLess = 0.95;
  RecordFactors best;
  double least = kClearlyLess * error_left(best);
  for (const double photons : kPhotons) {
    for (const double radius : kRadii) {
      if ((photons != 1.0 && !scales_photons_) || (radius != 1.0 && !scales_radii_)) continue;
      const double error = error_left({radius, photons});
      if (error >= least) continue;
      best = {radius, photons};
      least = error;
    }
  }
  return best;
}

void scale(const Scene& scene, const RecordFactors& factors, RenderSettings& settings, std::vector<Choice>& choices) {
  for (Choice& choice : choices) {
    const double factor = is_radius(choice) ? factors.radius : is_number(choice) ? factors.photons : 1.0;
    if (factor == 1.0) continue;
    const std::string before = std::exchange(choice.value, scaled(choice, factors, scene.bounds.diagonal()));
    if (choice.value == before) continue;
    choice.reason =
        fmt::format("{}: {}; then times {:g}, which is expected to leave less error", before, choice.reason, factor);
    set_chosen(settings, choice.key, choice.value);
  }
}

void scale_records(const Scene& scene, double limit, RenderSettings& settings, std::vector<Choice>& choices) {
  if (std::none_of(choices.begin(), choices.end(), is_radius)) return;
  scale(scene, ScaledPasses(scene, limit, settings, choices).best_factors(), settings, choices);
}

}  // namespace vpm
