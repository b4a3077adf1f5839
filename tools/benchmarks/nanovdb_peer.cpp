// NanoVDB's look-ups, and free flights by its hierarchical DDA.
#include "benchmarks/cloud.h"

#ifdef VPM_BENCH_NANOVDB
#if __has_include(<nanovdb/tools/GridBuilder.h>)  // since OpenVDB 11.1
#include <nanovdb/GridHandle.h>
#include <nanovdb/math/HDDA.h>
#include <nanovdb/math/Ray.h>
#include <nanovdb/math/SampleFromVoxels.h>
#include <nanovdb/tools/CreateNanoGrid.h>
#include <nanovdb/tools/GridBuilder.h>
namespace nanovdb_math = nanovdb::math;
using NanoBuilder = nanovdb::tools::build::Grid<float>;
#else
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/Ray.h>
#include <nanovdb/util/SampleFromVoxels.h>
namespace nanovdb_math = nanovdb;
using NanoBuilder = nanovdb::GridBuilder<float>;
#endif

namespace vpm::bench {
namespace {

using NanoHandle = nanovdb::GridHandle<>;

NanoHandle finished(NanoBuilder& builder) {
#if __has_include(<nanovdb/tools/GridBuilder.h>)
  return nanovdb::tools::createNanoGrid(builder);
#else
  return builder.getHandle();
#endif
}

/// The largest density in the cells of lower corners lo..hi.
float largest(const Vec3i& lo, const Vec3i& hi) {
  float most = 0.0f;
  for (int z = lo.z; z <= hi.z + 1; ++z)
    for (int y = lo.y; y <= hi.y + 1; ++y)
      for (int x = lo.x; x <= hi.x + 1; ++x) most = std::max(most, cloud().value({x, y, z}));
  return most;
}

/// A voxel is active where the cell above it holds anything, so that there is a leaf wherever there is density. A
/// leaf's own maximum does not bound what is interpolated towards the next one: it is replaced by one that does.
NanoHandle make_nano_grid() {
  NanoBuilder builder(0.0f);
  auto accessor = builder.getAccessor();
  const Vec3i count = cloud().count;
  for (int z = -1; z < count.z; ++z)
    for (int y = -1; y < count.y; ++y)
      for (int x = -1; x < count.x; ++x)
        if (largest({x, y, z}, {x, y, z}) > 0.0f) accessor.setValue({x, y, z}, cloud().value({x, y, z}));
  NanoHandle handle = finished(builder);
  auto& tree = handle.grid<float>()->tree();
  auto* leaf = tree.getFirstLeaf();
  for (uint32_t i = 0; i < tree.nodeCount(0); ++i, ++leaf) {
    const nanovdb::Coord at = leaf->origin();
    leaf->data()->setMax(largest({at[0], at[1], at[2]}, {at[0] + 7, at[1] + 7, at[2] + 7}));
    leaf->data()->mFlags |= 1;  // HDDA does not step into it
  }
  return handle;
}

const nanovdb::NanoGrid<float>& nano_grid() {
  static const NanoHandle made = make_nano_grid();
  return *made.grid<float>();
}

/// The end of a flight through the part of the ray inside the grid, m; that of the ray where nothing stops it.
template <class Accessor, class Sampler>
double hdda_flight(const Ray& along, float length, float sigma_t, Accessor& accessor, Sampler& sampler, Rng& rng) {
  const Vec3 &o = along.origin, &d = along.direction;
  nanovdb_math::Ray<float> ray({o.x, o.y, o.z}, {d.x, d.y, d.z}, 0.0f, length);
  if (!ray.clip(accessor.root().bbox())) return length;
  const auto voxel_at = [&](float t) { return nanovdb_math::RoundDown<nanovdb::Coord>(ray(t)); };
  double left = -std::log1p(-rng.uniform_double());
  nanovdb_math::HDDA<nanovdb_math::Ray<float>> hdda(ray, accessor.getDim(voxel_at(ray.t0()), ray));
  do {
    const float end = hdda.next();
    const nanovdb::Coord middle = voxel_at(0.5f * (hdda.time() + end));
    if (const auto* leaf = accessor.probeLeaf(middle)) {
      const float majorant = leaf->maximum();
      const double rate = sigma_t * static_cast<double>(majorant);
      double t = hdda.time();
      while (left < (end - t) * rate) {
        t += left / rate;
        left = -std::log1p(-rng.uniform_double());
        if (rng.uniform_double() * majorant < sampler(ray(static_cast<float>(t)))) return t;
      }
      left -= (end - t) * rate;
    }
    if (!hdda.step()) break;
    hdda.update(ray, accessor.getDim(hdda.voxel(), ray));
  } while (hdda.time() < hdda.maxTime());
  return length;
}

}  // namespace

SumDensities nanovdb_sampler() {
  nano_grid();
  return [](std::span<const Vec3> points) {
    const auto accessor = nano_grid().getAccessor();
    const nanovdb_math::SampleFromVoxels<decltype(nano_grid().getAccessor()), 1, true> sampler(accessor);
    double sum = 0.0;
    for (const Vec3& p : points) sum += sampler(nano_grid().worldToIndexF(nanovdb::Vec3f(p.x, p.y, p.z)));
    return sum;
  };
}

SumCombs nanovdb_along_rays() {
  nano_grid();
  return [](std::span<const Comb> combs) {
    const auto accessor = nano_grid().getAccessor();
    const nanovdb_math::SampleFromVoxels<decltype(nano_grid().getAccessor()), 1, true> sampler(accessor);
    double sum = 0.0;
    for (const auto& [ray, first, count] : combs) {
      const Vec3 &o = ray.origin, &d = ray.direction;
      const nanovdb::Vec3f origin = nano_grid().worldToIndexF(nanovdb::Vec3f(o.x, o.y, o.z));
      const nanovdb::Vec3f direction = nano_grid().worldToIndexDirF(nanovdb::Vec3f(d.x, d.y, d.z));
      for (size_t i = 0; i < count; ++i) sum += sampler(origin + direction * (first + static_cast<float>(i)));
    }
    return sum;
  };
}

SumFlights nanovdb_flights() {
  nano_grid();
  return [](const CloudRays& rays, float sigma_t) {
    const auto accessor = nano_grid().getAccessor();
    const nanovdb_math::SampleFromVoxels<decltype(nano_grid().getAccessor()), 1, true> sampler(accessor);
    double sum = 0.0;
    for (size_t i = 0; i < rays.rays.size(); ++i) {
      Rng rng(1, rng_stream(RngUse::photon, 0), i);
      sum += hdda_flight(rays.rays[i], rays.length, sigma_t, accessor, sampler, rng);
    }
    return sum;
  };
}

}  // namespace vpm::bench

#else

namespace vpm::bench {
SumDensities nanovdb_sampler() { return {}; }
SumCombs nanovdb_along_rays() { return {}; }
SumFlights nanovdb_flights() { return {}; }
}  // namespace vpm::bench

#endif
