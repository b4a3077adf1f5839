// Meets, crosses and scatters; what light is there to be seen is the estimators' matter.
#include "vpm/render/eye_path.h"

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

class EyePath {
 public:
  EyePath(const EyeContext& context, const Ray& ray, EyeWork& work)
      : c_(context),
        work_(work),
        at_{.state = {ray, medium_of_ray(context.scene, context.scene.camera_medium, ray), Rgb(1.0f)}} {}

  KernelEstimate follow() {
    follow_branch();
    while (waiting_ > 0) {
      at_ = branches_[--waiting_];
      follow_branch();
    }
    return radiance_;
  }

 private:
  /// Goes on to the branch's end.
  void follow_branch() {
    Ray& ray = at_.state.ray;
    while (at_.events < c_.max_events) {
      const Encounter met = meet(c_.scene, ray, kInfinity, at_.state.medium, work_.counters.walk);
      cross({0.0f, met ? met.hits[0].t : kInfinity}, met ? towards(met.hits[0], -ray.direction) : Vec3(0.0f));
      if (is_black(at_.state.throughput)) return;
      if (!met) return see_environment();
      const Hit& hit = met.hits[0];
      const Material material = material_at(c_.scene, hit);
      see_emitter(hit);
      if (is_boundary(material)) {  // no event
        cross_boundaries(c_.scene, met, ray, at_.state.medium, work_.counters.walk);
        at_.start = towards(hit, ray.direction);
        continue;
      }
      if (is_rough(material)) return see_surface(hit, material);
      ++at_.events;
      if (!go_on(hit, material)) return;
    }
    ++work_.counters.cut_paths;
  }

  /// What radiance counts for that arrives at the present place.
  Rgb seen() const { return at_.state.throughput * at_.radiance_scale; }

  /// Adds what media scatter towards the eye along the segment, which ends at a surface of the normal `end`, and
  /// attenuates by it.
  void cross(const Interval& interval, const Vec3& end) {
    const EyeSegment segment(c_.scene, at_.state.ray, interval, at_.state.medium, seen(), {at_.start, end});
    const uint64_t used = work_.counters.gather.used;
    if (at_.asks > 0.0f)
      for (const auto& estimator : c_.estimators.volume) radiance_ += Rgb(at_.asks) * estimator->along(segment, work_);
    work_.counters.used_in_media += work_.counters.gather.used - used;
    at_.state.throughput *= segment.transmittance(work_);
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
  KernelEstimate radiance_;
};

}  // namespace

KernelEstimate eye_radiance(const EyeContext& context, const Ray& camera_ray, EyeWork& work) {
  return EyePath(context, camera_ray, work).follow();
}

}  // namespace vpm
