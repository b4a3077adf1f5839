// A segment is cut where the reach of photons begins or ends; between, steps are no longer than photons ask for.
#include "vpm/integrators/photon_map/volume/marched.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "vpm/photon/stored_power.h"

namespace vpm {

/// One segment under way.
class MarchedLight::March {
 public:
  March(const MarchedLight& light, const EyeSegment& segment, EyeWork& work)
      : light_(light), segment_(segment), work_(work), throughput_(segment.throughput) {
    if (light.photons_) find_photons(*light.photons_);
  }

  KernelEstimate whole() {
    const auto [t0, t1] = segment_.interval;
    float begin = t0, end = t0;
    if (!among_.empty()) {
      begin = std::clamp(among_.t0, t0, t1);
      end = std::clamp(among_.t1, t0, t1);
    }
    part({t0, begin});
    part({begin, end});
    part({end, t1});
    segment_.set_integral(integral_);
    if (points_) finish_photons();
    return by_photons_ + by_lights_;
  }

 private:
  void find_photons(const VolumeMaps<PhotonMap>& maps) {
    const Box& around = maps.around(segment_.medium);
    if (around.empty()) return;
    const PhotonMap& map = maps[segment_.medium];
    points_.emplace(segment_, map, around, VolumeForm::density_at_query);
    if (points_->seen_one_by_one()) return;
    among_ = points_->reach();
    step_ = step_among(map.settings.radius, among_);
  }

  /// Adds what is scattered along a part of the segment, and attenuates by it.
  void part(const Interval& interval) {
    if (interval.empty() || is_black(throughput_)) return;
    const bool among_photons = among_.t0 <= interval.t0 && among_.t1 >= interval.t1;
    if (!among_photons && !light_.lights_)
      return attenuate(counted_density_integral(*segment_.around(), segment_.ray, interval, work_.counters.walk));
    const StepLimits limits = limits_of(throughput_, among_photons ? step_ : kInfinity);
    const auto add = [&](const Vec3& point, const Rgb& weight) {
      if (among_photons) add_photons(point, throughput_ * weight);
      if (light_.lights_) add_lights(*light_.lights_, point, throughput_ * weight);
    };
    attenuate(march(interval, limits, add).integral);
  }

  /// Adds the photons that have a march of their own, and those past the segment's ends, where the eye sees as far as
  /// to the mirrored places; and corrects what photons bring.
  void finish_photons() {
    if (points_->seen_one_by_one()) {
      const KernelEstimate light = source_factor(*segment_.around()) * points_->march_evenly(work_);
      by_photons_ += segment_.throughput * light;
    }
    if (!among_.empty()) add_past_ends();
    by_photons_ = points_->over_share(by_photons_, work_);
  }

  void add_past_ends() {
    const auto [t0, t1] = segment_.interval;
    const Mirrored mirror = points_->mirrored();
    if (among_.t0 < t0) past_end({t0, mirror(among_.t0)}, t0, segment_.throughput);
    if (among_.t1 <= t1) return;
    const float from = mirror(among_.t1);
    const Rgb seen = seen_at(from);
    if (!is_black(seen)) past_end({from, t1}, t1, segment_.throughput * seen);
  }

  /// The transmittance to a place of the segment, which has been marched. Below 1 % by Russian roulette, as past dense
  /// segments there is little to see.
  Rgb seen_at(float t) {
    constexpr float kRouletteBelow = 0.01f;
    const Medium& medium = *segment_.around();
    const double beyond =
        counted_density_integral(medium, segment_.ray, {t, segment_.interval.t1}, work_.counters.walk);
    const Rgb seen = transmittance(medium, std::max(0.0, integral_ - beyond));
    const float survival = max_channel(seen) / kRouletteBelow;
    if (survival >= 1.0f) return seen;
    return work_.rng.uniform() < survival ? seen / survival : Rgb(0.0f);
  }

  /// Adds the photons at the places that mirror an interval of the segment at its end.
  void past_end(const Interval& mirrored, float end, const Rgb& throughput) {
    const Vec3 twice_end = 2.0f * segment_.ray.at(end);
    march(mirrored, limits_of(throughput, step_),
          [&](const Vec3& point, const Rgb& weight) { add_photons(twice_end - point, throughput * weight); });
  }

  StepLimits limits_of(const Rgb& throughput, float length) const {
    return {length, light_.max_optical_step_, glm::greaterThan(throughput * segment_.around()->sigma_s, Rgb(0.0f))};
  }

  /// `seen` is the weight of the point times the throughput at the start of the march. Weights are those of densities
  /// over the largest, times that.
  void add_photons(const Vec3& point, const Rgb& seen) {
    const Medium& medium = *segment_.around();
    const KernelEstimate light = source_factor(medium) * points_->sum(point, work_);
    by_photons_ += seen / medium.max_density() * light;
  }
  void add_lights(const ScatteredOnce& lights, const Vec3& point, const Rgb& seen) {
    const Medium& medium = *segment_.around();
    const Rgb light =
        medium.sigma_s * medium.max_density() * lights.towards_eye(lights.pick(work_.rng), segment_, point, work_);
    by_lights_ += seen / medium.max_density() * light;
  }

  template <class Add>
  Marched march(const Interval& interval, const StepLimits& limits, Add&& add) {
    const Marched marched =
        work_.scratch.marcher.march(*segment_.around(), segment_.ray, interval, limits, work_.rng, add);
    count(work_.counters.steps, marched.steps);
    count(work_.counters.walk.lookups, marched.lookups);
    return marched;
  }

  void attenuate(double integral) {
    integral_ += integral;
    throughput_ *= transmittance(*segment_.around(), integral);
  }

  const MarchedLight& light_;
  const EyeSegment& segment_;
  EyeWork& work_;
  std::optional<PointsOfSegment> points_;  // where there are photons in the medium
  Interval among_{0.0f, 0.0f};             // where points are asked for them; may reach past the segment's ends
  float step_ = kInfinity;                 // the longest step there, m
  KernelEstimate by_photons_{};
  Rgb by_lights_{0.0f};
  Rgb throughput_;
  double integral_ = 0.0;  // m, so far
};

MarchedLight::MarchedLight(std::optional<VolumeMaps<PhotonMap>> photons, std::optional<ScatteredOnce> lights,
                           float max_optical_step)
    : photons_(std::move(photons)), lights_(std::move(lights)), max_optical_step_(max_optical_step) {
  assert(photons_ || lights_);
}

ScatteredLight MarchedLight::finds() const {
  const ScatteredLight found = photons_ ? photons_->finds() : ScatteredLight{};
  return {found.once || lights_, found.more};
}

std::vector<MapInfo> MarchedLight::maps() const { return photons_ ? photons_->maps() : std::vector<MapInfo>(); }

Recorders MarchedLight::recorders() { return photons_ ? photons_->recorders() : Recorders(); }

void MarchedLight::build(uint64_t emitted, RenderStatistics& statistics) {
  if (photons_) build_around_points(*photons_, emitted, statistics);
}

KernelEstimate MarchedLight::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.around() || !segment.around()->scatters()) return {};
  return March(*this, segment, work).whole();
}

}  // namespace vpm
