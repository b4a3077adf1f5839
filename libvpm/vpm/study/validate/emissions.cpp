// Light sources: where their photons start, which way they fly and what they carry, against each light's definition.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "vpm/light/light.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/directions.h"
#include "vpm/study/validate/scenes/lights.h"

namespace vpm {

namespace {

/// A light, its power by definition, and the cells of emission with the share of power that falls in each.
struct EmissionLaw {
  std::string name;
  Light light;
  Rgbd power{0.0};  // W
  std::function<size_t(const Ray&)> cell;
  std::vector<std::array<double, 3>> shares;  // by cell and channel
};

std::vector<std::array<double, 3>> equal_cells(size_t count) {
  const double share = 1.0 / static_cast<double>(count);
  return std::vector<std::array<double, 3>>(count, {share, share, share});
}

constexpr size_t kRings = 6;  // of equal probability

/// Rings of the disc of `radius` about the axis through `center` along `axis`, and sectors.
size_t disc_cell(const Ray& ray, const Vec3& center, const Vec3& axis, double radius) {
  const Vec3d across = Vec3d(ray.origin - center) - glm::dot(Vec3d(ray.origin - center), Vec3d(axis)) * Vec3d(axis);
  const Vec3 direction(glm::normalize(across));
  return cell_of(glm::dot(across, across) / (radius * radius), kRings) * kSectors + sector_about(axis, direction);
}

/// Rings of equal flux under the cosine law about the unit normal, and sectors.
size_t cosine_law_cell(const Vec3& normal, const Vec3& direction) {
  const double cosine = 1.0 - away_from(normal, direction);
  return cell_of(cosine * cosine, kRings) * kSectors + sector_about(normal, direction);
}

EmissionLaw point_law() {
  const PointLight light{{0.3f, 1.0f, 0.2f}, kColour};
  return {"point", light, 4.0 * kPiD * Rgbd(kColour),
          [](const Ray& ray) {
            return cell_of(0.5 * away_from(kAxis, ray.direction), kRings) * kSectors +
                   sector_about(kAxis, ray.direction);
          },
          equal_cells(kRings * kSectors)};
}

/// Without a rim where `cos_outer` is the inner cosine, too: photons outside its cone then make the last ring too full.
EmissionLaw spot_law(const std::string& name, float cos_outer) {
  const SpotLight light{{0.0f, 1.5f, 0.0f}, kAxis, 0.95f, cos_outer, kColour};
  const double inner = 1.0 - double{light.cos_inner}, rim = double{light.cos_inner} - light.cos_outer;
  // Over the rim the intensity is 3 x^2 - 2 x^3 in x, the part of the way from the outer cosine to the inner one.
  const auto integral = [](double x) { return x * x * x - 0.5 * x * x * x * x; };
  std::vector<std::array<double, 3>> shares;
  const double all = inner + 0.5 * rim;
  for (size_t ring = 0; ring < kRings; ++ring) {
    const double share = inner / all / (kRings * kSectors);
    shares.insert(shares.end(), kSectors, {share, share, share});
  }
  for (size_t ring = 0; ring < kRings; ++ring) {
    const double x = 1.0 - static_cast<double>(ring) / kRings, next = x - 1.0 / kRings;
    const double share = rim * (integral(x) - integral(next)) / all / kSectors;
    shares.insert(shares.end(), kSectors, {share, share, share});
  }
  return {name, light, 2.0 * kPiD * all * Rgbd(kColour),
          [=](const Ray& ray) {
            const double away = away_from(kAxis, ray.direction);
            const size_t ring = away < inner || rim == 0.0 ? cell_of(away / inner, kRings)
                                                           : kRings + cell_of((away - inner) / rim, kRings);
            return ring * kSectors + sector_about(kAxis, ray.direction);
          },
          shares};
}

EmissionLaw beam_law() {
  const BeamLight light{{-0.1f, 1.5f, -0.2f}, kAxis, 0.8f, kColour};
  return {"beam", light, Rgbd(kColour),
          [=](const Ray& ray) {
            // Photons that do not fly along the axis make the first cell too full.
            if (glm::distance(ray.direction, kAxis) > 1e-6f) return size_t{0};
            return disc_cell(ray, light.position, kAxis, light.radius);
          },
          equal_cells(kRings * kSectors)};
}

EmissionLaw quad_law() {
  const QuadLight light = test_quad();
  const Vec3d u(light.edge_u), v(light.edge_v), across = glm::cross(u, v);
  constexpr size_t kAlong = 3;
  return {"quad", light, kPiD * glm::length(across) * Rgbd(kColour),
          [=](const Ray& ray) {
            const Vec3d from_corner = Vec3d(ray.origin) - Vec3d(light.corner);
            const double square = glm::dot(across, across);
            const double a = glm::dot(glm::cross(from_corner, v), across) / square;
            const double b = glm::dot(glm::cross(u, from_corner), across) / square;
            const size_t place = cell_of(a, kAlong) * kAlong + cell_of(b, kAlong);
            return place * kRings * kSectors + cosine_law_cell(Vec3(glm::normalize(across)), ray.direction);
          },
          equal_cells(kAlong * kAlong * kRings * kSectors)};
}

EmissionLaw sphere_law() {
  const SphereLight light = test_sphere();
  constexpr size_t kZones = 4;
  return {"sphere", light, 4.0 * kPiD * kPiD * light.radius * light.radius * Rgbd(kColour),
          [=](const Ray& ray) {
            const Vec3 normal = glm::normalize(ray.origin - light.center);
            return cell_of(0.5 * away_from(kAxis, normal), kZones) * kRings * kSectors +
                   cosine_law_cell(normal, ray.direction);
          },
          equal_cells(kZones * kRings * kSectors)};
}

EmissionLaw disc_law() {
  const DiscLight light = test_disc();
  return {"disc", light, kPiD * kPiD * light.radius * light.radius * Rgbd(kColour),
          [=](const Ray& ray) {
            const size_t place = disc_cell(ray, light.center, light.normal, light.radius) / 2;  // sectors in pairs
            return place * kRings * kSectors + cosine_law_cell(light.normal, ray.direction);
          },
          equal_cells(kRings * kSectors / 2 * kRings * kSectors)};
}

/// A tetrahedron: the four volumes that a point of a face spans with three of the vertices, over the whole, are its
/// barycentric coordinates; that of the vertex across from the face is 0.
EmissionLaw mesh_law() {
  const TriangleMesh mesh = test_tetrahedron();
  std::array<Vec3d, 4> p, across;
  for (size_t i = 0; i < 4; ++i) p[i] = Vec3d(mesh.positions[i]);
  double area = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    const auto& v = mesh.triangles[i];
    across[i] = glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]);
    area += 0.5 * glm::length(across[i]);
  }
  constexpr size_t kAlong = 2, kPlaces = kAlong * kAlong;
  std::vector<std::array<double, 3>> shares;
  for (size_t i = 0; i < 4; ++i) {
    const double share = 0.5 * glm::length(across[i]) / area / (kPlaces * kRings * kSectors);
    shares.insert(shares.end(), kPlaces * kRings * kSectors, {share, share, share});
  }
  return {"mesh", MeshLight{std::make_shared<EmittingMesh>(mesh), kColour}, kPiD * area * Rgbd(kColour),
          [=](const Ray& ray) {
            std::array<double, 4> part;
            for (size_t i = 0; i < 4; ++i)  // the distance to the plane of a face over that of the vertex across
              part[i] =
                  glm::dot(Vec3d(ray.origin) - p[(i + 1) % 4], across[i]) / glm::dot(p[i] - p[(i + 1) % 4], across[i]);
            const auto face = static_cast<size_t>(std::min_element(part.begin(), part.end()) - part.begin());
            const size_t a = (face + 1) % 4, b = (face + 2) % 4;
            const double away = 1.0 - part[a], along = part[b] / away;  // area grows with the square of `away`
            const size_t place = (face * kAlong + cell_of(away * away, kAlong)) * kAlong + cell_of(along, kAlong);
            return place * kRings * kSectors + cosine_law_cell(Vec3(glm::normalize(across[face])), ray.direction);
          },
          shares};
}

