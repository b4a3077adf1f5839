// One sub-path from the eye, event by event. What it meets of those from the lights has a file for each technique.
#pragma once

#include <array>
#include <optional>

#include "vpm/estimate/kernel_sum.h"
#include "vpm/integrators/combined/combined.h"
#include "vpm/path/both_sides.h"
#include "vpm/path/direct_light.h"
#include "vpm/path/segments.h"

namespace vpm {

struct MergeSegment;

class EyeSubPath {
 public:
  /// `parts` may be null. Unless `deferred` is, merges along the camera's ray in homogeneous media, before anything
  /// turns it, are left to the caller: their segments are added there, with `number`.
  EyeSubPath(const CombinedContext& context, const Ray& ray, EyeWork& work, TechniqueParts* parts,
             std::vector<MergeSegment>* deferred = nullptr, size_t number = 0);

  KernelEstimate follow();

 private:
  /// A sub-path as it leaves the camera or a vertex.
  struct Branch {
    PathState state;
    Departure from;
    bool only_specular = true;  // are there no other vertices yet?
    float part = 1.0f;          // of the camera's ray, where glass has sent the rest to other branches
    float asks = 1.0f;          // the weight of what techniques find but for lamps that are run into, see asks_with()
    int events = 0;             // so far
  };

  /// The visitor of a ray on its way to the surface that ends it: merges along it.
  struct Along {
    EyeSubPath& path;
    Ray ray;
    MediumId medium;
    Rgb passed{1.0f};  // from the last vertex to the start of the segment
    bool through_scattering = false;

    bool pass(float length, const Encounter&);
  };

  void follow_branch();
  /// The density with which the pixel draws the direction, 1/sr.
  double density_of(const Ray& ray) const;

  /// Takes a ray that comes from the camera to the surface that ends it, attenuated, as if it could not collide; and
  /// from where it does collide a branch of its own. So no chance decides whether the surface is seen.
  std::optional<PathVertex> pass_through();
  /// Follows a branch from where the ray collides, if it does, to its end.
  void branch_off();
  /// Flies to the next vertex, and sees the lights that the flight runs into.
  std::optional<PathVertex> fly();
  /// Flies to the next event; `passed` becomes the transmittance up to it.
  Event fly_to_event(Rgb& passed);
  /// Makes the event a vertex.
  PathVertex arrive_at(const Event& event, const Rgb& passed);
  /// Finds light at a vertex. Returns whether the sub-path goes on from there.
  bool visit(const PathVertex& at);
  /// Draws how the sub-path goes on; at smooth glass that only specular vertices have led to, to both sides.
  bool go_on(const PathVertex& at);
  /// Goes on to the weaker side of glass and leaves the stronger one for later.
  void follow_both_sides(const PathVertex& at, const BothSides& sides);
  Branch side(const PathVertex& at, const Scatter& scatter, float fraction) const;
  /// The throughput of what techniques find along the ray.
  Rgb asked() const { return at_.state.throughput * at_.asks; }

  // connections.cpp
  void see_environment(const Rgb& passed);
  void see_emitter(const PathVertex& at);
  /// Adds what media emit along the ray, up to the first surface, wherever the sub-path collides.
  void see_media();
  /// Adds the light that the sub-path has run into, at a point with that normal.
  void run_into(int number, const Leg& leg, const Vec3& point, const Vec3& normal, const Rgb& emitted);
  /// Likewise where the light's sub-path departs so.
  void run_into(const Departure& start, const Leg& leg, const Junction& at_light, const Vec3& point,
                const Rgb& emitted);
  /// Samples a light, or each; on surfaces that light passes, for either side.
  void sample_light(const PathVertex& at);
  /// Seen from a place just off a surface: rays that are aimed from there meet what they are aimed at.
  void sample_light(const PathVertex& at, const Receiver& side);
  /// The light of that number, whose samples have the weight.
  void sample_light(const PathVertex& at, const Receiver& side, int number, float weight);
  void sample_medium(const PathVertex& at, const Receiver& side, int number, float weight);
  /// Connects the vertex to some vertices of light sub-paths, drawn from all.
  void connect(const PathVertex& at);
  void connect_to(const PathVertex& at, const PathVertex& light);

  // A file for each
  void merge_surface(const PathVertex& at);
  /// On a surface that reflects diffusely, seen from that side of it.
  void merge_diffuse(const PathVertex& at, const Vec3& side, const Rgb& reflectance);
  void merge_points_3d(const PathVertex& at);
  void merge_along_ray(const Along& along, const Interval& interval);

  /// Adds what a technique finds, of which it has a share.
  void add(Technique technique, const KernelEstimate& found, double share);
  void add_merged(Technique technique, const Rgb& found, const KernelPair<float>& kernel, double share);
  Departure depart_into(const PathVertex& at, const Vec3& direction, const Densities& densities) const {
    return depart(c_.counts, at, direction, densities, SubPath::eye, at_.only_specular);
  }

  const CombinedContext& c_;
  EyeWork& work_;
  TechniqueParts* parts_;
  std::vector<MergeSegment>* deferred_;
  size_t number_;
  Branch at_;
  std::array<Branch, kMostWaiting> branches_;  // the first `waiting_`
  size_t waiting_ = 0;                         // of branches
  KernelEstimate radiance_;
};

/// A normalised kernel and its correction, of a squared distance, m^2.
template <int Dimension>
auto kernel_of(KernelKind kind, float radius) {
  const float norm = kernel_norm<Dimension>(kind, radius), inverse = 1.0f / (radius * radius);
  return [kind, norm, inverse](float distance2) {
    return with_kernel<Dimension>(kind, [&](auto profile) { return profile(distance2 * inverse); }) * norm;
  };
}

}  // namespace vpm
