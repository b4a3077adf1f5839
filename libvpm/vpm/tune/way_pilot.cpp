// Differences between passes measure noise, products of corrections of different passes measure bias. What one way to
// render has not seen, others may show.
#include "vpm/tune/way_pilot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vpm/base/statistics/moments.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/describe.h"

namespace vpm {
namespace {

constexpr double kFewest = 1000.0, kMore = 4.0;  // photons; as the number grows from pass to pass at first
constexpr double kMostMore = 8.0;                // as it grows later
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kSquares = kBlockRays / kBlock;

/// The number of the square that a pixel of a pass lies in.
size_t square_of(const SmallPass& pass, size_t i) {
  return pass.blocks[i / kBlockRays] * kSquares + i % kBlockRays / kBlock;
}

/// The noise of a pass in block after block, relative to the scales; each block counts as the mean of its pixels.
std::vector<double> noise_in_blocks(const std::vector<SmallPass>& passes, const Scales& scales) {
  const SmallPass& first = passes.front();
  std::vector<double> noise(first.blocks.size(), 0.0);
  for (size_t i = 0; i < first.found.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) {
      const double scale = scales[square_of(first, i)][channel];
      Moments moments;
      for (const SmallPass& pass : passes) moments.add(double{pass.found[i].value[channel]});
      if (scale > 0.0) noise[i / kBlockRays] += moments.variance() / scale / (3.0 * kBlockRays);
    }
  return noise;
}

Moments moments_of(const std::vector<double>& values) {
  Moments moments;
  for (const double value : values) moments.add(value);
  return moments;
}

/// What a channel of passes shows in a block.
struct Shown {
  double mean = 0.0, standard_error = 0.0, correction = 0.0;
  double sure = 0.0;  // standard errors that are no chance: more where these are known by few passes
};
struct ShownByPasses {
  Moments light, correction;

