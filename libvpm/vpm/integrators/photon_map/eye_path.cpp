// Meets, crosses and scatters; what light is there to be seen is the estimators' matter.
#include "vpm/integrators/photon_map/eye_path.h"

#include <array>
#include <cassert>

#include "vpm/path/both_sides.h"
#include "vpm/path/walk.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

/// A place on an eye path, from which it goes on.
struct Branch {
  PathState state;  // throughput without `radiance_scale`: of all branches together, it is at most that of the start
  float radiance_scale = 1.0f;  // the product of Scatter::radiance_scale
  float asks = 1.0f;            // the weight of what estimators find; 0: they are not asked
  int events = 0;               // so far
  Vec3 start{0.0f};             // the normal of what the ray left last, on the side that it is on; 0: the camera
};

/// The normal of what was hit, on the side that a direction leads to.
Vec3 towards(const Hit& hit, const Vec3& direction) {
  return glm::dot(hit.normal, direction) < 0.0f ? -hit.normal : hit.normal;
}

/// Counts what is gathered while it lives as of media.
class CountsOfMedia {
 public:
  explicit CountsOfMedia(EyeCounters& counters) : counters_(counters), before_(counters.gather) {}
  ~CountsOfMedia() {
    const GatherCounters& after = counters_.gather;
    counters_.used_in_media += after.used - before_.used;
    counters_.by_count_in_media += after.by_count - before_.by_count;
    counters_.short_in_media += after.short_of - before_.short_of;
  }
  CountsOfMedia(const CountsOfMedia&) = delete;
  CountsOfMedia& operator=(const CountsOfMedia&) = delete;

 private:
  EyeCounters& counters_;
  const GatherCounters before_;
};

class EyePath {
 public:
  EyePath(const EyeContext& context, const Ray& ray, EyeWork& work)
      : c_(context),
        work_(work),
        at_{.state = {ray, medium_of_ray(context.scene, context.scene.camera_medium, ray), Rgb(1.0f)}} {}

  /// Follows the path, and all that it branches into, to the end.
  void follow() {
    follow_branch();
    while (waiting_ > 0) {
      at_ = branches_[--waiting_];
      follow_branch();
    }
  }
  const KernelEstimate& radiance() const { return radiance_; }

  /// Goes on to the next surface or boundary, whatever lies on the way. False where the path is cut.
  bool begin_segment() {
    if (at_.events >= c_.max_events) {
      ++work_.counters.cut_paths;
      return false;
    }
    const Ray& ray = at_.state.ray;
    met_ = meet(c_.scene, ray, kInfinity, at_.state.medium, work_.counters.walk);
    const Interval interval{0.0f, met_ ? met_.hits[0].t : kInfinity};
    const Vec3 end = met_ ? towards(met_.hits[0], -ray.direction) : Vec3(0.0f);
    segment_.emplace(c_.scene, Segment{ray, interval, at_.state.medium, seen()}, Borders{at_.start, end});
    return true;
  }

  /// Adds what media scatter towards the eye along the segment.
  void gather() {
    const CountsOfMedia counts(work_.counters);
    if (at_.asks > 0.0f)
      for (const auto& estimator : c_.estimators.volume) add(Rgb(at_.asks) * estimator->along(*segment_, work_));
  }

  /// Attenuates by the segment, and goes on from what ends it. False where the branch ends.
  bool end_segment() {
    see_medium();
    at_.state.throughput *= segment_->transmittance(work_);
    if (is_black(at_.state.throughput)) return false;
    if (!met_) {
      see_environment();
      return false;
    }
    const Hit& hit = met_.hits[0];
    const Material material = material_at(c_.scene, hit);
    see_emitter(hit);
    if (is_boundary(material)) {  // no event
      cross_boundaries(c_.scene, met_, at_.state.ray, at_.state.medium, work_.counters.walk);
      at_.start = towards(hit, at_.state.ray.direction);
      return true;
    }
    if (is_rough(material)) {
      see_surface(hit, material);
      return false;
    }
    ++at_.events;
    return go_on(hit, material);
  }

  bool is_straight() const { return at_.events == 0; }
  const EyeSegment& segment() const { return *segment_; }
  EyeWork& work() { return work_; }
  void add(const KernelEstimate& found) { radiance_ += found; }

 private:
  /// Goes on to the branch's end.
  void follow_branch() {
    while (begin_segment()) {
      gather();
      if (!end_segment()) return;
    }
  }

  /// What radiance counts for that arrives at the present place.
  Rgb seen() const { return at_.state.throughput * at_.radiance_scale; }

  /// Adds what the medium emits along the segment.
  void see_medium() {
    const Medium* medium = segment_->around();
    if (!medium || !medium->emits()) return;
    const EmittedLight light = emitted_along(*medium, segment_->ray, segment_->interval, work_.counters.walk.lookups);
    segment_->set_integral(light.integral);
    radiance_ += seen() * light.radiance;
  }

  void see_environment() {
    for (const Light& light : c_.scene.lights)
      radiance_ += seen() * environment_radiance(light, at_.state.ray.direction);
  }

  /// Adds what a surface emits towards the eye.
  void see_emitter(const Hit& hit) {
    const int light = c_.scene.shapes[hit.shape].light;
    if (light >= 0) radiance_ += seen() * surface_radiance(c_.scene.lights[light], hit.normal, at_.state.ray.direction);
  }