/// The areas of the lit box's faces across the axes, m^2.
Vec3d lit_faces() {
  const Vec3d e(kLitBox.extent());
  return {e.y * e.z, e.z * e.x, e.x * e.y};
}

/// Where a ray that comes from far away enters the lit box: the axis and the place on the face.
struct Entry {
  size_t axis = 0;
  Vec2 place{0.0f};  // in [0, 1]^2
};
Entry entry_of(const Ray& ray) {
  Vec3d enters;
  for (int i = 0; i < 3; ++i)
    enters[i] = (double{ray.direction[i] > 0.0f ? kLitBox.lo[i] : kLitBox.hi[i]} - ray.origin[i]) / ray.direction[i];
  const int axis = enters.x > enters.y ? (enters.x > enters.z ? 0 : 2) : enters.y > enters.z ? 1 : 2;
  const Vec3d share =
      (Vec3d(ray.origin) + enters[axis] * Vec3d(ray.direction) - Vec3d(kLitBox.lo)) / Vec3d(kLitBox.extent());
  return {static_cast<size_t>(axis), Vec2(share[(axis + 1) % 3], share[(axis + 2) % 3])};
}

EmissionLaw directional_law() {
  constexpr size_t kAlong = 4;
  const Vec3d shown = glm::abs(Vec3d(kAxis)) * lit_faces();
  const double area = shown.x + shown.y + shown.z;
  std::vector<std::array<double, 3>> shares;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = shown[axis] / area / (kAlong * kAlong);
    shares.insert(shares.end(), kAlong * kAlong, {share, share, share});
  }
  return {"directional", DirectionalLight{kAxis, kColour}, area * Rgbd(kColour),
          [=](const Ray& ray) {
            const Entry entry = entry_of(ray);
            return (entry.axis * kAlong + cell_of(entry.place.x, kAlong)) * kAlong + cell_of(entry.place.y, kAlong);
          },
          shares};
}

