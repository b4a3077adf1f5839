// Density estimates at borders, corrected: even photons have the exact density for their mean up to the edges and
// corners of what they lie on or in, and none behind a wall.
//
// In a cube and on a square of side 2 m, at their corners, near their edges, and near sheets in the middle.
// Regions find the shares of their kernels by fixed rays, which is off by a bias of its own: that is compared with its
// stated bound, and taken out of the estimates, which may then have none.
#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>

#include "vpm/estimate/surface_region.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/estimate/volume_region.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

constexpr uint64_t kPhotons = 200;  // of a total of 1 W
// What regions' shares are off by at most, of the whole: as VolumeRegion and SurfaceRegion say.
constexpr double kBallError = 0.023, kDiscError = 0.02;
const Vec3 kUpwards(0.0f, 0.0f, 1.0f);

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
    p = {2.0f * Vec3(rng.uniform(), rng.uniform(), flat ? 0.5f : rng.uniform()) - 1.0f, PackedDirection(-kUpwards),
         Rgb(1.0f)};
    // Not on the sheet itself, which belongs to both of its sides.
    if (place.lit == Lit::half) p.position.x = std::max(std::abs(p.position.x), kClose);
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

/// Where photons can come from to the place: an interval of each axis around it.
struct Reach {
  Vec3d lo{-1.0}, hi{1.0};

  explicit Reach(const Place& place) {
    if (place.sheets > 0) (place.point.x > 0.0f ? lo : hi).x = 0.0;
    if (place.sheets > 1) hi.x = double{kSheet};
  }
  bool holds(const Vec3& p) const { return p.x >= lo.x && p.x <= hi.x; }
  /// From the point to the first border along that direction, m.
  double way(const Vec3d& point, const Vec3d& direction) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
      if (direction[i] != 0.0)
        least = std::min(least, ((direction[i] > 0.0 ? hi[i] : lo[i]) - point[i]) / direction[i]);
    return least;
  }
};

/// What regions say of their kernels' shares against the truth, which is a mean over directions: places see all of
/// their reach.
class Shares {
 public:
  Shares(bool flat, const Place& place, const GatherSettings& settings, const std::function<double(float)>& of_region)
      : step_(double{settings.radius} / kRadii) {
    const std::vector<double> ways = ways_out(flat, place);
    for (int i = 1; i <= kRadii; ++i) {
      const double radius = i * step_;
      double sum = 0.0;
      for (const double way : ways) {
        const double t = std::min(1.0, way / radius);
        sum += flat ? kernel_within_2d(settings.kernel, t) : kernel_within_3d(settings.kernel, t);
      }
      const double exact = sum / static_cast<double>(ways.size()), found = of_region(static_cast<float>(radius));
      error_ = std::max(error_, std::abs(found - exact));
      ratios_.push_back(found / exact);
    }
  }
  /// The region's share over the true one.
  double ratio(double radius) const {
    const double at = std::clamp(radius / step_ - 1.0, 0.0, kRadii - 1.0);
    const auto i = std::min(static_cast<size_t>(at), ratios_.size() - 2);
    return std::lerp(ratios_[i], ratios_[i + 1], at - static_cast<double>(i));
  }
  double largest_error() const { return error_; }

 private:
  static constexpr int kRadii = 64;
  static std::vector<double> ways_out(bool flat, const Place& place) {
    constexpr int kTurns = 512, kHeights = 256;
    const Reach reach(place);
    const Vec3d point(place.point);
    std::vector<double> ways;
    for (int j = 0; j < (flat ? 1 : kHeights); ++j)
      for (int i = 0; i < kTurns; ++i) {
        const double phi = 2.0 * kPiD * (i + 0.5) / kTurns, z = flat ? 0.0 : 2.0 * (j + 0.5) / kHeights - 1.0;
        const double across = std::sqrt(1.0 - z * z);
        ways.push_back(reach.way(point, Vec3d(across * std::cos(phi), across * std::sin(phi), z)));
      }
    return ways;
  }

  double step_, error_ = 0.0;
  std::vector<double> ratios_;  // at multiples of the step
};

