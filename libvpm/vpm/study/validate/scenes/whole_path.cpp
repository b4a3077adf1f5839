// Random paths, and products of densities over all of their vertices.
#include "vpm/study/validate/scenes/whole_path.h"

#include "vpm/base/warp.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

Vec3 random_point(Rng& rng) { return Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * 3.0f; }
Rgb random_colour(Rng& rng, float lo, float hi) {
  return Rgb(lo) + (hi - lo) * Rgb(rng.uniform(), rng.uniform(), rng.uniform());
}

double mean_of(const Rgb& c) { return (double{c.r} + c.g + c.b) / 3.0; }

/// What the density of a direction is times for that of vertex `at`, over the leg between points i and i + 1.
double spread(const WholePath& path, size_t at, size_t i) {
  const Junction& junction = path.vertices[at];
  const Rgb& t = path.transmittances[i];
  const double per_square = 1.0 / path.square(i);
  if (junction.kind == Junction::Kind::surface)
    return std::abs(double{glm::dot(junction.normal, path.direction(i))}) * mean_of(t) * per_square;
  if (junction.kind == Junction::Kind::medium) return mean_of(junction.sigma_t * t) * per_square;
  return mean_of(t) * per_square;
}

bool is_free(const WholePath& path, size_t i) { return path.vertices[i].kind == Junction::Kind::free; }

}  // namespace

WholePath random_path(Rng& rng, int events) {
  WholePath path;
  const float size = std::pow(10.0f, 8.0f * rng.uniform() - 4.0f);  // from a tenth of a millimetre to ten kilometres
  for (int i = 0; i < events + 2; ++i) path.points.push_back(size * random_point(rng));
  for (int i = 0; i <= events; ++i) path.transmittances.push_back(random_colour(rng, 0.01f, 1.0f));
  const size_t n = path.points.size();
  path.vertices.resize(n);
  path.phases.resize(n);
  path.refractions.resize(n, 1.0);
  const Vec3 out = path.direction(0);
  const Vec3 normal = glm::normalize(out + 0.8f * uniform_sphere(rng.uniform2()));
  if (rng.uniform() < 0.3f) {
    path.light = PointLight{path.points[0], Rgb(1.0f)};
  } else {
    const float radius = 0.2f + rng.uniform();
    path.light = DiscLight{path.points[0], normal, radius, Rgb(1.0f)};
    path.vertices[0].set_junction({Junction::Kind::surface, normal});
  }
  path.vertices[0].starts = true;
  for (size_t i = 1; i + 1 < n; ++i) {
    PathVertex& vertex = path.vertices[i];
    const Vec3 in = path.direction(i - 1), on = path.direction(i);
    vertex.point = path.points[i];
    vertex.travel = in;
    const float kind = rng.uniform();
    if (kind < 0.2f) {
      vertex.on_surface = vertex.specular = true;
      path.refractions[i] = rng.uniform() < 0.5f ? 1.0 : 1.5 * 1.5;
    } else if (kind < 0.5f) {
      vertex.on_surface = true;
      // A surface that scatters this way back, and a lobe in which both directions are.
      vertex.hit.normal = vertex.hit.shading_normal =
          glm::normalize(on - in + 0.2f * glm::length(on - in) * uniform_sphere(rng.uniform2()));
      vertex.material = Phong{Rgb(0.4f), Rgb(0.5f), 4.0f};
      vertex.set_junction({Junction::Kind::surface, vertex.hit.normal});
    } else {
      vertex.density = 1.0f;
      path.phases[i] = HenyeyGreenstein{rng.uniform() * 1.6f - 0.8f};
      vertex.set_junction({Junction::Kind::medium, Vec3(0.0f), random_colour(rng, 0.1f, 3.0f)});
      if (rng.uniform() < 0.5f) vertex.kept = 1.0 + 4.0 * rng.uniform_double();
    }
  }
  return path;
}

double density_on(const WholePath& path, size_t i, bool along_light) {
  const Vec3 in = along_light ? path.direction(i - 1) : -path.direction(i);
  const Vec3 on = along_light ? path.direction(i) : -path.direction(i - 1);
  const PathVertex& vertex = path.vertices[i];
  if (vertex.specular) return along_light ? 1.0 : path.refractions[i];
  if (vertex.on_surface) return scatter_value(vertex.material, vertex.hit, in, on).pdf;
  return phase_value(path.phases[i], in, on);
}

