// Meets, crosses and scatters; what light is there to be seen is the estimators' matter.
#include "vpm/render/eye_path.h"

#include "vpm/path/walk.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

class EyePath {
 public:
  EyePath(const EyeContext& context, const Ray& ray, EyeWork& work)
      : c_(context), work_(work), ray_(ray), medium_(medium_of_ray(context.scene, context.scene.camera_medium, ray)) {}

  Rgb follow() {
    for (int events = 0; events < c_.max_events;) {
      const Encounter met = meet(c_.scene, ray_, kInfinity, medium_, work_.counters.walk);
      cross({0.0f, met ? met.hits[0].t : kInfinity}, met ? towards(met.hits[0], -ray_.direction) : Vec3(0.0f));
      if (is_black(throughput_)) return radiance_;
      if (!met) {
        see_environment();
        return radiance_;
      }
      const Hit& hit = met.hits[0];
      const Material material = material_at(c_.scene, hit);
      see_emitter(hit);
      if (is_boundary(material)) {  // no event
        cross_boundaries(c_.scene, met, ray_, medium_, work_.counters.walk);
        start_ = towards(hit, ray_.direction);
        continue;
      }
      if (!meet_surface(hit, material)) return radiance_;
      ++events;
    }
    ++work_.counters.cut_paths;
    return radiance_;
  }

 private:
  /// The normal of what was hit, on the side that a direction leads to.
  static Vec3 towards(const Hit& hit, const Vec3& direction) {
    return glm::dot(hit.normal, direction) < 0.0f ? -hit.normal : hit.normal;
  }

  /// Adds what media scatter towards the eye along the segment, which ends at a surface of the normal `end`, and
  /// attenuates by it.
  void cross(const Interval& interval, const Vec3& end) {
    const EyeSegment segment(c_.scene, ray_, interval, medium_, throughput_, {start_, end});
    for (const auto& estimator : c_.estimators.volume) radiance_ += estimator->along(segment, work_);
    throughput_ *= segment.transmittance(work_);
  }

  void see_environment() {
    for (const Light& light : c_.scene.lights) radiance_ += throughput_ * environment_radiance(light, ray_.direction);
  }

  /// Adds what a surface emits towards the eye.
  void see_emitter(const Hit& hit) {
    const int light = c_.scene.shapes[hit.shape].light;
    if (light >= 0) radiance_ += throughput_ * surface_radiance(c_.scene.lights[light], hit.normal, ray_.direction);
  }

  /// Adds what a rough surface scatters towards the eye; goes on from others. Returns whether the path goes on.
  bool meet_surface(const Hit& hit, const Material& material) {
    if (is_rough(material)) {
      const SurfaceView view{hit, material, ray_.direction, medium_};
      if (c_.estimators.surface) radiance_ += throughput_ * c_.estimators.surface->sent(view, work_);
      return false;
    }
    PathState state{ray_, medium_, throughput_};
    Scatter scatter;
    if (!scatter_at_surface(c_.scene, hit, state, work_.rng, scatter)) return false;
    ray_ = state.ray;
    start_ = towards(hit, ray_.direction);
    medium_ = state.medium;
    throughput_ = state.throughput * scatter.radiance_scale;
    return true;
  }

  const EyeContext& c_;
  EyeWork& work_;
  Ray ray_;
  MediumId medium_;
  Vec3 start_{0.0f};  // the normal of what the ray left last
  Rgb throughput_{1.0f};
  Rgb radiance_{0.0f};
};

}  // namespace

Rgb eye_radiance(const EyeContext& context, const Ray& camera_ray, EyeWork& work) {
  return EyePath(context, camera_ray, work).follow();
}

}  // namespace vpm
