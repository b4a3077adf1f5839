// How the cost of a photon grows with their number, and what a second thread gives.
#include <fmt/format.h>

#include "benchmarks/bench.h"
#include "benchmarks/cloud.h"
#include "benchmarks/photons.h"
#include "vpm/base/parallel.h"
#include "vpm/photon/map/nearest_map.h"
#include "vpm/photon/map/radius_map.h"
#include "vpm/photon/records.h"

namespace vpm::bench {
namespace {

/// The cloud in vacuum with a light inside, where every photon collides soon.
Scene cloud_scene() {
  Scene scene;
  scene.media.push_back(cloud_medium());
  scene.world_medium = 0;
  scene.lights.push_back(PointLight{0.5f * Vec3(cloud().count - 1), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// `work` on one thread and on two; what it returns does not depend on that.
void compare_threads(Bench& bench, const std::string& title, const std::string& item, size_t items,
                     const std::function<double()>& work) {
  const auto on_threads = [&](int threads) {
    return [&work, threads] {
      set_threads(threads);
      return work();
    };
  };
  bench.compare({fmt::format("{} {:.0e}", title, static_cast<double>(items)),
                 item,
                 static_cast<double>(items),
                 0.0,
                 Clock::wall,
                 {{"vpm, 2 threads", on_threads(2)}, {"vpm, 1 thread", on_threads(1)}}});
}

/// Sums up parts in the order of the queries, whatever thread made them.
template <class Query>
double sum_over(const std::vector<Vec3>& queries, Query&& query) {
  constexpr size_t kChunk = 1024;
  std::vector<double> parts(chunk_count(queries.size(), kChunk));
  parallel_for_chunks(queries.size(), kChunk, [&](size_t begin, size_t end, size_t chunk) {
    for (size_t i = begin; i < end; ++i) parts[chunk] += query(queries[i]);
  });
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

void measure_size(Bench& bench, const Scene& scene, size_t count) {
  const auto strategy = make_distance_strategy({});
  compare_threads(bench, "Tracing photons into a cloud, stored:", "photon", count, [&] {
    ListSettings settings;
    settings.stored = count;
    return static_cast<double>(list_photons(scene, *strategy, settings).volume[0].size());
  });

  const std::vector<Photon> photons = random_photons(count);
  const float radius = neighbour_radius(count);
  const auto build = [&] { return RadiusMap(photons, radius, 1.0f); };
  compare_threads(bench, "Building a RadiusMap, photons:", "photon", count,
                  [&] { return static_cast<double>(build().size()); });
  const RadiusMap map = build();
  bench.note("memory of a RadiusMap", static_cast<double>(map.memory_bytes()) / static_cast<double>(count),
             "bytes/photon");
  compare_threads(bench, "Building a NearestMap, photons:", "photon", count,
                  [&] { return static_cast<double>(NearestMap(photons, 1.0f).size()); });

  const std::vector<Vec3> queries = morton_sorted(random_queries(50'000));
  compare_threads(bench, fmt::format("Queries of {:.0e} photons, sorted:", static_cast<double>(count)), "query",
                  queries.size(), [&] {
                    return sum_over(queries, [&](const Vec3& q) {
                      double sum = 0.0;
                      map.visit_near(q, radius, [&](const NearPhotons& near) {
                        for (size_t i = 0; i < near.size(); ++i) sum += near.distances2()[i];
                      });
                      return sum;
                    });
                  });
}

}  // namespace

void measure_scaling(Bench& bench, const Sizes& sizes) {
  const Scene scene = cloud_scene();
  for (size_t count = 10'000; count <= sizes.photons; count *= 10) measure_size(bench, scene, count);
}

}  // namespace vpm::bench
