// Photons for tests: on which maps are compared with their brute-force twins, traced into recorders of a test's own,
// and hits that no ray has made.
#pragma once

#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/photon/photon.h"
#include "vpm/photon/trace.h"
#include "vpm/surface/geometry.h"

namespace vpm {

/// How photons lie: evenly, in a plane, most in a small part, most in one point, on a line; about one point, as in a
/// medium without end: a half of them beyond 1 m, a tenth beyond 5 m, one of thousands kilometres away.
enum class Layout { spread, flat, clustered, coinciding, line, endless };

inline std::vector<Photon> photons(Layout layout, size_t count) {
  std::vector<Photon> result(count);
  for (size_t i = 0; i < count; ++i) {
    Rng rng(4, rng_stream(RngUse::test, static_cast<uint64_t>(layout)), i);
    Vec3 p(rng.uniform(), rng.uniform(), rng.uniform());
    if (layout == Layout::flat) p.y = 0.25f;
    if (layout == Layout::clustered) p = (i & 7) ? 1e-3f * p + 0.4f : 100.0f * p;
    if (layout == Layout::coinciding && i % 2) p = Vec3(0.5f);
    if (layout == Layout::endless) p = 0.5f * p.x / (1.0f - p.x) * uniform_sphere(Vec2(p.y, p.z)) + 0.5f;
    if (layout == Layout::line) p = Vec3(p.x * 50.0f, 1.0f, 2.0f);
    result[i] = {p, PackedDirection(uniform_sphere(rng.uniform2())), Rgb(rng.uniform(), rng.uniform(), rng.uniform())};
    // Photons at one distance must be alike, or a k-nearest answer would depend on which of them it takes.
    if (p == Vec3(0.5f)) result[i] = {p, PackedDirection(Vec3(0.6f, -0.8f, 0.0f)), Rgb(0.5f)};
  }
  return result;
}

inline constexpr Layout kLayouts[] = {Layout::spread,     Layout::flat, Layout::clustered,
                                      Layout::coinciding, Layout::line, Layout::endless};

/// By the default strategy, without showing progress.
inline Ledger trace_into(const Scene& scene, const TraceSettings& settings, const Recorders& recorders) {
  Progress silent("photons", 0, false);
  return trace_photons(scene, *make_distance_strategy({}), settings, recorders, silent);
}

inline Hit hit_at(const Vec3& position, const Vec3& normal, const Vec3& shading_normal) {
  Hit hit;
  hit.position = position;
  hit.normal = normal;
  hit.shading_normal = shading_normal;
  return hit;
}
inline Hit hit_at(const Vec3& position, const Vec3& normal) { return hit_at(position, normal, normal); }

}  // namespace vpm
