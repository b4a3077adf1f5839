// Light sampled from a point: irradiance, radiance integrated over directions, and solid angle, against closed forms.
#include <algorithm>
#include <cmath>
#include <vector>

#include "vpm/light/light.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/directions.h"
#include "vpm/study/validate/scenes/lights.h"

namespace vpm {

namespace {

const Vec3 kNormal(0.0f, 1.0f, 0.0f);  // the receiver's normal

/// What a light of unit radiance, intensity, ... sends to a point.
struct Received {
  std::string name;
  Light light;
  Vec3 point{0.0f};
  double whole = 0.0;  // its radiance integrated over all directions, W/m^2
  double plane = 0.0;  // irradiance of a plane that faces up, W/m^2
  double angle = 0.0;  // solid angle from which it comes, sr; 0 for a single direction
};

/// Unit vectors to the corners of a polygon, in order.
using Polygon = std::vector<Vec3d>;

Polygon seen_from(const Vec3& point, Polygon corners) {
  for (Vec3d& corner : corners) corner = glm::normalize(corner - Vec3d(point));
  return corners;
}

Polygon corners(const QuadLight& light, const Vec3& point) {
  const Vec3d a(light.corner), u(light.edge_u), v(light.edge_v);
  return seen_from(point, {a, a + u, a + u + v, a + v});
}

/// A disc as a polygon of the same area.
Polygon corners(const DiscLight& light, const Vec3& point) {
  constexpr int kEdges = 2000;
  const double turn = 2.0 * kPiD / kEdges, radius = light.radius * std::sqrt(turn / std::sin(turn));
  const Vec3d normal(light.normal), s = glm::normalize(glm::cross(normal, Vec3d(1.0, 0.0, 0.0)));
  const Vec3d t = glm::cross(normal, s);
  Polygon all;
  for (int i = 0; i < kEdges; ++i)
    all.push_back(Vec3d(light.center) + radius * (std::cos(i * turn) * s + std::sin(i * turn) * t));
  return seen_from(point, std::move(all));
}

/// The solid angle of the triangle of three unit vectors [VanOosterom1983, eq. 8].
double triangle_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return 2.0 *
         std::atan2(std::fabs(glm::dot(a, glm::cross(b, c))), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

double polygon_angle(const Polygon& v) {
  double sum = 0.0;
  for (size_t i = 2; i < v.size(); ++i) sum += triangle_angle(v[0], v[i - 1], v[i]);
  return sum;
}

/// Lambert's formula for a polygon above the horizon [Arvo1994, eq. 1]: half the sum over the edges of the angle that
/// each subtends times the cosine of the receiver's normal to the plane through edge and point.
double polygon_irradiance(const Polygon& v, const Vec3d& normal) {
  double sum = 0.0;
  for (size_t i = 0; i < v.size(); ++i) {
    const Vec3d &a = v[i], &b = v[(i + 1) % v.size()];
    const Vec3d across = glm::cross(a, b);
    const double sine = glm::length(across);
    sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(across / sine, normal);
  }
  return 0.5 * std::fabs(sum);
}

Received from_quad() {
  const QuadLight light{{-0.5f, 1.2f, -0.6f}, {1.0f, 0.1f, 0.0f}, {0.3f, 0.2f, 1.1f}, Rgb(1.0f)};  // shines down
  const Vec3 point(0.3f, 0.1f, -0.2f);
  const Polygon c = corners(light, point);
  const double angle = polygon_angle(c);
  return {"quad", light, point, angle, polygon_irradiance(c, Vec3d(kNormal)), angle};
}

Received from_disc() {
  const DiscLight light{{-0.4f, 1.3f, 0.2f}, kAxis, 0.6f, Rgb(1.0f)};
  const Vec3 point(0.4f, 0.1f, -0.1f);
  const Polygon c = corners(light, point);
  const double angle = polygon_angle(c);
  return {"disc", light, point, angle, polygon_irradiance(c, Vec3d(kNormal)), angle};
}

/// A tetrahedron. Of a convex body what faces the point is what is seen from it.
Received from_mesh() {
  const TriangleMesh mesh = test_tetrahedron();
  const Vec3 point(-0.7f, 0.4f, -0.6f);
  double angle = 0.0, plane = 0.0;
  for (const glm::uvec3& v : mesh.triangles) {
    const Vec3d a(mesh.positions[v.x]), b(mesh.positions[v.y]), c(mesh.positions[v.z]);
    if (glm::dot(glm::cross(b - a, c - a), Vec3d(point) - a) <= 0.0) continue;
    const Polygon face = seen_from(point, {a, b, c});
    angle += polygon_angle(face);
    plane += polygon_irradiance(face, Vec3d(kNormal));
  }
  return {"mesh", MeshLight{std::make_shared<EmittingMesh>(mesh), Rgb(1.0f)}, point, angle, plane, angle};
}

Received from_sphere() {
  const SphereLight light{{0.2f, 1.3f, 0.1f}, 0.7f, Rgb(1.0f)};
  const Vec3 point(0.7f, -0.1f, -0.2f);
  const Vec3d towards = Vec3d(light.center) - Vec3d(point);
  const double square = glm::dot(towards, towards), sine_square = double{light.radius} * light.radius / square;
  const double angle = 2.0 * kPiD * (1.0 - std::sqrt(1.0 - sine_square));
  return {"sphere", light, point, angle, kPiD * sine_square * towards.y / std::sqrt(square), angle};
}

/// A light of one direction: `whole` falls on a plane that faces it.
Received one_direction(std::string name, Light light, const Vec3& point, double whole, const Vec3& towards) {
  return {std::move(name), std::move(light), point, whole, whole * glm::normalize(Vec3d(towards)).y, 0.0};
}

std::vector<Received> single_directions() {
  const PointLight point{{0.3f, 1.0f, 0.2f}, Rgb(1.0f)};
  const SpotLight spot{{0.0f, 1.5f, 0.0f}, kAxis, 0.95f, 0.7f, Rgb(1.0f)};
  const BeamLight beam{{-0.1f, 1.5f, -0.2f}, kAxis, 0.5f, Rgb(1.0f)};
  const Vec3 receiver(0.1f, -0.2f, -0.3f), in_rim(0.7f, 0.2f, -0.2f);
  const Vec3 to_point = point.position - receiver, to_spot = spot.position - in_rim;
  const double cosine = glm::dot(glm::normalize(Vec3d(-to_spot)), glm::normalize(Vec3d(kAxis)));
  const double x = (cosine - spot.cos_outer) / (double{spot.cos_inner} - spot.cos_outer);
  const double part = x * x * (3.0 - 2.0 * x);
  return {one_direction("point", point, receiver, 1.0 / glm::dot(to_point, to_point), to_point),
          one_direction("spot, in its rim", spot, in_rim, part / glm::dot(to_spot, to_spot), to_spot),
          one_direction("beam", beam, beam.position + 2.0f * kAxis, 1.0 / (kPiD * 0.25), -kAxis),
          one_direction("directional", DirectionalLight{kAxis, Rgb(1.0f)}, receiver, 1.0, -kAxis)};
}

/// In the green channel. Over a row of texels the irradiance of a plane that faces up is the radiance times the
/// azimuth's share times the difference of sin^2/2.
Received from_map() {
  const TexelMap map = test_map();
  Received all{"environment map", map.light(), Vec3(0.0f), 0.0, 0.0, 4.0 * kPiD};
  for (size_t i = 0; i < map.texels.size(); ++i) {
    const size_t row = i / TexelMap::kWidth;
    all.whole += map.texels[i].g * TexelMap::solid_angle(i);
    const double a = std::sin(TexelMap::fall(row)), b = std::sin(TexelMap::fall(row + 1));
    if (row < TexelMap::kHeight / 2)
      all.plane += map.texels[i].g * 2.0 * kPiD / TexelMap::kWidth * 0.5 * (b * b - a * a);
  }
  return all;
}

std::vector<Check> check_received(const Received& from, const Effort& effort) {
  const auto samples = sample_moments(3, effort.count(50'000, 10'000'000), effort.seed_of("received from " + from.name),
                                      [&](Rng& rng, double* out) {
                                        const std::optional<Incident> in = sample_towards(from.light, from.point, rng);
                                        if (!in) return;
                                        out[0] = in->irradiance.g;
                                        out[1] = in->irradiance.g * std::max(0.0f, glm::dot(in->direction, kNormal));
                                        out[2] = in->pdf > 0.0f ? 1.0 / in->pdf : 0.0;
                                      });
  if (from.angle == 0.0)
    return {check_bound(from.name + ", facing it", samples[0].mean(), from.whole, 1e-5 * from.whole),
            check_bound(from.name + ", plane", samples[1].mean(), from.plane, 1e-5 * from.whole)};
  const auto check = [](std::string name, const Moments& m, double exact) {
    // Nothing but rounding varies where sampling is perfect.
    return m.variance() < 1e-10 * exact * exact ? check_bound(std::move(name), m.mean(), exact, 1e-5 * exact)
                                                : check_mean(std::move(name), m, exact);
  };
  return {check(from.name + ", from all directions", samples[0], from.whole),
          check(from.name + ", plane", samples[1], from.plane),
          check(from.name + ", solid angle", samples[2], from.angle)};
}

}  // namespace

std::vector<Experiment> irradiance_experiments() {
  return {{0, "light received", [](const Effort& effort) {
             std::vector<Received> all = single_directions();
             all.push_back(from_quad());
             all.push_back(from_disc());
             all.push_back(from_sphere());
             all.push_back(from_mesh());
             all.push_back(
                 {"constant environment", ConstantEnvironment{Rgb(1.0f)}, Vec3(0.0f), 4.0 * kPiD, kPiD, 4.0 * kPiD});
             all.push_back(from_map());
             std::vector<Check> checks;
             for (const Received& from : all) append(checks, check_received(from, effort));
             return checks;
           }}};
}

}  // namespace vpm
