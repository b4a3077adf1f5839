// Two measurements, at the chosen radius and at a wide one, tell of all factors between.
#include "vpm/job/scale_radius.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vpm/job/automatic.h"
#include "vpm/job/choice_rules.h"
#include "vpm/job/choose_records.h"
#include "vpm/job/forecast.h"
#include "vpm/job/pilot.h"
#include "vpm/job/pilot_error.h"

namespace vpm {
namespace {

constexpr std::string_view kVolumeRadius = "volume.radius";

double metres_of(const Choice& radius) { return std::stod(radius.value); }

std::string times(const Choice& radius, double factor) {
  return fmt::format("{}", rounded_radius(factor * metres_of(radius)));
}

RenderSettings with_radius(RenderSettings settings, const Choice& radius, double factor) {
  set_chosen(settings, radius.key, times(radius, factor));
  return settings;
}

/// What a pilot tells of passes, and how long one takes, by the factor.
class ScaledPasses {
 public:
  ScaledPasses(const Scene& scene, double limit, const RenderSettings& settings, const Choice& radius, double wide)
      : settings_(settings), wide_(wide), power_of_noise_(crosses_flights(settings) ? 1.0 : 2.0) {
    const RenderSettings widened = with_radius(settings, radius, wide);
    const PassCost narrow_cost = time_pass(scene, settings, limit), wide_cost = time_pass(scene, widened, limit);
    seconds_ = narrow_cost.seconds(photons_of_pass(settings, narrow_cost.stored_per_photon));
    more_seconds_ = std::max(0.0, wide_cost.eye - narrow_cost.eye) / (wide * wide - 1.0);
    error_ = error_of_pass(scene, widened, wide_cost, limit).pass;
    const double narrow_noise = error_of_pass(scene, settings, narrow_cost, limit).pass.photons;
    const double gained = 1.0 - std::pow(wide, -power_of_noise_);
    noise_of_media_ = std::clamp((narrow_noise - error_.photons) / gained, 0.0, narrow_noise);
    other_noise_ = narrow_noise - noise_of_media_;
  }

  /// What is left after as many passes as there will be; infinite where none fits into the time.
  double error_left(double factor) const {
    constexpr double kMostPasses = 10'000.0, kUsual = 64.0;
    constexpr double kPassesShare = 0.75;  // of the seconds of a render, which a pilot leaves
    PassError error = error_;
    error.photons = other_noise_ + noise_of_media_ * std::pow(factor, -power_of_noise_);
    error.bias2 *= kOfEdges * std::pow(factor / wide_, kPowerOfBias);
    double passes = settings_.until.counts_passes() ? double(settings_.until.passes) : kUsual;
    if (const double seconds = settings_.until.seconds; seconds > 0.0) {
      const double each = seconds_ + more_seconds_ * (factor * factor - 1.0);
      if (each > longest_time(seconds)) return kInfinity;
      passes = kPassesShare * seconds / each;
    }
    return error_after(error, settings_, static_cast<int>(std::clamp(passes, 1.0, kMostPasses)));
  }

 private:
  // The squared bias goes as the fourth power of the radius where light is smooth, and as the first at edges: there it
  // is four times what corrections tell (papers/stated-error.md). Pictures have both.
  static constexpr double kPowerOfBias = 2.5, kOfEdges = 4.0;

  RenderSettings settings_;
  double wide_;
  double power_of_noise_;                // as one over the area of discs, or over the width of flights
  double seconds_, more_seconds_;        // of a pass, and what each more of the squared factor adds
  PassError error_;                      // at the wide radius, where bias is told best from noise
  double noise_of_media_, other_noise_;  // of photons, at the factor 1: what the wide radius lessens, and the rest
};

}  // namespace

void scale_radius(const Scene& scene, double limit, RenderSettings& settings, std::vector<Choice>& choices) {
  constexpr std::array kFactors{1.4, 2.0, 2.8};
  constexpr double kSurelyLess = 0.95;  // of an error, that another factor must leave, as pilots are noisy
  const auto radius =
      std::find_if(choices.begin(), choices.end(), [](const Choice& choice) { return choice.key == kVolumeRadius; });
  if (radius == choices.end()) return;
  const double wide = std::min(kFactors.back(), kLargestRadius * scene.bounds.diagonal() / metres_of(*radius));
  if (wide < kFactors.front()) return;
  const ScaledPasses passes(scene, limit, settings, *radius, wide);
  double best = 1.0;
  for (const double factor : kFactors)
    if (factor <= wide && passes.error_left(factor) < kSurelyLess * passes.error_left(best)) best = factor;
  if (best == 1.0) return;
  settings = with_radius(settings, *radius, best);
  radius->value = times(*radius, best);
  radius->reason += fmt::format("; {:g} times that is told to leave less error", best);
}

}  // namespace vpm
