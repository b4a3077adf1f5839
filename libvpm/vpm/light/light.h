// Lights, a closed set. Each has a power, emits photons, and can be sampled from a point.
#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/vec.h"
#include "vpm/light/image_environment.h"
#include "vpm/surface/geometry.h"

namespace vpm {

class EmittingVolume;

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
  Vec3 position{0.0f};                // of the disc's center, m
  Vec3 direction{0.0f, -1.0f, 0.0f};  // unit
  float radius = 0.1f;                // m, > 0
  Rgb power{1.0f};                    // W
};
/// A parallelogram that emits to the side of its normal, cross(edge_u, edge_v).
struct QuadLight {
  Vec3 corner{0.0f}, edge_u{1.0f, 0.0f, 0.0f}, edge_v{0.0f, 1.0f, 0.0f};  // m; the edges need not be orthogonal
  Rgb radiance{1.0f};                                                     // W/(m^2 sr)
};
/// A disc that emits to the side of its normal.
struct DiscLight {
  Vec3 center{0.0f};              // m
  Vec3 normal{0.0f, 1.0f, 0.0f};  // unit
  float radius = 1.0f;            // m
  Rgb radiance{1.0f};             // W/(m^2 sr)
};
/// A sphere that emits outwards.
struct SphereLight {
  Vec3 center{0.0f};    // m
  float radius = 1.0f;  // m
  Rgb radiance{1.0f};   // W/(m^2 sr)
};
/// Triangles from which points are drawn, uniformly over their total area.
class EmittingMesh {
 public:
  /// Throws InputError if no triangle has an area. The vertices that triangles name must exist.
  explicit EmittingMesh(TriangleMesh mesh);
  /// The total area, m^2.
  double area() const { return cumulative_.back(); }
  struct Sample {
    Vec3 position{0.0f};  // m
    Vec3 normal{0.0f};    // unit, outward
    float slack = 0.0f;   // m, as in Hit
  };
  /// A point of the mesh: the uniform number `choice` picks the triangle, `u` the point on it.
  Sample sample(double choice, const Vec2& u) const;
  /// The box around all vertices of the triangles.
  Box bounds() const;
  size_t memory_bytes() const {
    return mesh_.positions.size() * sizeof(Vec3) + mesh_.triangles.size() * sizeof(glm::uvec3) +
           mesh_.normals.size() * sizeof(Vec3) + mesh_.uvs.size() * sizeof(Vec2) + cumulative_.size() * sizeof(double);
  }

