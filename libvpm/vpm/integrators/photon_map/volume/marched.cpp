// A segment is cut where the reach of a source begins or ends; each part is marched by the finest step that is asked
// for.
#include "vpm/integrators/photon_map/volume/marched.h"

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
    const auto [t0, t1] = segment_.interval;
    std::array<float, 2 * kMostSources + 2> cuts{t0, t1};
    size_t number = 2;
    for (size_t i = 0; i < light_.sources_.size(); ++i) {
      found_[i].emplace(Found{light_.sources_[i]->reach(segment_)});
      const Interval& reach = found_[i]->reach.interval;
      if (reach.empty()) continue;
      cuts[number++] = std::clamp(reach.t0, t0, t1);
      cuts[number++] = std::clamp(reach.t1, t0, t1);
    }
    std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(number));
    for (size_t i = 1; i < number; ++i) part({cuts[i - 1], cuts[i]});
    segment_.set_integral(integral_);
    KernelEstimate radiance;
    for (size_t i = 0; i < light_.sources_.size(); ++i) radiance += past_ends_and_shared(i);
    return radiance;
  }

 private:
  /// What is found of a source.
  struct Found {
    MarchedSource::Reach reach;
    KernelEstimate radiance{};
  };

  /// Adds what is scattered along a part of the segment, and attenuates by it.
  void part(const Interval& interval) {
    if (interval.empty() || is_black(throughput_)) return;
    const Medium& medium = *segment_.medium();
    StepLimits limits = limits_of(throughput_);
    std::array<size_t, kMostSources> asked;
    size_t number = 0;
    for (size_t i = 0; i < light_.sources_.size(); ++i) {
      const auto& [reach, step, points] = found_[i]->reach;
      if (reach.t0 > interval.t0 || reach.t1 < interval.t1) continue;
      limits.length = std::min(limits.length, step);
      asked[number++] = i;
    }
    if (number == 0) return attenuate(counted_density_integral(medium, segment_.ray, interval, work_.counters.walk));
    const auto add = [&](const Vec3& point, const Rgb& weight) {
      for (size_t i = 0; i < number; ++i) add_point(asked[i], point, throughput_ * weight);
    };
    attenuate(march(interval, limits, add).integral);
  }

  /// Adds what a source finds past the segment's ends, where the eye sees as far as to the mirrored places, and
  /// corrects the light of the source.
  KernelEstimate past_ends_and_shared(size_t i) {
    Found& found = *found_[i];
    if (!found.reach.points) return found.radiance;
    found.radiance += segment_.throughput * light_.sources_[i]->evenly(segment_, found.reach, work_);
    if (found.reach.interval.empty()) return found.reach.points->over_share(found.radiance, work_);
    const auto [t0, t1] = segment_.interval;
    const Mirrored mirror = found.reach.points->mirrored();
    if (found.reach.interval.t0 < t0) past_end(i, {t0, mirror(found.reach.interval.t0)}, t0, segment_.throughput);
    if (found.reach.interval.t1 > t1) {
      const float from = mirror(found.reach.interval.t1);
      const Rgb seen = seen_at(from);
      if (!is_black(seen)) past_end(i, {from, t1}, t1, segment_.throughput * seen);
    }
    return found.reach.points->over_share(found.radiance, work_);
  }

  /// The transmittance to a place of the segment, which has been marched. Below 1 % by Russian roulette, as past dense
  /// segments there is little to see.
  Rgb seen_at(float t) {
    constexpr float kRouletteBelow = 0.01f;
    const Medium& medium = *segment_.medium();
    const double beyond =
        counted_density_integral(medium, segment_.ray, {t, segment_.interval.t1}, work_.counters.walk);
    const Rgb seen = transmittance(medium, std::max(0.0, integral_ - beyond));
    const float survival = max_channel(seen) / kRouletteBelow;
    if (survival >= 1.0f) return seen;
    return work_.rng.uniform() < survival ? seen / survival : Rgb(0.0f);
  }

  /// Adds what a source finds at the places that mirror an interval of the segment at its end.
  void past_end(size_t i, const Interval& mirrored, float end, const Rgb& throughput) {
    StepLimits limits = limits_of(throughput);
    limits.length = found_[i]->reach.step;
    const Vec3 twice_end = 2.0f * segment_.ray.at(end);
    march(mirrored, limits,
          [&](const Vec3& point, const Rgb& weight) { add_point(i, twice_end - point, throughput * weight); });
  }

  StepLimits limits_of(const Rgb& throughput) const {
    return {kInfinity, light_.max_optical_step_, glm::greaterThan(throughput * segment_.medium()->sigma_s, Rgb(0.0f))};
  }

  /// `seen` is the weight of the point times the throughput at the start of the march.
  void add_point(size_t i, const Vec3& point, const Rgb& seen) {
    const float densest = segment_.medium()->max_density();  // weights are those of relative densities
    found_[i]->radiance += seen / densest * light_.sources_[i]->at(segment_, found_[i]->reach, point, work_);
  }

  template <class Add>
  Marched march(const Interval& interval, const StepLimits& limits, Add&& add) {
    const Marched marched =
        work_.scratch.marcher.march(*segment_.medium(), segment_.ray, interval, limits, work_.rng, add);
    count(work_.counters.steps, marched.steps);
    count(work_.counters.walk.lookups, marched.lookups);
    return marched;
  }

  void attenuate(double integral) {
    integral_ += integral;
    throughput_ *= transmittance(*segment_.medium(), integral);
  }

  const MarchedLight& light_;
  const EyeSegment& segment_;
  EyeWork& work_;
  std::array<std::optional<Found>, kMostSources> found_;  // of the sources that there are
  Rgb throughput_;
  double integral_ = 0.0;  // m, so far
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
