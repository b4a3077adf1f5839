// Vertices of light sub-paths connected to the camera.
#include <algorithm>
#include <cmath>
#include <optional>

#include "vpm/estimate/combined/light_sub_paths.h"
#include "vpm/path/direct_light.h"

namespace vpm {
namespace {

bool is_on_film(const Camera& camera, const Vec2& film) {
  const float r = camera.filter.radius;
  const auto w = static_cast<float>(camera.width), h = static_cast<float>(camera.height);
  return film.x > 0.5f - r && film.y > 0.5f - r && film.x < w - 0.5f + r && film.y < h - 0.5f + r;
}

/// Calls visit(number, filter_value()) for the pixels whose filters reach a place of the film.
template <class Visit>
void for_each_pixel(const Camera& camera, const Vec2& film, Visit&& visit) {
  const float r = camera.filter.radius;
  const auto first = [&](float at) { return std::max(0, static_cast<int>(std::ceil(at - 0.5f - r))); };
  const auto last = [&](float at, int size) {
    return std::min(size - 1, static_cast<int>(std::ceil(at - 0.5f + r)) - 1);
  };
  for (int y = first(film.y); y <= last(film.y, camera.height); ++y)
    for (int x = first(film.x); x <= last(film.x, camera.width); ++x)
      visit(static_cast<uint32_t>(y * camera.width + x),
            filter_value(camera.filter, film - Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)));
}

}  // namespace

void splat(const LightTracing& tracing, const Arrival& at, const Rgb& power, Rng& rng, LightSubPaths& paths) {
  if (at.vertex.on_surface && at.sums.straight) return;
  const Scene& scene = tracing.scene;
  const Camera& camera = scene.camera;
  const Vec3 offset = camera.position - at.vertex.point;
  const float distance = glm::length(offset);
  const Vec3 direction = offset / distance;
  const std::optional<Vec2> film = camera.film_of(-direction);
  if (!film || !is_on_film(camera, *film)) return;
  const Scattered scattered = scattered_into(scene, at.vertex, direction, SubPath::light);
  if (is_black(scattered.value)) return;
  const Leaving leaving = leave(scene, at.vertex, direction);
  const ShadowRays rays{scene, tracing.transmittance, rng, paths.ledger.walk};
  const float length = glm::distance(camera.position, leaving.origin);
  const Rgb passed = visibility_of_place(rays, {leaving.origin, direction}, length, leaving.medium);
  if (is_black(passed)) return;
  const Leg leg{passed, distance};
  const Departure departure =
      depart(tracing.counts, at, {direction, scattered.forward, scattered.reverse}, SubPath::light, true);
  const SubPathSums at_camera = arrive(tracing.counts, departure, leg, {}, camera.position);
  const double film_density = camera.film_per_angle(-direction);
  const Rgb irradiance = power * scattered.value * passed * static_cast<float>(leg.per_square());
  for_each_pixel(camera, *film, [&](uint32_t pixel, double filter) {
    const double density = filter * film_density;
    const Splat splat{pixel, irradiance * static_cast<float>(density),
                      static_cast<float>(share_of_splat(tracing.counts, at_camera, density))};
    if (is_finite(splat.radiance * splat.share))
      paths.splats.push_back(splat);
    else
      ++paths.ledger.non_finite;
  });
}

}  // namespace vpm
