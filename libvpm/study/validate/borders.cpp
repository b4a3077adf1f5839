// Density estimates at borders, corrected: even photons have the exact density for their mean up to the edges and
// corners of what they lie on or in, and none behind a wall.
//
// In a cube and on a square of side 2 m, at their corners and beside their edges, and beside sheets in the middle. The
// shares of their kernels are found by fixed rays; kShareError bounds what these leave.
#include <fmt/format.h>
#include <atomic>
#include <functional>

#include "estimate/surface_region.h"
#include "estimate/volume_estimate.h"
#include "estimate/volume_region.h"
#include "medium/make_grid.h"
#include "scene/build.h"
#include "study/sample_moments.h"
#include "study/validate/groups.h"

namespace vpm {

namespace {

constexpr uint64_t kPhotons = 200;     // of a total of 1 W
constexpr double kShareError = 0.005;  // of the estimate
const Vec3 kUp(0.0f, 0.0f, 1.0f);

/// Where photons are: everywhere evenly; where x > 0 alone; or three times as dense beyond the sheets as between them.
enum class Lit { evenly, half, beyond };

struct Place {
  const char* name;
  Vec3 point;
  int sheets = 0;  // stand at x = 0, 0.4 m
  Lit lit = Lit::evenly;
};
constexpr float kClose = 1e-5f;  // m, off a border
constexpr float kSheet = 0.4f;   // m, where the second sheet stands
using Places = std::vector<Place>;

Places with_sheets(Places places) {
  places.push_back({"between sheets, more light beyond", Vec3(0.2f, 0.1f, 0.0f), 2, Lit::beyond});
  places.push_back({"before a sheet", Vec3(0.02f, 0.1f, 0.0f), 1, Lit::half});
  places.push_back({"behind a sheet", Vec3(-0.02f, 0.1f, 0.0f), 1, Lit::half});
  return places;
}

Places places_in_cube() {
  return with_sheets({{"in the middle", Vec3(0.1f, -0.05f, 0.0f)},
                      {"at a face", Vec3(1.0f - kClose, 0.1f, 0.0f)},
                      {"near a face", Vec3(0.9f, 0.1f, 0.0f)},
                      {"at an edge", Vec3(1.0f - kClose, kClose - 1.0f, 0.0f)},
                      {"at a corner", Vec3(1.0f - kClose)}});
}
Places places_on_square() {
  return with_sheets({{"in the middle", Vec3(0.1f, -0.05f, 0.0f)},
                      {"at an edge", Vec3(1.0f - kClose, 0.1f, 0.0f)},
                      {"near an edge", Vec3(0.9f, 0.1f, 0.0f)},
                      {"at a corner", Vec3(1.0f - kClose, kClose - 1.0f, 0.0f)},
                      {"near a corner", Vec3(0.9f, 0.8f, 0.0f)}});
}

Scene make_scene(bool flat, const Place& place) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1.0f), 1.0f));
  const Interface media{0, kVacuum};
  if (flat)
    add_shape(scene, quad_mesh(Vec3d(-1, -1, 0), Vec3d(2, 0, 0), Vec3d(0, 2, 0)), Lambertian{});
  else
    add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  for (int i = 0; i < place.sheets; ++i)
    add_shape(scene, quad_mesh(Vec3d(double{kSheet} * i, -2, -2), Vec3d(0, 4, 0), Vec3d(0, 0, 4)), Lambertian{});
  scene.lights.push_back(PointLight{Vec3(0.0f, 0.0f, 3.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

std::vector<Photon> even_photons(bool flat, const Place& place, Rng& rng) {
  std::vector<Photon> photons(kPhotons);
  for (Photon& p : photons) {
    p = {2.0f * Vec3(rng.uniform(), rng.uniform(), flat ? 0.5f : rng.uniform()) - 1.0f, PackedDirection(-kUp),
         Rgb(1.0f)};
    if (place.lit == Lit::half) p.position.x = std::abs(p.position.x);
    if (place.lit == Lit::beyond && rng.uniform() < 0.5f)
      while (p.position.x > 0.0f && p.position.x < kSheet) p.position.x = 2.0f * rng.uniform() - 1.0f;
  }
  return photons;
}

/// The density of photons at the place that can come there, over 1/m^2 or 1/m^3 of them spread evenly.
double density_at(const Place& place) {
  switch (place.lit) {
    case Lit::evenly:
      return 1.0;
    case Lit::half:
      return place.point.x > 0.0f ? 2.0 : 0.0;
    case Lit::beyond:
      break;
  }
  return 0.5;
}

/// Fluence over sigma_t = 1/m in the volume, irradiance on the plane; each may count what it corrects.
using Estimator = std::function<double(const PhotonMap&, GatherCounters&)>;
Estimator estimator(bool flat, const Scene& scene, const Vec3& point, const GatherSettings& settings) {
  if (!flat)
    return [&scene, point, settings](const PhotonMap& map, GatherCounters& counters) {
      const VolumeRegion region(scene, 0, point, settings.kernel);
      return fluence(Rgb(1.0f), point, BoundedMap{map, region, counters}).g;
    };
  const Hit hit = scene.geometry.intersect({point + 0.01f * kUp, -kUp}).value();
  return [&scene, hit, settings](const PhotonMap& map, GatherCounters& counters) {
    const SurfaceRegion region(scene, hit, kUp, settings);
    return surface_irradiance(hit.position, kUp, BoundedMap{map, region, counters}).g;
  };
}

std::vector<Check> check_place(bool flat, const Place& place, GatherMode mode, const Effort& effort) {
  const Scene scene = make_scene(flat, place);
  const double exact = density_at(place) * (flat ? 1.0 / 4.0 : 1.0 / 8.0);
  const bool nearest = mode == GatherMode::nearest;
  const GatherSettings settings{mode, nearest ? 1.9f : 0.5f, 12,
                                nearest ? KernelKind::constant : KernelKind::epanechnikov};
  const std::string name = fmt::format("{}, {}, {}", place.name, flat ? "on a square" : "in a cube",
                                       nearest ? "12 nearest" : "fixed radius");
  const Estimator estimate = estimator(flat, scene, place.point, settings);
  std::atomic<uint64_t> too_small{0};
  const auto samples = sample_moments(1, effort.count(1'200, 15'000), effort.seed_of(name), [&](Rng& rng, double* out) {
    GatherCounters counters;
    out[0] = estimate(make_photon_map(even_photons(flat, place, rng), settings, kPhotons), counters);
    too_small += counters.least_shares;
  });
  std::vector<Check> checks{exact == 0.0 ? check_bound(name, samples[0].mean(), 0.0, 0.0)
                                         : check_mean(name, samples[0], exact, kShareError * exact)};
  if (too_small > 0) checks.push_back(check_bound(name + ", least shares", static_cast<double>(too_small), 0.0, 0.0));
  return checks;
}

std::vector<Check> check_borders(bool flat, const Effort& effort) {
  std::vector<Check> checks;
  for (const Place& place : flat ? places_on_square() : places_in_cube())
    for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
      append(checks, check_place(flat, place, mode, effort));
  return checks;
}

}  // namespace

std::vector<Experiment> border_experiments() {
  return {{0, "even photons at borders, estimates corrected", [](const Effort& effort) {
             std::vector<Check> checks = check_borders(false, effort);
             append(checks, check_borders(true, effort));
             return checks;
           }}};
}

}  // namespace vpm
