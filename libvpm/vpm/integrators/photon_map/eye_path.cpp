// Meets, crosses and scatters; what light is there to be seen is the estimators' matter.
#include "vpm/integrators/photon_map/eye_path.h"

#include <array>
#include <cassert>

#include "vpm/base/even_points.h"
#include "vpm/estimate/shared_gather.h"
#include "vpm/path/both_sides.h"
#include "vpm/path/walk.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

constexpr float kAlikeShading = 0.999f;   // the cosine between normals that light is shared at, at the least
constexpr float kMostThroughput = 16.0f;  // of a ray that takes light, over that of the one that gives it

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

/// What a path gives to the rays of its square, or takes from the one that gathers for them: of segments that are
/// straight from the camera.
class SharedPath {
 public:
  SharedPath(SharedGather* shared, bool leads) : shared_(shared), leads_(leads) {}

  /// Begins a segment; `straight`: no event lies before it. Behind what the ray that gathers does not see nothing is
  /// shared.
  void begin(const SeenSegment& seen, const Rgb& throughput, bool straight) {
    given_ = nullptr;
    taken_ = nullptr;
    if (!shared_ || !straight) return;
    if (leads_) {
      given_ = shared_->begin(seen, throughput);
      return;
    }
    taken_ = shared_->find(number_++, seen);
    if (!taken_) shared_ = nullptr;
  }
  /// The light of estimator number `estimator` of media for a ray of that throughput; nothing where the path is to
  /// gather for itself.
  std::optional<KernelEstimate> of_media(size_t estimator, const Rgb& throughput) const {
    if (!taken_ || !taken_->light[estimator]) return {};
    // Light of far less throughput may have lost its digits.
    if (!glm::all(glm::greaterThan(kMostThroughput * taken_->throughput, throughput))) return {};
    return *taken_->light[estimator] * (throughput / taken_->throughput);
  }
  const SharedGather::AtSurface* at_surface() const { return taken_ && taken_->surface ? &*taken_->surface : nullptr; }
  /// The segment that others take from; null where none do.
  SharedGather::OfSegment* given() const { return given_; }
  const SharedGather& with() const { return *shared_; }

 private:
  SharedGather* shared_;
  bool leads_;
  size_t number_ = 0;  // of the next segment
  SharedGather::OfSegment* given_ = nullptr;
  const SharedGather::OfSegment* taken_ = nullptr;
};

/// What a path looks for: all light; all but lamps that mirrors and glass show; or these alone.
enum class LookFor { everything, no_lamp_images, lamp_images };

