// Differences between passes measure noise, products of corrections of different passes measure bias.
#include "vpm/tune/way_pilot.h"

#include <algorithm>
#include <cmath>

#include "vpm/integrators/default_radii.h"

namespace vpm {
namespace {

constexpr double kFewest = 1000.0, kMore = 4.0;  // photons; as the number grows from pass to pass at first
constexpr double kMostMore = 8.0;                // as it grows later

/// Which value of Scales is that of a pixel of a pass.
size_t square_of(const SmallPass& pass, size_t i) {
  return (pass.blocks[i / kBlockRays] * kBlockRays + i % kBlockRays) / kBlock;
}

/// The noise of a pass relative to the scales: of all blocks, of which each counts as the mean of its pixels; NaN where
/// it was not followed.
std::vector<double> noise_of(const std::vector<SmallPass>& passes, const Scales& scales) {
  const SmallPass& first = passes.front();
  std::vector<double> noise(kAllBlocks, NAN);
  for (size_t block = 0; block < first.blocks.size(); ++block) {
    double sum = 0.0;
    for (size_t i = block * kBlockRays; i < (block + 1) * kBlockRays; ++i)
      for (int channel = 0; channel < 3; ++channel) {
        Moments values;
        for (const SmallPass& pass : passes) values.add(double{pass.found[i].value[channel]});
        const double scale = scales[square_of(first, i)][channel];
        if (scale > 0.0) sum += values.variance() / scale;
      }
    noise[first.blocks[block]] = sum / (3.0 * kBlockRays);
  }
  return noise;
}

/// That nearest, so that passes of about one size are of the same.
double power_of_two(double value) { return std::exp2(std::round(std::log2(std::max(1.0, value)))); }

}  // namespace

WayPilot::WayPilot(const Scene& scene, const AutomaticSettings& automatic, const Clock& clock, Way way)
    : scene_(&scene),
      automatic_(&automatic),
      clock_(&clock),
      way_(std::move(way)),
      has_photons_(info_of(way_.settings.integrator).power_of_noise != nullptr) {}

SmallPass WayPilot::render(const PassSize& size) {
  RenderSettings settings = way_.settings;
  settings.seed = ~settings.seed;  // what is chosen does not depend on the photons that the render will gather
  settings.radii = RadiusSchedule::constant;
  settings.photons.emitted = static_cast<uint64_t>(std::max(1.0, size.photons));
  settings.caustics.emitted = std::min(settings.caustics.emitted, settings.photons.emitted);
  if (size.radii != 1.0) scale_radii(radii_, size.radii, *scene_, settings);
  return render_small(*scene_, settings, number_++, taken_, *clock_);
}

void WayPilot::find_size(double seconds) {
  constexpr double kOfRadii = 20'000.0,
                   kOfRadiiByTime = 2000.0;  // photons by which radii are found, at most, in a second
  constexpr double kPassShare = 0.2, kShare = 0.5, kPassesToCome = 10.0;
  const double begin = clock_->seconds();
  RenderSettings& settings = way_.settings;
  if (has_photons_) {
    const double photons = std::clamp(kOfRadiiByTime * seconds, 0.1 * kOfRadii, kOfRadii);
    densities_ = densities_for_radii(static_cast<uint64_t>(photons), *scene_, *automatic_, settings);
  }
  if (densities_) radii_ = choose_radii(*scene_, *automatic_, *densities_, settings);
  const auto given = static_cast<double>(settings.photons.emitted);
  const double most = chooses_photons() || given == 0.0 ? double{kInfinity} : given;
  SmallPass last;
  for (photons_ = std::min(kFewest, most);; photons_ = std::min(kMore * photons_, most)) {
    last = render({photons_, 1.0});
    const bool balanced = last.making >= last.seeing || photons_ == most;
    if (!has_photons_ || balanced || kMore * last.taken > kPassShare * seconds ||
        clock_->seconds() - begin > kShare * seconds)
      break;
  }
  if (kMore * last.seeing * last.followed * kPassesToCome < kShare * seconds) taken_ = BlocksTaken::all;
  if (!chooses_photons() || last.photons == 0.0) return;
  photons_ = last.photons;
  most_photons_ = std::max(kFewest, last.most_photons());
  const double balanced = last.seeing / last.making * last.photons;
  settings.photons.emitted = static_cast<uint64_t>(rounded(std::clamp(balanced, kFewest, most_photons_), 2));
  if (densities_) radii_ = choose_radii(*scene_, *automatic_, *densities_, settings);
}

PassSize WayPilot::usual() const {
  const PassSize given{static_cast<double>(way_.settings.photons.emitted), 1.0};
  if (!chooses_photons() || passes_.empty()) return given;
  const PassModel model = times();
  if (model.making.by == 0.0) return given;
  return {std::clamp(model.seeing.at / model.making.by, kFewest, most_photons_), 1.0};
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
  photons_ = has_photons_ ? std::min(size.photons, kMostMore * photons_) : 0.0;
  if (chooses_photons()) photons_ = power_of_two(photons_);
  for (int i = 0; i < count; ++i) {
    add_pass({photons_, size.radii});
    if (photons_ >= kMore) add_pass({photons_ / kMore, size.radii});
  }
}

double WayPilot::seconds_of_passes(const PassSize& size) const {
  const PassModel model = times();
  const double photons = has_photons_ ? std::min(size.photons, kMostMore * photons_) : 0.0;
  const double followed = passes_.front().made.front().followed;
  const auto taken = [&](double of) {
    return model.making(of) + followed * model.seeing(size.radii * size.radii * of);
  };
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
    const double of_photons = std::pow(passes.size.radii, -model.power_of_noise) / passes.size.photons;
    noise.push_back({has_photons_ ? of_photons : 0.0, moments_of_known(noise_of(passes.made, scales)).mean(),
                     static_cast<double>(passes.made.size() - 1)});
  }
  model.noise = rising_line(noise);
  if (has_photons_) model.bias2 = bias2(scales);
  return model;
}

/// Corrections at other radii count as those at the first, each pass as it has photons.
double WayPilot::bias2(const Scales& scales) const {
  const SmallPass& first = passes_.front().made.front();
  Moments pixels;
  for (size_t i = 0; i < first.found.size(); ++i)
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
      const double pairs = weights * weights - weights2, scale = scales[square_of(first, i)][channel];
      pixels.add(scale > 0.0 && pairs > 0.0 ? (corrected * corrected - corrected2) / pairs / scale : 0.0);
    }
  return std::max(0.0, pixels.mean());
}

std::vector<double> WayPilot::noise_of_blocks(const Scales& scales) const { return noise_of(largest().made, scales); }

}  // namespace vpm