 private:
  TriangleMesh mesh_;
  std::vector<double> cumulative_;  // cumulative areas, m^2: one entry more than triangles
};
/// Triangles that emit to the sides of their outward normals. They may occlude each other.
struct MeshLight {
  std::shared_ptr<const EmittingMesh> mesh;
  Rgb radiance{1.0f};  // W/(m^2 sr)
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
/// Radiance by a picture.
struct EnvironmentMap {
  std::shared_ptr<const ImageEnvironment> image;
};

/// What a medium emits (medium/emission.h). Its radiance along rays, and the power of its photons, take the scene: see
/// path/emission_along.h and photon/emission.h.
struct VolumeLight {
  int medium = 0;  // in Scene::media
  std::shared_ptr<const EmittingVolume> volume;
  Rgb power{0.0f};  // W: of what lies inside the medium, once the scene is finished
};

using Light = std::variant<PointLight, SpotLight, BeamLight, QuadLight, DiscLight, SphereLight, MeshLight,
                           DirectionalLight, ConstantEnvironment, EnvironmentMap, VolumeLight>;

// Three classes of lights; each kind of light belongs to one, or is a VolumeLight.
template <class L, class... Kinds>
concept OneOf = (std::same_as<L, Kinds> || ...);
/// Lights that no ray can hit.
template <class L>
concept UnseenLight = OneOf<L, PointLight, SpotLight, BeamLight>;
/// Lights that are shapes of the scene. They emit `radiance`.
template <class L>
concept AreaLight = OneOf<L, QuadLight, DiscLight, SphereLight, MeshLight>;
/// Lights at infinity.
template <class L>
concept DistantLight = OneOf<L, DirectionalLight, ConstantEnvironment, EnvironmentMap>;

/// The power emitted into the scene, W. For lights at infinity it is the power that enters the box `scene`, which must
/// contain everything that the light has to reach and must have a volume.
Rgb light_power(const Light& light, const Box& scene);
/// The memory of the light's mesh or picture.
size_t light_memory_bytes(const Light& light);
/// The name of the kind of light, in a word or two.
std::string_view light_kind(const Light& light);
/// Is the light's emission grey?
bool is_grey(const Light& light);
/// Is the light at infinity, so that it needs vacuum around the scene?
bool is_infinite(const Light& light);

/// The radiance that arrives equally from all directions, W/(m^2 sr); nothing for lights that are no such environment.
std::optional<Rgb> even_radiance(const Light& light);

/// The place of a light.
struct LightPlace {
  Box bounds;        // m, around all points that its photons start from
  Vec3 point{0.0f};  // m, one of these points: for area lights one just in front of the surface
};
/// Nothing for lights at infinity.
std::optional<LightPlace> light_place(const Light& light);

/// The uniform numbers in [0, 1) that determine one emission. No light uses all of them.
struct EmissionNumbers {
  double choice = 0.0;  // picks a triangle, a texel, or a part of a cone
  double face = 0.0;    // picks the face of the scene's box where light from infinity enters
  Vec2 place{0.0f};     // picks the place on the light, or on that face
  Vec2 direction{0.0f};
};
EmissionNumbers draw_emission_numbers(Rng& rng);

/// One emitted photon: its ray, and the power that it would carry if it were the light's only photon. The expectation
/// of that power is light_power(); for all lights except EnvironmentMap every photon carries exactly light_power(). Not
/// for a VolumeLight.
/// Photons of area lights start just off the surface, because area lights are shapes of the scene that the photons
/// could meet. Photons of lights at infinity start where they enter the box.
struct Emission {
  Ray ray;
  Rgb power{0.0f};    // W
  Vec3 normal{0.0f};  // of an area light where the photon starts, unit, outward
};
Emission emit(const Light& light, const Box& scene, const EmissionNumbers& u);
inline Emission emit(const Light& light, const Box& scene, Rng& rng) {
  return emit(light, scene, draw_emission_numbers(rng));
}

/// Light that arrives at a point if nothing stands between.
struct Incident {
  Vec3 direction{0.0f};        // from the point towards the light, unit
  float distance = kInfinity;  // m, to the light's surface: the next hit along `direction` may be that surface itself
  Rgb irradiance{0.0f};        // on a surface that faces the light, W/m^2: an estimate whose mean over samples is the
                               // integral of radiance
  float pdf = 0.0f;            // of the direction, 1/sr; 0 where the light has one direction only
  Vec3 normal{0.0f};           // of an area light where the light comes from, unit, outward
};
/// Samples the light that reaches `point`; nothing if none can, and of a VolumeLight (see sample_direct()). A point
/// inside a sphere light receives nothing. Occlusion by other parts of a mesh light is not tested.
std::optional<Incident> sample_towards(const Light& light, const Vec3& point, Rng& rng);

/// A point of a light.
struct LightPoint {
  Vec3 position{0.0f};  // m
  Vec3 normal{0.0f};    // unit, outward; zero for point, spot and sphere lights
  float area = 0.0f;    // m^2, over which the point was drawn uniformly; 0 for those lights
};
/// Draws a point of a light; of a sphere it is the center. Places near that point receive more light than those far
/// away. Nothing for parallel light and for lights at infinity, which do not fall off.
std::optional<LightPoint> draw_light_point(const Light& light, Rng& rng);
/// sample_towards() from the point `from`, which draw_light_point() drew on that light. Over both draws the mean is the
/// same.
std::optional<Incident> sample_towards(const Light& light, const LightPoint& from, const Vec3& point, Rng& rng);

/// A light that a ray hit.
struct SeenLight {
  Vec3 direction{0.0f};        // of the ray, unit
  float distance = kInfinity;  // m, to the light's surface
  Vec3 normal{0.0f};           // unit, outward, of the surface there; without meaning for environments
};
/// The density with which sample_towards() from `point` samples the direction of `seen`, 1/sr. It is 0 if that never
/// happens, and for lights of one direction only. For multiple importance sampling [Veach1997, ch. 9].
float incident_pdf(const Light& light, const Vec3& point, const SeenLight& seen);

/// Radiance of an environment seen along `direction`, W/(m^2 sr); black for other lights.
Rgb environment_radiance(const Light& light, const Vec3& direction);
/// Radiance that the surface of an area light, with the outward normal `normal`, emits against `travel`, the direction
/// of the ray that sees it, W/(m^2 sr). Black from behind, and for other lights.
Rgb surface_radiance(const Light& light, const Vec3& normal, const Vec3& travel);

/// The first number of a light that is out of its range, and that range, as a clause: "its radius must be positive and
/// finite"; "" where there is none. A light that is black is wrong. The shape of an area light is not looked at.
std::string problem_of(const Light& light);

}  // namespace vpm