bool first_from_eye(const WholePath& path, size_t i) {
  for (size_t j = i + 1; j < path.last(); ++j)
    if (!is_free(path, j)) return false;
  return true;
}

std::vector<Found> all_densities(const WholePath& path, const TechniqueCounts& counts) {
  const size_t k = path.last();
  const auto* disc = std::get_if<DiscLight>(&path.light);
  const double place = disc ? 1.0 / (kPiD * double{disc->radius} * disc->radius) : 1.0;
  const double flight = disc ? glm::dot(disc->normal, path.direction(0)) / kPiD : 0.25 / kPiD;
  std::vector<double> f(k), r(k);
  f[0] = path.chosen * place;
  f[1] = flight * spread(path, 1, 0);
  for (size_t i = 2; i < k; ++i) f[i] = density_on(path, i - 1, true) * spread(path, i, i - 1);
  r[k - 1] = path.camera_density * spread(path, k - 1, k - 1);
  for (size_t i = k - 1; i-- > 0;) r[i] = density_on(path, i + 1, false) * spread(path, i, i);
  const auto product = [&](size_t light_end, size_t eye_begin) {  // f up to light_end, excluded, r from eye_begin on
    double p = 1.0;
    for (size_t i = 0; i < light_end; ++i) p *= f[i];
    for (size_t i = eye_begin; i < k; ++i) p *= r[i];
    return p;
  };
  using By = Found::By;
  std::vector<Found> all;
  const auto add = [&](By by, size_t at, double density) {
    if (density > 0.0) all.push_back({by, at, counts.weigh(density)});
  };
  // The eye's sub-path scatters at no vertex but specular ones, and the first that is not.
  const auto eye_reaches = [&](size_t i) { return counts.deep || first_from_eye(path, i); };
  size_t last_free = 0;
  while (last_free + 1 < k && is_free(path, last_free + 1)) ++last_free;
  const bool runs = last_free + 1 == k || eye_reaches(last_free + 1);
  if (counts.light && disc && runs) add(By::run_into, 0, product(0, 0));
  // A disc is sampled uniformly over its area.
  if (counts.light && !is_free(path, 1) && eye_reaches(1))
    add(By::sampled, 0, (counts.each_light ? 1.0 / path.chosen : 1.0) * product(1, 1));
  for (size_t i = 1; i + 1 < k; ++i)
    if (!is_free(path, i) && !is_free(path, i + 1) && eye_reaches(i + 1))
      add(By::connected, i, counts.connections * product(i + 1, i + 1));
  const bool straight_to_eye = k == 2 && path.vertices[1].kind == Junction::Kind::surface && counts.light;
  if (!is_free(path, k - 1) && !straight_to_eye) add(By::splat, k - 1, counts.splats * product(k, k));
  for (size_t i = 1; i < k; ++i) {
    const Junction& at = path.vertices[i];
    const double merged = product(i + 1, i);
    const bool first = first_from_eye(path, i);
    if (!eye_reaches(i)) continue;
    const bool along_rays = counts.points_2d + counts.short_beams > 0.0;
    const bool in_balls = counts.deep || !along_rays;
    const bool straight = i == 1 && counts.light;
    if (at.kind == Junction::Kind::surface && !straight) add(By::surface, i, counts.surfaces * merged);
    if (at.kind != Junction::Kind::medium) continue;
    const Rgb &from_light = path.transmittances[i - 1], &from_eye = path.transmittances[i];
    const double sine = glm::length(glm::cross(Vec3d(path.direction(i - 1)), Vec3d(path.direction(i))));
    const double eye = mean_of(at.sigma_t * from_eye), light = mean_of(at.sigma_t * from_light);
    if (in_balls) add(By::points_3d, i, counts.points_3d * at.kept * merged);
    if (!first) continue;
    add(By::points_2d, i, counts.points_2d * at.kept * merged / eye);
    add(By::short_beams, i, counts.short_beams * sine * merged / eye * mean_of(from_light) / light);
  }
  return all;
}

}  // namespace vpm