  Shown shown() const {
    return {light.mean(), std::sqrt(light.variance_of_mean()), correction.mean(),
            4.0 + 24.0 / static_cast<double>(light.count())};
  }
};

/// The relative square of the light that `other` surely shows and `own` does not; `mean` of the picture.
double unseen_square(const Shown& own, const Shown& other, double mean) {
  const double least = other.mean - other.sure * other.standard_error - 2.0 * std::abs(other.correction);
  const double most = own.mean + own.sure * own.standard_error + 2.0 * std::abs(own.correction);
  const double missing = std::max(0.0, least - most);
  return missing * missing / relative_scale(other.mean, mean);
}

/// A few passes say little of the standard error of one block: none is taken to be less sure than all are together.
void even_out(std::vector<Shown>& blocks) {
  double squares = 0.0, lights = 0.0;
  for (const Shown& block : blocks) {
    squares += block.standard_error * block.standard_error;
    lights += block.mean * block.mean;
  }
  const double relative = lights > 0.0 ? std::sqrt(squares / lights) : 0.0;
  for (Shown& block : blocks) block.standard_error = std::max(block.standard_error, relative * std::abs(block.mean));
}

}  // namespace

WayPilot::WayPilot(const Scene& scene, const AutomaticSettings& automatic, const Clock& clock, Way way)
    : scene_(&scene), automatic_(&automatic), clock_(&clock), way_(std::move(way)) {}

bool WayPilot::chooses_photons() const {
  return automatic_->has("integrator.photons.emitted") && info_of(way_.settings.integrator).power_of_noise != nullptr;
}

void WayPilot::scale_radii(double factor, RenderSettings& settings) const {
  const double most = kLargestRadius * scene_->bounds.diagonal();
  for (const Choice& choice : radii_) {
    const Setting setting = find_setting(settings, choice.key).value();
    const double radius = std::get<float>(setting.get());
    setting.set(static_cast<float>(rounded(std::min(factor * radius, std::max(radius, most)), 3)));
  }
}

SmallPass WayPilot::render(const PassSize& size) {
  RenderSettings settings = way_.settings;
  settings.seed = ~settings.seed;  // what is chosen does not depend on the photons that the render will gather
  settings.radii = RadiusSchedule::constant;
  settings.photons.emitted = static_cast<uint64_t>(std::max(1.0, size.photons));
  settings.caustics.emitted = std::min(settings.caustics.emitted, settings.photons.emitted);
  if (size.radii != 1.0) scale_radii(size.radii, settings);
  return render_small(*scene_, settings, number_++, taken_, *clock_);
}

void WayPilot::find_size(double seconds) {
  constexpr double kOfRadii = 20'000.0,
                   kOfRadiiByTime = 2000.0;  // photons by which radii are found, at most, in a second
  constexpr double kPassShare = 0.2, kShare = 0.5, kPassesToCome = 10.0;
  const double begin = clock_->seconds();
  RenderSettings& settings = way_.settings;
  const bool has_photons = info_of(settings.integrator).power_of_noise != nullptr;
  if (has_photons) {
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
    if (!has_photons || balanced || kMore * last.taken > kPassShare * seconds ||
        clock_->seconds() - begin > kShare * seconds)
      break;
  }
  const PixelRect rendered = scene_->camera.rendered();
  const double of_rays =
      last.seeing * static_cast<double>(last.found.size()) / (double{1} * rendered.width() * rendered.height());
  if (kMore * of_rays * kPassesToCome < kShare * seconds) taken_ = BlocksTaken::all;
  if (!chooses_photons() || last.photons == 0.0) return;
  photons_ = last.photons;
  most_photons_ = std::max(kFewest, last.most_photons());
  const double each = last.making / last.photons;
  settings.photons.emitted =
      static_cast<uint64_t>(rounded(std::clamp(last.seeing / each, kFewest, std::max(kFewest, most_photons_)), 2));
  if (densities_) radii_ = choose_radii(*scene_, *automatic_, *densities_, settings);
}

PassSize WayPilot::usual() const {
  const PassSize given{static_cast<double>(way_.settings.photons.emitted), 1.0};
  if (!chooses_photons() || passes_.empty()) return given;
  const PassModel model = times();
  if (model.making.by == 0.0) return given;
  return {std::clamp(model.seeing.at / model.making.by, kFewest, std::max(kFewest, most_photons_)), 1.0};
}

void WayPilot::add_pass(const PassSize& size) {
  constexpr double kAlike = 1.3;
  const auto same = std::find_if(passes_.begin(), passes_.end(), [&](const Passes& passes) {
    const double more = size.photons / passes.size.photons;
    return size.radii == passes.size.radii && (!(more >= 0.0) || (more < kAlike && more > 1.0 / kAlike));
  });
  Passes& passes = same != passes_.end() ? *same : passes_.emplace_back(Passes{size});
  passes.made.push_back(render(passes.size));
}

void WayPilot::add_passes(int count, const PassSize& size) {
  const bool has_photons = info_of(way_.settings.integrator).power_of_noise != nullptr;
  photons_ = has_photons ? std::min(size.photons, kMostMore * photons_) : 0.0;
  for (int i = 0; i < count; ++i) {
    add_pass({photons_, size.radii});
    if (photons_ >= kMore) add_pass({photons_ / kMore, size.radii});
  }
}

template <class Use>
void WayPilot::each_pass(Use&& use) const {
  for (const Passes& passes : passes_)
    for (const SmallPass& pass : passes.made) use(pass, passes.size);
}

const WayPilot::Passes& WayPilot::largest() const {
  return *std::max_element(passes_.begin(), passes_.end(),
                           [](const Passes& a, const Passes& b) { return a.size.photons < b.size.photons; });
}

double WayPilot::seconds_of_passes(const PassSize& size) const {
  const PixelRect rendered = scene_->camera.rendered();
  const auto followed = static_cast<double>(passes_.front().made.front().found.size());
  const double share = followed / (double{1} * rendered.width() * rendered.height());
  const PassModel model = times();
  const double photons = photons_ > 0.0 ? std::min(size.photons, kMostMore * photons_) : 0.0;
  const auto taken = [&](double of) { return model.making(of) + share * model.seeing(size.radii * size.radii * of); };
  return taken(photons) + (photons >= kMore ? taken(photons / kMore) : 0.0);
}

std::vector<Rgbd> WayPilot::surely_shown() const {
  constexpr double kSure = 2.0;  // standard errors
  std::vector<std::array<Moments, 3>> squares(kAllBlocks * kSquares);
  each_pass([&](const SmallPass& pass, const PassSize&) {
    for (size_t first = 0; first < pass.found.size(); first += kBlock) {
      Rgbd mean(0.0);
      for (size_t i = first; i < first + kBlock; ++i) mean += Rgbd(pass.found[i].value) / double{kBlock};
      for (int channel = 0; channel < 3; ++channel) squares[square_of(pass, first)][channel].add(mean[channel]);
    }
  });
  std::vector<Rgbd> surely(squares.size(), Rgbd(kNone));
  for (size_t i = 0; i < squares.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) {
      const Moments& light = squares[i][channel];
      if (light.count() > 1)
        surely[i][channel] = std::max(0.0, light.mean() - kSure * std::sqrt(light.variance_of_mean()));
    }
  return surely;
}

PassModel WayPilot::times() const {
  std::vector<Measured> making, seeing;
  double aiming = 0.0, passes = 0.0;
  each_pass([&](const SmallPass& pass, const PassSize& size) {
    aiming += pass.aiming;
    ++passes;
    making.push_back({size.photons, pass.making, 1.0});
    seeing.push_back({size.radii * size.radii * size.photons, pass.seeing, 1.0});
  });
  PassModel model;
  model.making = rising_line(making);
  model.making.at += aiming / passes * static_cast<double>(way_.settings.aimed_photons());
  model.seeing = rising_line(seeing);
  return model;
}

PassModel WayPilot::model(const Scales& scales) const {
  PassModel model = times();
  const auto power = info_of(way_.settings.integrator).power_of_noise;
  if (power) model.power_of_noise = power(way_.settings);
  std::vector<Measured> noise;
  for (const Passes& passes : passes_) {
    if (passes.made.size() < 2) continue;
    const double x = power ? std::pow(passes.size.radii, -model.power_of_noise) / passes.size.photons : 0.0;
    noise.push_back(
        {x, moments_of(noise_in_blocks(passes.made, scales)).mean(), static_cast<double>(passes.made.size() - 1)});
  }
  model.noise = rising_line(noise);
  if (power) model.bias2 = bias2(scales, model.noise, model.power_of_noise);
  return model;
}

/// Corrections at other radii count as those at the first, each pass as it has little noise.
double WayPilot::bias2(const Scales& scales, const Line& noise, double power) const {
  const SmallPass& first = passes_.front().made.front();
  std::vector<double> blocks(first.blocks.size(), 0.0);
  for (size_t i = 0; i < first.found.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) {
      const double scale = scales[square_of(first, i)][channel];
      double corrected = 0.0, corrected2 = 0.0, weights = 0.0, weights2 = 0.0;
      each_pass([&](const SmallPass& pass, const PassSize& size) {
        const double wider = std::pow(size.radii, 0.5 * kPowerOfBias);
        const double variance = noise(std::pow(size.radii, -power) / size.photons);
        const double weight = wider * wider / std::max(variance, 1e-30);
        const double correction = weight * double{pass.found[i].correction[channel]} / wider;
        corrected += correction;
        corrected2 += correction * correction;
        weights += weight;
        weights2 += weight * weight;
      });
      const double pairs = weights * weights - weights2;
      if (scale > 0.0 && pairs > 0.0)
        blocks[i / kBlockRays] += (corrected * corrected - corrected2) / pairs / scale / (3.0 * kBlockRays);
    }
  return std::max(0.0, moments_of(blocks).mean());
}

double WayPilot::doubt(const Scales& scales) const {
  const Moments blocks = moments_of(noise_in_blocks(largest().made, scales));
  return blocks.mean() > 0.0 ? std::sqrt(blocks.variance_of_mean()) / blocks.mean() : 0.0;
}

std::vector<double> WayPilot::noise_of_blocks(const Scales& scales) const {
  std::vector<double> all(kAllBlocks, kNone);
  const std::vector<SmallPass>& passes = largest().made;
  const std::vector<double> taken = noise_in_blocks(passes, scales);
  for (size_t i = 0; i < taken.size(); ++i) all[passes.front().blocks[i]] = taken[i];
  return all;
}

double WayPilot::blocks() const { return static_cast<double>(passes_.front().made.front().blocks.size()); }

double WayPilot::rays() const {
  double rays = 0.0;
  each_pass([&](const SmallPass& pass, const PassSize&) { rays += static_cast<double>(pass.found.size()); });
  return rays * way_.settings.samples_per_pixel;
}

Unseen WayPilot::unseen_beside(const WayPilot& other) const {
  // Blocks that both have followed: the quarter is part of all.
  const std::vector<uint32_t>& own_blocks = passes_.front().made.front().blocks;
  const std::vector<uint32_t>& others = other.passes_.front().made.front().blocks;
  const std::vector<uint32_t>& common = own_blocks.size() < others.size() ? own_blocks : others;
  const auto shown_by = [&](const WayPilot& pilot, int channel) {
    std::vector<ShownByPasses> found(common.size() + 1);  // the last: all blocks
    pilot.each_pass([&](const SmallPass& pass, const PassSize&) {
      Rgbd light(0.0), correction(0.0);
      for (size_t block = 0; block < common.size(); ++block) {
        const size_t at = static_cast<size_t>(std::lower_bound(pass.blocks.begin(), pass.blocks.end(), common[block]) -
                                              pass.blocks.begin());
        double of_block = 0.0, correction_of_block = 0.0;
        for (size_t i = at * kBlockRays; i < (at + 1) * kBlockRays; ++i) {
          of_block += double{pass.found[i].value[channel]} / double{kBlockRays};
          correction_of_block += double{pass.found[i].correction[channel]} / double{kBlockRays};
        }
        found[block].light.add(of_block);
        found[block].correction.add(correction_of_block);
        light[0] += of_block / static_cast<double>(common.size());
        correction[0] += correction_of_block / static_cast<double>(common.size());
      }
      found.back().light.add(light[0]);
      found.back().correction.add(correction[0]);
    });
    std::vector<Shown> shown;
    for (const ShownByPasses& each : found) shown.push_back(each.shown());
    return shown;
  };
  Unseen unseen;
  const auto blocks = static_cast<double>(common.size());
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<Shown> own = shown_by(*this, channel), theirs = shown_by(other, channel);
    const Shown own_all = own.back(), all = theirs.back();
    own.pop_back();
    theirs.pop_back();
    if (all.mean <= 0.0) continue;
    even_out(own);
    even_out(theirs);
    for (size_t block = 0; block < own.size(); ++block)
      unseen.in_blocks += unseen_square(own[block], theirs[block], all.mean) / blocks / 3.0;
    unseen.in_all += unseen_square(own_all, all, all.mean) / 3.0;
  }
  return unseen;
}

}  // namespace vpm