class EyePath {
 public:
  /// Of a ray of a pass.
  EyePath(const EyeContext& context, EyeRay& of)
      : EyePath(context, of.ray, of.work, of_pixel(context, of.work.pixel), SharedPath(of.shared, of.leads)) {}
  EyePath(const EyeContext& context, const Ray& ray, EyeWork& work, LookFor look, SharedPath shared = {nullptr, false})
      : c_(context),
        work_(work),
        look_(look),
        camera_(ray.origin),
        shared_(shared),
        at_{.state = {ray, medium_of_ray(context.scene, context.scene.camera_medium, ray), Rgb(1.0f)},
            .asks = look == LookFor::lamp_images ? 0.0f : 1.0f} {}

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
    const int shape = met_ ? static_cast<int>(met_.hits[0].shape) : -1;
    shared_.begin({at_.state.medium, shape, end, interval.t1}, seen(), is_straight());
    return true;
  }

  /// Adds what media scatter towards the eye along the segment.
  void gather() {
    const CountsOfMedia counts(work_.counters);
    if (!(at_.asks > 0.0f)) return;
    for (size_t i = 0; i < c_.estimators.volume.size(); ++i)
      if (!take(i)) give(i, Rgb(at_.asks) * c_.estimators.volume[i]->along(*segment_, work_));
  }

  /// Adds what an estimator of media has found for the ray that gathers for this one; false where nobody does.
  bool take(size_t estimator) {
    const std::optional<KernelEstimate> light = shared_.of_media(estimator, segment_->throughput);
    if (!light) return false;
    count(work_.counters.shared_gathers);
    radiance_ += *light;
    return true;
  }

  /// Adds what an estimator of media has found, and shares it where that may be.
  void give(size_t estimator, const KernelEstimate& light) {
    const std::optional<float> blur = shared_.given() ? blur_in_medium(estimator) : std::nullopt;
    const KernelEstimate found = blur ? blurred(light, *blur) : light;
    if (blur) shared_.given()->light[estimator] = found;
    radiance_ += found;
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

  /// Adds what other rays see of the lamps that this path leaves to them.
  void add_lamp_images() {
    if (look_ == LookFor::no_lamp_images) radiance_ += lamps_by_images(c_, work_, LampImages::kRays);
  }

  bool is_straight() const { return at_.events == 0; }
  const EyeSegment& segment() const { return *segment_; }
  EyeWork& work() { return work_; }

 private:
  static LookFor of_pixel(const EyeContext& context, size_t pixel) {
    return context.lamp_images && context.lamp_images->in(pixel) ? LookFor::no_lamp_images : LookFor::everything;
  }

  /// The blur of what is shared along the segment; nothing where it is not to be shared.
  std::optional<float> blur_in_medium(size_t estimator) const {
    const Medium* medium = segment_->around();
    if (!medium || !medium->homogeneous() || !is_smooth_over(medium->phase, shared_.with().variance())) return {};
    // Half way to the end, or where light has come a free path.
    const float middle = std::min(0.5f * segment_->interval.t1, 1.0f / mean_channel(medium->sigma_t));
    return shared_.with().blur(glm::distance(camera_, segment_->ray.at(middle)),
                               c_.estimators.volume[estimator]->kernel_variance(segment_->medium));
  }

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
    if (look_ == LookFor::lamp_images || !medium || !medium->emits()) return;
    const EmittedLight light = emitted_along(*medium, segment_->ray, segment_->interval, work_.counters.walk.lookups);
    segment_->set_integral(light.integral);
    radiance_ += seen() * light.radiance;
  }

  void see_environment() {
    if (look_ == LookFor::lamp_images) return;
    for (const Light& light : c_.scene.lights)
      radiance_ += seen() * environment_radiance(light, at_.state.ray.direction);
  }

  /// Adds what a surface emits towards the eye.
  void see_emitter(const Hit& hit) {
    if (look_ == (is_straight() ? LookFor::lamp_images : LookFor::no_lamp_images)) return;
    const int light = c_.scene.shapes[hit.shape].light;
    if (light >= 0) radiance_ += seen() * surface_radiance(c_.scene.lights[light], hit.normal, at_.state.ray.direction);
  }

  /// Adds what a rough surface scatters towards the eye.
  void see_surface(const Hit& hit, const Material& material) {
    const SurfaceView view{hit, material, at_.state.ray.direction, at_.state.medium};
    if (!c_.estimators.surface || !(at_.asks > 0.0f)) return;
    const KernelEstimate by_rays = c_.estimators.surface->found_by_rays(view, work_);
    radiance_ += at_.asks * seen() * (photons_at(view) + by_rays);
  }

  /// What photons bring to a surface: shared where it is diffuse.
  KernelEstimate photons_at(const SurfaceView& view) {
    const Rgb* reflectance = diffuse_reflectance(view.material);
    const SharedGather::AtSurface* taken = reflectance ? shared_.at_surface() : nullptr;
    if (taken && glm::dot(taken->shading_normal, view.hit.shading_normal) >= kAlikeShading) {
      count(work_.counters.shared_gathers);
      return taken->light * (*reflectance / taken->reflectance);
    }
    const KernelEstimate light = c_.estimators.surface->found_by_photons(view, work_);
    const std::optional<float> blur =
        shared_.given() && reflectance && std::min({reflectance->r, reflectance->g, reflectance->b}) > 0.0f
            ? blur_at(view)
            : std::nullopt;
    if (!blur) return light;
    shared_.given()->surface.emplace(view.hit.shading_normal, *reflectance, blurred(light, *blur));
    return blurred(light, *blur);
  }

  std::optional<float> blur_at(const SurfaceView& view) const {
    const float cosine = std::abs(glm::dot(view.hit.normal, view.travel));
    return shared_.with().blur(glm::distance(camera_, view.hit.position) / cosine,
                               c_.estimators.surface->kernel_variance());
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
  LookFor look_;
  Vec3 camera_;  // where the path starts
  SharedPath shared_;
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

void gather_together(const VolumeEstimator& estimator, size_t number, const Vec3& camera,
                     std::span<EyePath* const> paths) {
  std::array<BundledSegment, kEyeRays> segments{};
  for (size_t i = 0; i < paths.size(); ++i) segments[i] = {&paths[i]->segment(), &paths[i]->work()};
  const SegmentBundle bundle(segments.data(), paths.size());
  if (!bundle.empty()) estimator.along_bundle(camera, bundle);
  for (size_t i = 0; i < paths.size(); ++i) paths[i]->give(number, segments[i].light);
}

/// Gathers along the segments of paths that are in one homogeneous medium.
void gather_together(const EyeContext& context, const Vec3& camera, std::span<EyePath* const> paths) {
  const CountsOfMedia counts(paths.front()->work().counters);
  for (size_t number = 0; number < context.estimators.volume.size(); ++number) {
    EyePaths asking;
    for (EyePath* path : paths)
      if (!path->take(number)) asking.add(*path);
    gather_together(*context.estimators.volume[number], number, camera, asking.all());
  }
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
  EyePath path(context, camera_ray, work, LookFor::everything);
  path.follow();
  return path.radiance();
}

void eye_radiance(const EyeContext& context, std::span<EyeRay> rays) {
  std::array<std::optional<EyePath>, kEyeRays> paths;
  EyePaths straight;
  for (size_t i = 0; i < rays.size(); ++i) straight.add(paths[i].emplace(context, rays[i]));
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
  for (size_t i = 0; i < rays.size(); ++i) {
    paths[i]->add_lamp_images();
    rays[i].radiance = paths[i]->radiance();
  }
}

Rgb lamps_by_images(const EyeContext& context, EyeWork& work, uint32_t rays) {
  const Camera& camera = context.scene.camera;
  const auto width = static_cast<size_t>(camera.width);
  const Vec2 middle = Vec2(work.pixel % width, work.pixel / width) + 0.5f;
  const EvenPoints places(rays, work.rng);
  Rgb sum(0.0f);
  for (uint32_t i = 0; i < rays; ++i) {
    const uint64_t place = places[i];
    work.rng.lead({&place, 1});
    const Vec2 film = middle + sample_filter(camera.filter, work.rng.uniform2());
    work.rng.lead({});
    EyePath path(context, camera.ray(film), work, LookFor::lamp_images);
    path.follow();
    sum += path.radiance().value;
  }
  return sum / static_cast<float>(rays);
}

}  // namespace vpm
