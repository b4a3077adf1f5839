// A segment is cut where the reach of a source begins or ends; each part is marched by the finest step that is asked
// for.
#include "vpm/estimate/volume/marched.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace vpm {

/// One segment under way.
class MarchedLight::March {
 public:
  March(const MarchedLight& light, const EyeSegment& segment, EyeWork& work)
      : light_(light), segment_(segment), work_(work), throughput_(segment.throughput) {}

  KernelEstimate whole() {
    std::array<float, 2 * kMostSources + 2> cuts{segment_.interval.t0, segment_.interval.t1};
    size_t number = 2;
    for (size_t i = 0; i < light_.sources_.size(); ++i) {
      reaches_[i] = light_.sources_[i]->reach(segment_);
      if (reaches_[i].interval.empty()) continue;
      cuts[number++] = reaches_[i].interval.t0;
      cuts[number++] = reaches_[i].interval.t1;
    }
    std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(number));
    for (size_t i = 1; i < number; ++i) part({cuts[i - 1], cuts[i]});
    segment_.set_integral(integral_);
    return radiance_;
  }

 private:
  /// Adds what is scattered along a part of the segment, and attenuates by it.
  void part(const Interval& interval) {
    if (interval.empty() || is_black(throughput_)) return;
    const Medium& medium = *segment_.medium();
    StepLimits limits{kInfinity, light_.max_optical_step_, glm::greaterThan(throughput_ * medium.sigma_s, Rgb(0.0f))};
    std::array<const MarchedSource*, kMostSources> asked;
    size_t number = 0;
    for (size_t i = 0; i < light_.sources_.size(); ++i) {
      const auto& [reach, step] = reaches_[i];
      if (reach.t0 > interval.t0 || reach.t1 < interval.t1) continue;
      limits.length = std::min(limits.length, step);
      asked[number++] = light_.sources_[i].get();
    }
    if (number == 0) return attenuate(counted_density_integral(medium, segment_.ray, interval, work_.counters.walk));
    const float densest = medium.max_density();  // weights are those of relative densities
    const auto add = [&](const Vec3& point, const Rgb& weight) {
      const Rgb seen = throughput_ * (weight / densest);
      for (size_t i = 0; i < number; ++i) radiance_ += seen * asked[i]->at(segment_, point, work_);
    };
    const Marched marched = work_.scratch.marcher.march(medium, segment_.ray, interval, limits, work_.rng, add);
    count(work_.counters.steps, marched.steps);
    count(work_.counters.walk.lookups, marched.lookups);
    attenuate(marched.integral);
  }

  void attenuate(double integral) {
    integral_ += integral;
    throughput_ *= transmittance(*segment_.medium(), integral);
  }

  const MarchedLight& light_;
  const EyeSegment& segment_;
  EyeWork& work_;
  std::array<MarchedSource::Reach, kMostSources> reaches_;
  Rgb throughput_;
  double integral_ = 0.0;  // m, so far
  KernelEstimate radiance_;
};

MarchedLight::MarchedLight(std::vector<std::unique_ptr<MarchedSource>> sources, float max_optical_step)
    : sources_(std::move(sources)), max_optical_step_(max_optical_step) {
  assert(!sources_.empty() && sources_.size() <= kMostSources);
}

ScatteredLight MarchedLight::finds() const {
  ScatteredLight all;
  for (const auto& source : sources_) {
    const ScatteredLight found = source->finds();
    all = {all.once || found.once, all.more || found.more};
  }
  return all;
}

std::vector<MapInfo> MarchedLight::maps() const {
  std::vector<MapInfo> all;
  for (const auto& source : sources_)
    for (const MapInfo& map : source->maps()) all.push_back(map);
  return all;
}

Recorders MarchedLight::recorders() {
  Recorders all;
  for (const auto& source : sources_)
    for (PhotonRecorder* recorder : source->recorders()) all.push_back(recorder);
  return all;
}

void MarchedLight::build(uint64_t emitted, RenderStatistics& statistics) {
  for (const auto& source : sources_) source->build(emitted, statistics);
}

KernelEstimate MarchedLight::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.medium() || !segment.medium()->scatters()) return {};
  return March(*this, segment, work).whole();
}

}  // namespace vpm
