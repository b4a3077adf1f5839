// Computing the points, and finding the nearest.
#include "vpm/integrators/photon_map/surface/irradiance_cache.h"

#include "vpm/base/parallel.h"
#include "vpm/estimate/surface_estimate.h"

namespace vpm {
namespace {

constexpr size_t kCachePointChunk = 256;  // points computed one after another

Photon point_at(const CachePoint& point, const CountedMap& map) {
  Hit hit;
  hit.position = point.position;
  hit.normal = point.normal.unpack();
  hit.shading_normal = point.shading_normal.unpack();
  return {point.position, PackedDirection(-hit.shading_normal), shaded_irradiance(hit, hit.normal, map).value};
}

}  // namespace

IrradianceCache::IrradianceCache(const std::vector<CachePoint>& cache_points, const PhotonMap& map,
                                 GatherCounters& counters)
    : gather_{.mode = GatherMode::nearest, .radius = map.settings.radius, .count = 1},
      thickness_(plane_thickness(map.settings)) {
  std::vector<Photon> points(cache_points.size());
  std::vector<GatherCounters> counted(chunk_count(cache_points.size(), kCachePointChunk));
  parallel_for_chunks(cache_points.size(), kCachePointChunk, [&](size_t begin, size_t end, size_t chunk) {
    Neighbours neighbours;
    const CountedMap here{map, {counted[chunk], neighbours}};
    for (size_t i = begin; i < end; ++i) points[i] = point_at(cache_points[i], here);
  });
  for (const GatherCounters& of_chunk : counted) counters.merge(of_chunk);
  points_ = NearestMap(points, 1.0f);
}

std::optional<Rgb> IrradianceCache::irradiance(const Hit& hit, const Vec3& towards_eye, GatherWork work) const {
  const float geometric = glm::dot(hit.normal, towards_eye), shading = glm::dot(hit.shading_normal, towards_eye);
  if (!(geometric * shading > 0.0f)) return std::nullopt;
  const float side = geometric > 0.0f ? 1.0f : -1.0f;
  const Vec3 normal = side * hit.shading_normal;
  const Arrives in_plane{side * hit.normal, thickness_, true};
  const auto agrees = [&](const PackedDirection& travel, const Vec3& offset) {
    return -glm::dot(travel.unpack(), normal) > kSameNormal && in_plane(travel, offset);
  };
  const Neighbours& near = nearest(Gathering{points_, gather_, work}, hit.position, agrees);
  if (near.size() == 0) return std::nullopt;
  ++work.counters.used;
  return points_.photons().payload(near.photons()[0]).power.unpack();
}

}  // namespace vpm