EmissionLaw constant_law() {
  const Vec3d faces = lit_faces();
  const double area = 2.0 * (faces.x + faces.y + faces.z);
  constexpr size_t kHalves = 2;
  std::vector<std::array<double, 3>> shares;
  for (int face = 0; face < 6; ++face) {
    const double share = faces[face / 2] / area / (kHalves * kHalves * kRings * kSectors);
    shares.insert(shares.end(), kHalves * kHalves * kRings * kSectors, {share, share, share});
  }
  return {"constant environment", ConstantEnvironment{kColour}, kPiD * area * Rgbd(kColour),
          [=](const Ray& ray) {
            const Entry entry = entry_of(ray);
            const auto axis = static_cast<int>(entry.axis);
            const bool upwards = ray.direction[axis] > 0.0f;
            Vec3 inward(0.0f);
            inward[axis] = upwards ? 1.0f : -1.0f;
            const size_t place = cell_of(entry.place.x, kHalves) * kHalves + cell_of(entry.place.y, kHalves);
            return ((2 * entry.axis + (upwards ? 1 : 0)) * kHalves * kHalves + place) * kRings * kSectors +
                   cosine_law_cell(inward, ray.direction);
          },
          shares};
}

/// The area that the lit box shows to a direction, integrated over the directions of a texel, m^2 sr.
double lit_area(size_t texel) {
  constexpr int kSteps = 200;
  const double top = TexelMap::fall(texel / TexelMap::kWidth), fall = kPiD / (TexelMap::kHeight * kSteps);
  const double begin = kPiD - 2.0 * kPiD * static_cast<double>(texel % TexelMap::kWidth) / TexelMap::kWidth;
  const double turn = 2.0 * kPiD / (TexelMap::kWidth * kSteps);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const double angle = top + (i + 0.5) * fall, azimuth = begin - (k + 0.5) * turn;
      const Vec3d d(std::sin(angle) * std::sin(azimuth), std::cos(angle), std::sin(angle) * std::cos(azimuth));
      sum += glm::dot(glm::abs(d), lit_faces()) * std::sin(angle) * fall * turn;
    }
  return sum;
}

EmissionLaw map_law() {
  const TexelMap map = test_map();
  Rgbd total(0.0);
  for (size_t i = 0; i < map.texels.size(); ++i) total += lit_area(i) * Rgbd(map.texels[i]);
  std::vector<std::array<double, 3>> shares;
  for (size_t i = 0; i < map.texels.size(); ++i) {
    const Rgbd share = lit_area(i) * Rgbd(map.texels[i]) / total;
    shares.push_back({share.r, share.g, share.b});
  }
  return {"environment map", map.light(), total, [map](const Ray& ray) { return map.texel_at(-ray.direction); },
          shares};
}

std::vector<Check> check_emission(const EmissionLaw& law, const Effort& effort) {
  const Rgbd stated(light_power(law.light, kLitBox));
  const double power = law.power.r + law.power.g + law.power.b;
  const bool chromatic = law.shares[0][0] != law.shares[0][1];
  const size_t channels = chromatic ? 3 : 1, cells = law.shares.size();
  const auto samples =
      sample_moments(3 * cells, effort.count(100'000, 1'500'000), effort.seed_of(law.name), [&](Rng& rng, double* out) {
        const Emission emission = emit(law.light, kLitBox, rng);
        const size_t cell = law.cell(emission.ray);
        for (size_t c = 0; c < channels; ++c) {
          const auto channel = static_cast<int>(c);
          out[c * cells + cell] = emission.power[channel] / law.power[channel];
        }
      });
  std::vector<Check> checks;
  for (size_t c = 0; c < channels; ++c) {
    std::vector<double> shares;
    for (const auto& share : law.shares) shares.push_back(share[c]);
    const auto first = samples.begin() + static_cast<ptrdiff_t>(c * cells);
    checks.push_back(check_weights(law.name + ", photons' power" + (chromatic ? kOfChannel[c] : ""),
                                   {first, first + static_cast<ptrdiff_t>(cells)}, shares));
  }
  checks.push_back(
      check_bound(law.name + ", power of all channels", stated.r + stated.g + stated.b, power, 1e-5 * power));
  return checks;
}

}  // namespace

std::vector<Experiment> emission_experiments() {
  return {{0, "light emitted", [](const Effort& effort) {
             std::vector<Check> checks;
             for (const EmissionLaw& law :
                  {point_law(), spot_law("spot", 0.7f), spot_law("spot without a rim", 0.95f), beam_law(), quad_law(),
                   disc_law(), sphere_law(), mesh_law(), directional_law(), constant_law(), map_law()})
               append(checks, check_emission(law, effort));
             return checks;
           }}};
}

}  // namespace vpm