  /// Adds what a rough surface scatters towards the eye.
  void see_surface(const Hit& hit, const Material& material) {
    const SurfaceView view{hit, material, at_.state.ray.direction, at_.state.medium};
    if (c_.estimators.surface && at_.asks > 0.0f)
      radiance_ += at_.asks * seen() * c_.estimators.surface->sent(view, work_);
  }

  /// Goes on from a specular surface: to both sides of smooth glass, where the weaker one is worth it, else to one side
  /// that is drawn. Returns whether the path goes on.
  bool go_on(const Hit& hit, const Material& material) {
    const float part = max_channel(at_.state.throughput);
    if (const std::optional<BothSides> sides = both_sides(material, hit, at_.state.ray.direction, part)) {
      follow_both_sides(hit, *sides);
      return true;
    }
    Scatter scatter;
    if (!scatter_at_surface(c_.scene, hit, at_.state, work_.rng, scatter)) return false;
    at_.radiance_scale *= scatter.radiance_scale;
    at_.start = towards(hit, at_.state.ray.direction);
    return true;
  }

  /// Goes on to the weaker side and leaves the stronger one for later.
  void follow_both_sides(const Hit& hit, const BothSides& sides) {
    const Branch back = side(hit, sides.back, sides.reflected);
    const Branch beyond = side(hit, sides.beyond, 1.0f - sides.reflected);
    assert(waiting_ < kMostWaiting);
    branches_[waiting_++] = sides.mostly_beyond() ? beyond : back;
    at_ = sides.mostly_beyond() ? back : beyond;
  }

  Branch side(const Hit& hit, const Scatter& scatter, float fraction) {
    Branch branch = at_;
    branch.state.throughput *= scatter.weight * fraction;
    branch.radiance_scale *= scatter.radiance_scale;
    branch.asks *= asks_with(fraction, work_.rng);
    leave_along(c_.scene, hit, scatter, branch.state);
    branch.start = towards(hit, branch.state.ray.direction);
    return branch;
  }

  const EyeContext& c_;
  EyeWork& work_;
  Branch at_;
  std::array<Branch, kMostWaiting> branches_;  // the first `waiting_`
  size_t waiting_ = 0;
  Encounter met_;                      // at the end of the segment
  std::optional<EyeSegment> segment_;  // that the path is on
  KernelEstimate radiance_;
};

/// Paths of some rays of a bundle.
class EyePaths {
 public:
  void add(EyePath& path) { paths_[size_++] = &path; }
  std::span<EyePath* const> all() const { return {paths_.data(), size_}; }
  bool empty() const { return size_ == 0; }

 private:
  std::array<EyePath*, kEyeRays> paths_;
  size_t size_ = 0;
};

/// Gathers along the segments of paths that are in one homogeneous medium.
void gather_together(const EyeContext& context, const Vec3& camera, std::span<EyePath* const> paths) {
  std::array<BundledSegment, kEyeRays> segments{};
  for (size_t i = 0; i < paths.size(); ++i) segments[i] = {&paths[i]->segment(), &paths[i]->work()};
  const CountsOfMedia counts(paths.front()->work().counters);
  const SegmentBundle bundle(segments.data(), paths.size());
  for (const auto& estimator : context.estimators.volume) estimator->along_bundle(camera, bundle);
  for (size_t i = 0; i < paths.size(); ++i) paths[i]->add(segments[i].light);
}

/// Gathers along the segments of all paths, together where they are in the same homogeneous medium.
void gather_by_media(const EyeContext& context, const Vec3& camera, EyePaths paths) {
  while (!paths.empty()) {
    const EyeSegment& first = paths.all().front()->segment();
    EyePaths alike, others;
    for (EyePath* path : paths.all()) (path->segment().medium == first.medium ? alike : others).add(*path);
    if (first.around() && first.around()->homogeneous() && alike.all().size() > 1)
      gather_together(context, camera, alike.all());
    else
      for (EyePath* path : alike.all()) path->gather();
    paths = others;
  }
}

}  // namespace

KernelEstimate eye_radiance(const EyeContext& context, const Ray& camera_ray, EyeWork& work) {
  EyePath path(context, camera_ray, work);
  path.follow();
  return path.radiance();
}

void eye_radiance(const EyeContext& context, std::span<EyeRay> rays) {
  std::array<std::optional<EyePath>, kEyeRays> paths;
  EyePaths straight;
  for (size_t i = 0; i < rays.size(); ++i) straight.add(paths[i].emplace(context, rays[i].ray, rays[i].work));
  while (!straight.empty()) {
    EyePaths on_segments;
    for (EyePath* path : straight.all())
      if (path->begin_segment()) on_segments.add(*path);
    gather_by_media(context, rays.front().ray.origin, on_segments);
    straight = {};
    for (EyePath* path : on_segments.all()) {
      if (!path->end_segment()) continue;
      if (path->is_straight())
        straight.add(*path);
      else
        path->follow();
    }
  }
  for (size_t i = 0; i < rays.size(); ++i) rays[i].radiance = paths[i]->radiance();
}

}  // namespace vpm
