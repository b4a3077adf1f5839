// Light sources: the closed set. Each tells its power, emits photons, and can be sampled from a point.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "base/rng.h"
#include "base/vec.h"

namespace vpm {

/// The sphere around everything that light from infinity has to reach.
struct SceneSphere {
  Vec3 centre{0.0f};    // m
  float radius = 0.0f;  // m
};

struct PointLight {
  Vec3 position{0.0f};  // m
  Rgb intensity{1.0f};  // W/sr
};
/// Full intensity inside the inner cone, none outside the outer one, smoothstep in the cosine between.
struct SpotLight {
  Vec3 position{0.0f};                       // m
  Vec3 direction{0.0f, -1.0f, 0.0f};         // unit
  float cos_inner = 0.9f, cos_outer = 0.8f;  // 1 >= cos_inner >= cos_outer > -1
  Rgb intensity{1.0f};                       // W/sr
};
/// Parallel light from a disc, uniform over it.
struct BeamLight {
  Vec3 position{0.0f};                // of the disc's centre, m
  Vec3 direction{0.0f, -1.0f, 0.0f};  // unit
  float radius = 0.1f;                // m, > 0
  Rgb power{1.0f};                    // W
};
/// A parallelogram that emits to the side of its normal, cross(edge_u, edge_v).
struct QuadLight {
  Vec3 corner{0.0f}, edge_u{1.0f, 0.0f, 0.0f}, edge_v{0.0f, 1.0f, 0.0f};  // m; the edges need not be orthogonal
  Rgb radiance{1.0f};                                                     // W/(m^2 sr)
};
/// A sphere that emits outwards.
struct SphereLight {
  Vec3 centre{0.0f};    // m
  float radius = 1.0f;  // m
  Rgb radiance{1.0f};   // W/(m^2 sr)
};
/// Parallel light from infinity.
struct DirectionalLight {
  Vec3 direction{0.0f, -1.0f, 0.0f};  // of travel, unit
  Rgb irradiance{1.0f};               // on a plane perpendicular to it, W/m^2
};
/// The same radiance from all directions.
struct ConstantEnvironment {
  Rgb radiance{1.0f};  // W/(m^2 sr)
};
/// An equirectangular picture of radiance, piecewise constant over its pixels: column = azimuth from +z over +x,
/// row 0 = straight up (+y). Sampled by luminance.
class ImageEnvironment {
 public:
  /// `texels`: width * height radiances in W/(m^2 sr), rows from the top. Throws InputError unless all are finite
  /// and >= 0, and not all black.
  ImageEnvironment(int width, int height, std::vector<Rgb> texels);
  /// Radiance that arrives from direction `d` (unit, pointing away from the scene).
  Rgb radiance(const Vec3& d) const;
  /// A direction away from the scene, distributed as pdf().
  struct Sample {
    Vec3 direction{0.0f};  // unit
    float pdf = 0.0f;      // of the sampled texel, 1/sr
    Rgb radiance{0.0f};    // of the sampled texel, where rounding may put the direction into its neighbour
  };
  Sample sample(Rng& rng) const;
  /// The density of sample() at `d`, 1/sr: luminance over its integral.
  float pdf(const Vec3& d) const;
  /// Integral of radiance over the sphere, W/m^2.
  Rgbd integral() const { return integral_; }
  /// Are all texels grey?
  bool grey() const { return grey_; }

 private:
  size_t texel_at(const Vec3& d) const;

  int width_ = 0, height_ = 0;
  std::vector<Rgb> texels_;
  std::vector<double> cumulative_;  // of luminance times solid angle, size width * height + 1
  Rgbd integral_{0.0};
  bool grey_ = false;
};
struct EnvironmentMap {
  std::shared_ptr<const ImageEnvironment> image;
};

using Light = std::variant<PointLight, SpotLight, BeamLight, QuadLight, SphereLight, DirectionalLight,
                           ConstantEnvironment, EnvironmentMap>;

/// Power emitted into the scene, W. Lights at infinity: what enters the scene's sphere, pi radius^2 times the
/// irradiance across each direction.
Rgb light_power(const Light& light, const SceneSphere& scene);
/// Does the light's emission lack any colour?
bool is_grey(const Light& light);
/// Is the light at infinity, so that it needs vacuum around the scene?
bool is_infinite(const Light& light);

/// One emitted photon: where it starts, and the power it stands for if this light emitted this photon alone. Its
/// expectation over photons is light_power(); for all lights but EnvironmentMap every photon carries exactly that. Area
/// lights are shapes of the scene: their photons start just off the surface, so as not to meet it.
struct Emission {
  Ray ray;
  Rgb power{0.0f};  // W
};
Emission emit(const Light& light, const SceneSphere& scene, Rng& rng);

/// Light that arrives at a point without obstacles.
struct Incident {
  Vec3 direction{0.0f};        // from the point towards the light, unit
  float distance = kInfinity;  // m, to the light's surface: the next hit along `direction` may be that surface itself
  Rgb irradiance{0.0f};        // on a surface that faces the light, W/m^2: an estimate whose mean over samples is the
                               // integral of radiance
  float pdf = 0.0f;            // of the direction, 1/sr; 0 where the light has one direction only
};
/// Samples the light that reaches `point`; nothing where none can. A point inside a sphere light gets nothing.
std::optional<Incident> sample_towards(const Light& light, const Vec3& point, Rng& rng);

/// The density of sample_towards() from `point` at the unit `direction`, in which the light's surface is seen at
/// `distance` (environments: any), 1/sr; 0 where it never samples that direction, and for lights of one direction only.
/// For multiple importance sampling [Veach1997, ch. 9].
float incident_pdf(const Light& light, const Vec3& point, const Vec3& direction, float distance);

/// Radiance of an environment seen along `direction`, W/(m^2 sr); black for other lights.
Rgb environment_radiance(const Light& light, const Vec3& direction);
/// Radiance that an area light's surface of outward normal `normal` emits against `travel`, the direction of the ray
/// that sees it, W/(m^2 sr); black from behind, and for other lights.
Rgb surface_radiance(const Light& light, const Vec3& normal, const Vec3& travel);

}  // namespace vpm
