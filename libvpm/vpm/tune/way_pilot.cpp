// Differences between passes measure noise, products of corrections of different passes measure bias.
#include "vpm/tune/way_pilot.h"

#include <algorithm>
#include <cmath>

#include "vpm/integrators/default_radii.h"

namespace vpm {
namespace {

constexpr double kFirst = 1000.0, kMore = 4.0;  // photons; as the number grows from pass to pass at first
constexpr double kMostMore = 8.0;               // as it grows later
constexpr double kMostAtFirst = 1e7;            // photons

/// The noise of a pass relative to the scales: of blocks, of which each counts as the mean of its pixels.
std::vector<double> noise_of(const std::vector<SmallPass>& passes, const Scales& scales) {
  std::vector<double> noise(kBlocks, 0.0);
  for (size_t i = 0; i < kSmallRays; ++i)
    for (int channel = 0; channel < 3; ++channel) {
      Moments values;
      for (const SmallPass& pass : passes) values.add(double{pass.found[i].value[channel]});
      const double scale = scales[i / kBlock][channel];
      if (scale > 0.0) noise[i / kBlockRays] += values.variance() / scale / (3.0 * kBlockRays);
    }
  return noise;
}

/// A power of two, so that passes of about one size are of the same.
double power_of_two_below(double value) { return std::exp2(std::floor(std::log2(std::max(1.0, value)))); }

}  // namespace

WayPilot::WayPilot(const Scene& scene, const AutomaticSettings& automatic, const Clock& clock, Way way)
    : scene_(&scene),
      automatic_(&automatic),
      clock_(&clock),
      way_(std::move(way)),
      has_photons_(info_of(way_.settings.integrator).power_of_noise != nullptr),
      chooses_photons_(has_photons_ && automatic.has("integrator.photons.emitted")) {}

SmallPass WayPilot::render(const PassSize& size) {
  RenderSettings settings = way_.settings;
  settings.seed = ~settings.seed;  // what is chosen does not depend on the photons that the render will gather
  settings.radii = RadiusSchedule::constant;
  settings.photons.emitted = static_cast<uint64_t>(std::max(1.0, size.photons));
  settings.photons.stored = 0;
  settings.caustics.emitted = std::min(settings.caustics.emitted, settings.photons.emitted);
  if (size.radii != 1.0) scale_radii(radii_, size.radii, settings);
  return render_small(*scene_, settings, number_++, *clock_);
}

void WayPilot::find_size(double seconds) {
  constexpr double kOfRadii = 20'000.0, kOfRadiiByTime = 2000.0;  // photons that radii go by, at most, in a second
  constexpr double kPassShare = 0.2, kShare = 0.5;
  const double begin = clock_->seconds();
  RenderSettings& settings = way_.settings;
  const auto few = static_cast<uint64_t>(std::clamp(kOfRadiiByTime * seconds, 0.1 * kOfRadii, kOfRadii));
  const auto densities = densities_for_radii(few, *scene_, *automatic_, settings);
  if (densities) radii_ = choose_radii(*scene_, *automatic_, *densities, settings);
  given_ = has_photons_ ? static_cast<double>(settings.photons.emitted) : 0.0;
  if (has_photons_ && given_ == 0.0)
    given_ = photons_of_pass(settings, map_densities(*scene_, settings, few).stored_per_photon);
  const double most = chooses_photons_ ? kMostAtFirst : given_;
  SmallPass last;
  for (photons_ = std::min(kFirst, most);; photons_ = std::min(kMore * photons_, most)) {
    last = render({photons_, 1.0});
    const bool balanced = last.making >= last.seeing || photons_ == most;
    if (!has_photons_ || balanced || kMore * last.taken > kPassShare * seconds ||
        clock_->seconds() - begin > kShare * seconds)
      break;
  }
  most_photons_ = std::max(kFirst, last.most_photons());
  chooses_photons_ = chooses_photons_ && last.photons > 0.0;
  if (chooses_photons_) {
    const double balanced = last.making > 0.0 ? last.seeing / last.making * photons_ : photons_;
    settings.photons.emitted = static_cast<uint64_t>(rounded(std::clamp(balanced, kFirst, most_photons_), 2));
    given_ = static_cast<double>(settings.photons.emitted);
    if (densities) radii_ = choose_radii(*scene_, *automatic_, *densities, settings);
  }
  widest_ = widest_factor(radii_, *scene_, settings);
}

PassSize WayPilot::usual() const {
  if (!chooses_photons_ || passes_.empty()) return {given_, 1.0};
  const PassModel model = times();
  if (!(model.making.by > 0.0 && model.seeing.at > 0.0)) return {given_, 1.0};
  return {std::clamp(model.seeing.at / model.making.by, kFirst, most_photons_), 1.0};
}

void WayPilot::add_pass(const PassSize& size) {
  const auto same = std::find_if(passes_.begin(), passes_.end(), [&](const Passes& passes) {
    return size.radii == passes.size.radii && size.photons == passes.size.photons;
  });
  Passes& passes = same != passes_.end() ? *same : passes_.emplace_back(Passes{size});
  const SmallPass& made = passes.made.emplace_back(render(size));
  for (MeansOfPasses* means : {&squares_, &blocks_, &corrections_}) means->add(made);
}

void WayPilot::add_passes(int count, const PassSize& size) {
  photons_ = std::min({size.photons, kMostMore * photons_, most_photons_});
  if (chooses_photons_) photons_ = power_of_two_below(photons_);
  for (int i = 0; i < count; ++i) {
    add_pass({photons_, size.radii});
    if (photons_ >= kMore) add_pass({photons_ / kMore, size.radii});
  }
}

double WayPilot::seconds_of_passes(const PassSize& size) const {
  const PassModel model = times();
  const double photons = std::min({size.photons, kMostMore * photons_, most_photons_});
  const double followed = passes_.front().made.front().followed, area = size.radii * size.radii;
  const auto taken = [&](double of) { return model.making(of) + followed * model.seeing(area * of); };
  return taken(photons) + (photons >= kMore ? taken(photons / kMore) : 0.0);
}

const WayPilot::Passes& WayPilot::largest() const {
  return *std::max_element(passes_.begin(), passes_.end(),
                           [](const Passes& a, const Passes& b) { return a.size.photons < b.size.photons; });
}

PassModel WayPilot::times() const {
  std::vector<PointOfLine> making, seeing;
  Moments aiming;
  for (const Passes& passes : passes_)
    for (const SmallPass& pass : passes.made) {
      aiming.add(pass.aiming);
      making.push_back({passes.size.photons, pass.making, 1.0});
      seeing.push_back({passes.size.radii * passes.size.radii * passes.size.photons, pass.seeing, 1.0});
    }
  PassModel model;
  model.making = rising_line(making);
  model.seeing = rising_line(seeing);
  model.making.at += aiming.mean() * static_cast<double>(way_.settings.aimed_photons());
  return model;
}

PassModel WayPilot::model(const Scales& scales) const {
  PassModel model = times();
  if (has_photons_) model.power_of_noise = info_of(way_.settings.integrator).power_of_noise(way_.settings);
  std::vector<PointOfLine> noise;
  for (const Passes& passes : passes_) {
    if (passes.made.size() < 2) continue;
    const double of_photons = std::pow(passes.size.radii, -model.power_of_noise) / std::max(1.0, passes.size.photons);
    noise.push_back({has_photons_ ? of_photons : 0.0, moments_of(noise_of(passes.made, scales)).mean(),
                     static_cast<double>(passes.made.size() - 1)});
  }
  model.noise = rising_line(noise);
  if (has_photons_) model.bias2 = bias2(scales);
  return model;
}

/// Corrections at other radii count as those at the first, each pass as it has photons.
double WayPilot::bias2(const Scales& scales) const {
  Moments pixels;
  for (size_t i = 0; i < kSmallRays; ++i)
    for (int channel = 0; channel < 3; ++channel) {
      double corrected = 0.0, corrected2 = 0.0, weights = 0.0, weights2 = 0.0;
      for (const Passes& passes : passes_) {
        const double weight = passes.size.photons, as_first = std::pow(passes.size.radii, -0.5 * kPowerOfBias);
        for (const SmallPass& pass : passes.made) {
          const double correction = weight * as_first * double{pass.found[i].correction[channel]};
          corrected += correction;
          corrected2 += correction * correction;
          weights += weight;
          weights2 += weight * weight;
        }
      }
      const double pairs = weights * weights - weights2, scale = scales[i / kBlock][channel];
      pixels.add(scale > 0.0 && pairs > 0.0 ? (corrected * corrected - corrected2) / pairs / scale : 0.0);
    }
  return std::max(0.0, pixels.mean());
}

std::vector<double> WayPilot::noise_of_blocks(const Scales& scales) const { return noise_of(largest().made, scales); }

}  // namespace vpm