/// As far as the nearest photons are looked for: to the k-th of those that can come to the place, or, of fewer, to the
/// largest radius.
double radius_of_nearest(const std::vector<Photon>& photons, const Place& place, const GatherSettings& settings) {
  const Reach reach(place);
  std::vector<double> distances;
  for (const Photon& p : photons)
    if (reach.holds(p.position)) distances.push_back(glm::distance(Vec3d(p.position), Vec3d(place.point)));
  if (distances.size() < settings.count) return settings.radius;
  const auto last = distances.begin() + settings.count - 1;
  std::nth_element(distances.begin(), last, distances.end());
  return *last;
}

Hit on_square(const Scene& scene, const Vec3& point) {
  return scene.geometry.intersect({point + 0.01f * kUpwards, -kUpwards}).value();
}

/// Fluence over sigma_t = 1/m in the volume, irradiance on the plane; each may count what it corrects.
using MapEstimate = std::function<double(const PhotonMap&, GatherCounters&)>;
MapEstimate estimator(bool flat, const Scene& scene, const Vec3& point, const GatherSettings& settings) {
  if (!flat)
    return [&scene, point, settings](const PhotonMap& map, GatherCounters& counters) {
      const VolumeRegion region(scene, 0, point, settings.kernel);
      Neighbours near;
      return fluence(Rgb(1.0f), point, BoundedMap{map, region, GatherWork{counters, near}}).g;
    };
  const Hit hit = on_square(scene, point);
  return [&scene, hit, settings](const PhotonMap& map, GatherCounters& counters) {
    const SurfaceRegion region(scene, hit, kUpwards, settings);
    Neighbours near;
    return surface_irradiance(hit.position, kUpwards, BoundedMap{map, region, GatherWork{counters, near}}).value.g;
  };
}

/// What the place's region says of its share.
Shares shares_of(bool flat, const Scene& scene, const Place& place, const GatherSettings& settings) {
  if (!flat)
    return {flat, place, settings,
            [&](float radius) { return VolumeRegion(scene, 0, place.point, settings.kernel).share(radius).inside; }};
  const Hit hit = on_square(scene, place.point);
  return {flat, place, settings,
          [&](float radius) { return SurfaceRegion(scene, hit, kUpwards, settings).share(radius).inside; }};
}

std::vector<Check> check_place(bool flat, const Place& place, GatherMode mode, const Effort& effort) {
  const Scene scene = make_scene(flat, place);
  const double exact = density_at(place) * (flat ? 1.0 / 4.0 : 1.0 / 8.0);
  const bool nearest = mode == GatherMode::nearest;
  const GatherSettings settings{mode, nearest ? 1.9f : 0.5f, 12,
                                nearest ? KernelKind::constant : KernelKind::epanechnikov};
  const std::string name = fmt::format("{}, {}, {}", place.name, flat ? "on a square" : "in a cube",
                                       nearest ? "12 nearest" : "fixed radius");
  const MapEstimate estimate = estimator(flat, scene, place.point, settings);
  const Shares shares = shares_of(flat, scene, place, settings);
  std::atomic<uint64_t> too_small{0};
  const auto samples = sample_moments(1, effort.count(1'200, 15'000), effort.seed_of(name), [&](Rng& rng, double* out) {
    GatherCounters counters;
    std::vector<Photon> photons = even_photons(flat, place, rng);
    const double radius = nearest && exact > 0.0 ? radius_of_nearest(photons, place, settings) : settings.radius;
    out[0] = estimate(make_photon_map(std::move(photons), settings, kPhotons), counters) * shares.ratio(radius);
    too_small += counters.least_shares;
  });
  std::vector<Check> checks{
      check_bound(name + ", shares", shares.largest_error(), 0.0, flat ? kDiscError : kBallError),
      exact == 0.0 ? check_bound(name, samples[0].mean(), 0.0, 0.0) : check_mean(name, samples[0], exact)};
  if (too_small > 0) checks.push_back(check_bound(name + ", least shares", static_cast<double>(too_small), 0.0, 0.0));
  return checks;
}

std::vector<Check> check_kernels(bool flat, const Effort& effort) {
  std::vector<Check> checks;
  for (const Place& place : flat ? places_on_square() : places_in_cube())
    for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
      append(checks, check_place(flat, place, mode, effort));
  return checks;
}

}  // namespace

std::vector<Experiment> border_experiments() {
  return {{0, "even photons at borders, estimates corrected", [](const Effort& effort) {
             std::vector<Check> checks = check_kernels(false, effort);
             append(checks, check_kernels(true, effort));
             return checks;
           }}};
}

}  // namespace vpm
