// The shares of combined techniques, as sub-paths find them vertex by vertex, against the densities of all techniques
// from the vertices of whole paths alone: of random paths, whose legs have any transmittance.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vpm/base/parallel.h"
#include "vpm/integrators/combined/merge_shares.h"
#include "vpm/scene/camera.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/lights.h"
#include "vpm/study/validate/scenes/whole_path.h"

namespace vpm {
namespace {

/// The sub-paths along the whole path, as they are traced.
struct SubPaths {
  std::vector<PathVertex> light, eye;               // at each vertex
  std::vector<Departure> light_leaves, eye_leaves;  // of each vertex
};

/// Vertex i of a sub-path that comes to it along `travel`, over a leg, from a departure.
PathVertex arrived(const TechniqueCounts& counts, const WholePath& path, size_t i, const Vec3& travel, const Leg& leg,
                   const Departure& from) {
  PathVertex vertex = path.vertices[i];
  vertex.travel = travel;
  vertex.leg = leg;
  arrive(counts, from, vertex);
  return vertex;
}

SubPaths trace_along(const WholePath& path, const TechniqueCounts& counts) {
  const size_t k = path.last();
  SubPaths traced{std::vector<PathVertex>(k), std::vector<PathVertex>(k), std::vector<Departure>(k),
                  std::vector<Departure>(k + 1)};
  const Vec3 normal = path.vertices[0].normal;
  const EmissionDensity emission = emission_density(path.light, {}, normal, path.direction(0));
  traced.light_leaves[0] =
      depart_from_light(counts, path.light, path.chosen, emission, {path.points[0], path.direction(0)}, normal);
  for (size_t i = 1; i < k; ++i) {
    traced.light[i] = arrived(counts, path, i, path.direction(i - 1), path.leg(i - 1), traced.light_leaves[i - 1]);
    traced.light_leaves[i] =
        depart(counts, traced.light[i], path.direction(i), {density_on(path, i, true), density_on(path, i, false)},
               SubPath::light, i + 1 == k);
  }
  traced.eye_leaves[k] = depart_from_camera(counts, {path.points[k], -path.direction(k - 1)}, path.camera_density);
  for (size_t i = k - 1; i >= 1; --i) {
    traced.eye[i] = arrived(counts, path, i, -path.direction(i), path.leg(i), traced.eye_leaves[i + 1]);
    // As walks do: 1 on, and the factor of refraction back, whichever way the sub-path goes.
    const bool specular = path.vertices[i].specular;
    const double on = specular ? 1.0 : density_on(path, i, false);
    const double back = specular ? 1.0 / path.refractions[i] : density_on(path, i, true);
    traced.eye_leaves[i] =
        depart(counts, traced.eye[i], -path.direction(i - 1), {on, back}, SubPath::eye, first_from_eye(path, i));
  }
  return traced;
}

/// As photons around rays from the camera have it.
double share_along_ray(const WholePath& path, const TechniqueCounts& counts, const SubPaths& traced, size_t i) {
  const Junction& at = path.vertices[i];
  const double sigma_t = mean_channel(at.sigma_t);
  PhotonLeaf leaf;
  leaf.set(0, {path.points[i], path.direction(i - 1), Rgb(1.0f),
               traced.light[i].behind.over(1.0 / behind_scale(counts, sigma_t)), passing(at.sigma_t, path.leg(i - 1))});
  const Departure& eye = traced.eye_leaves[i + 1];
  const double to_eye = path.leg(i).distance;
  PhotonsBesideRays beside{};
  beside.density.set(0, 1.0f);
  beside.sine.set(0, glm::length(glm::cross(leaf.travel(0), path.direction(i))));
  beside.passing.set(0, leaf.passing[0]);
  beside.adjacent.set(0, leaf.adjacent[0]);
  beside.further.set(0, leaf.further[0]);
  beside.phase.set(0, static_cast<float>(density_on(path, i, true)));
  beside.kept.set(0, static_cast<float>(at.kept));
  beside.colliding.set(0, static_cast<float>(mean_channel(at.sigma_t * path.transmittances[i]) / sigma_t));
  beside.splats.set(
      0, static_cast<float>(std::min(eye.adjacent / eye.forward * to_eye * to_eye / counts.points_2d, 1e30)));
  const auto mean = static_cast<float>(sigma_t);
  return double{counts.heuristic == Heuristic::power ? SharesOfPoints<true>(counts, mean).of(beside)[0]
                                                     : SharesOfPoints<false>(counts, mean).of(beside)[0]};
}

/// As beams that rays from the camera cross have it.
double share_across_ray(const WholePath& path, const TechniqueCounts& counts, const SubPaths& traced, size_t i) {
  const Junction& at = path.vertices[i];
  const Rgb &flown = path.transmittances[i - 1], &seen = path.transmittances[i];
  const FlightTerms flight = flight_terms(counts, traced.light_leaves[i - 1], Rgb(1.0f), path.points[i - 1]);
  const auto distance = static_cast<float>(path.leg(i - 1).distance);
  const float adjacent = adjacent_at(flight, path.points[i], path.direction(i - 1), distance);
  CrossedBeams crossed{};
  crossed.sine.set(0, glm::length(glm::cross(path.direction(i - 1), path.direction(i))));
  crossed.passed.set(0, mean_channel(flown));
  crossed.colliding.set(0, mean_channel(at.sigma_t * flown));
  crossed.seen.set(0, mean_channel(at.sigma_t * seen));
  crossed.kept.set(0, static_cast<float>(at.kept));
  crossed.back.set(0, sum_channels(flight.back * flown) * static_cast<float>(density_on(path, i, true)));
  crossed.adjacent.set(0, adjacent * (flight.parallel ? 1.0f : distance * distance));
  const Departure& eye = traced.eye_leaves[i + 1];
  const double to_eye = path.leg(i).distance;
  crossed.splats.set(0, static_cast<float>(eye.adjacent / eye.forward * to_eye * to_eye / counts.short_beams));
  return double{counts.heuristic == Heuristic::power ? SharesOfBeams<true>(counts).of(crossed)[0]
                                                     : SharesOfBeams<false>(counts).of(crossed)[0]};
}

double share_of(const WholePath& path, const TechniqueCounts& counts, const SubPaths& traced, const Found& found) {
  using By = Found::By;
  const size_t i = found.at, k = path.last();
  const auto behind = [&](const Departure& from, size_t to) {
    return techniques_behind(counts, from, path.leg(i), path.vertices[to], path.points[to]);
  };
  if (found.by == By::splat) return share_of_splat(counts, behind(traced.light_leaves[i], k), path.camera_density);
  if (found.by == By::run_into || found.by == By::sampled || found.by == By::connected) {
    const Departure &light = traced.light_leaves[i], &eye = traced.eye_leaves[i + 1];
    const Behind at_eye = behind(light, i + 1), at_light = behind(eye, i);
    return found.by == By::run_into ? share_of_running_into(counts, light, at_eye, eye, at_light)
                                    : share_of_connection(counts, light, at_eye, eye, at_light);
  }
  if (found.by == By::points_2d) return share_along_ray(path, counts, traced, i);
  if (found.by == By::short_beams) return share_across_ray(path, counts, traced, i);
  const Junction& at = path.vertices[i];
  const bool first = first_from_eye(path, i), on_surface = at.kind == Junction::Kind::surface;
  const double sine = sine_between(path.direction(i - 1), path.direction(i));
  const double merges =
      on_surface ? merges_on_surface(counts, first)
                 : merges_in_medium(counts, at, passing(at.sigma_t, path.leg(i - 1)), path.leg(i), sine, first);
  const double all = all_at_merge(counts, merges, traced.light[i].behind, density_on(path, i, false),
                                  traced.eye[i].behind, density_on(path, i, true));
  return (on_surface ? merges : points_3d_merged(counts, at, first)) / all;
}

TechniqueCounts random_counts(Rng& rng, Heuristic heuristic) {
  TechniqueCounts counts;
  const auto number = [&] { return rng.uniform() < 0.2f ? 0.0 : std::exp(4.0 * rng.uniform_double() - 2.0); };
  counts.light = rng.uniform() < 0.8f;
  counts.each_light = rng.uniform() < 0.5f;
  counts.connections = number();
  counts.splats = number();
  counts.surfaces = number();
  counts.points_3d = number();
  counts.points_2d = number();
  counts.short_beams = number();
  counts.heuristic = heuristic;
  if (heuristic == Heuristic::correlation_aware) counts.deep = false;
  return counts;
}

/// How far shares are off: the largest of many paths.
struct WorstShares {
  double share = 0.0, sum = 0.0;
  uint64_t number = 0;

  void see(const WholePath& path, const TechniqueCounts& counts) {
    const std::vector<Found> all = all_densities(path, counts);
    if (all.empty()) return;
    double density = 0.0, of_all = 0.0;
    for (const Found& found : all) density += found.density;
    const SubPaths traced = trace_along(path, counts);
    for (const Found& found : all) {
      const double here = share_of(path, counts, traced, found);
      of_all += here;
      share = std::max(share, std::abs(here - found.density / density));
    }
    sum = std::max(sum, std::abs(of_all - 1.0));
    number += all.size();
  }
  void merge(const WorstShares& other) {
    share = std::max(share, other.share);
    sum = std::max(sum, other.sum);
    number += other.number;
  }
};

std::vector<Check> check_shares(const Effort& effort) {
  constexpr double kBound = 1e-5;
  constexpr size_t kChunk = 1000;
  const uint64_t paths = effort.count(40'000, 1'000'000), seed = effort.seed_of("shares of techniques");
  std::vector<Check> checks;
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power, Heuristic::correlation_aware}) {
    std::vector<WorstShares> parts(chunk_count(paths, kChunk));
    parallel_for_chunks(paths, kChunk, [&](size_t begin, size_t end, size_t chunk) {
      for (uint64_t i = begin; i < end; ++i) {
        Rng rng(seed, rng_stream(RngUse::test, 0), i);
        const WholePath path = random_path(rng, 1 + static_cast<int>(12.0 * rng.uniform_double()));
        parts[chunk].see(path, random_counts(rng, heuristic));
      }
    });
    WorstShares worst;
    for (const WorstShares& part : parts) worst.merge(part);
    const char* name = heuristic == Heuristic::balance ? "balance heuristic"
                       : heuristic == Heuristic::power ? "power heuristic"
                                                       : "correlation-aware heuristic";
    checks.push_back(check_bound(fmt::format("{}, the largest error of a share", name), worst.share, 0.0, kBound));
    checks.push_back(check_bound(fmt::format("{}, of a path's sum of shares", name), worst.sum, 0.0, kBound));
    checks.push_back(check_bound(fmt::format("{}, shares of a path, fewer than two", name),
                                 static_cast<double>(worst.number < 2 * paths), 0.0, 0.0));
  }
  return checks;
}

/// What a light sends to a point and what photons bring there is the same light: for each sample towards the light,
/// irradiance times its density is the power of photons times their densities, over the squared distance.
std::vector<Check> check_emission(const Effort& effort) {
  const std::pair<const char*, Light> lights[] = {
      {"point", PointLight{{0.3f, 1.0f, 0.2f}, kColour}},
      {"spot", SpotLight{{0.0f, 1.2f, 0.0f}, kAxis, 0.95f, 0.5f, kColour}},
      {"beam", BeamLight{{-0.1f, 1.2f, -0.2f}, kAxis, 0.8f, kColour}},
      {"quad", test_quad()},
      {"disc", test_disc()},
      {"sphere", test_sphere()},
      {"mesh", MeshLight{std::make_shared<const EmittingMesh>(test_tetrahedron()), kColour}},
      {"directional", DirectionalLight{kAxis, kColour}},
      {"constant environment", ConstantEnvironment{kColour}},
      {"environment map", test_map().light()}};
  std::vector<Check> checks;
  for (const auto& [name, light] : lights) {
    Rng rng(effort.seed_of(name), rng_stream(RngUse::test, 0), 0);
    double worst = 0.0;
    uint64_t seen = 0;
    for (int i = 0; i < 4'000; ++i) {
      const Vec3 point = kLitBox.lo + kLitBox.extent() * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
      const std::optional<Incident> incident = sample_towards(light, point, rng);
      if (!incident) continue;
      const EmissionDensity density = emission_density(light, kLitBox, incident->normal, -incident->direction);
      // Photons of a map carry the power of their direction.
      const auto* map = std::get_if<EnvironmentMap>(&light);
      const double power = map ? environment_radiance(light, incident->direction).g / density.place / density.flight
                               : light_power(light, kLitBox).g;
      const double sampled = sampled_density(light, point, {incident->direction, incident->distance, incident->normal});
      const double spread = density.parallel ? 1.0 : 1.0 / (double{incident->distance} * incident->distance);
      const double by_photons = power * density.place * density.flight * spread;
      worst = std::max(worst, by_photons > 0.0 ? std::abs(incident->irradiance.g * sampled / by_photons - 1.0)
                                               : static_cast<double>(kInfinity));
      ++seen;
    }
    checks.push_back(check_bound(fmt::format("{}, the largest relative difference", name), worst, 0.0, 2e-4));
    checks.push_back(check_bound(fmt::format("{}, too few points lit", name), seen < 100, 0.0, 0.0));
  }
  return checks;
}

/// The solid angle of the film: that of a rectangle of half the sides a and b at the distance 1 is 4 atan(a b / sqrt(1
/// + a^2 + b^2)).
std::vector<Check> check_camera(const Effort&) {
  const Camera camera = make_camera(Vec3(0.0f), {0, 0, -1}, {0, 1, 0}, 90.0f, {300, 200});
  double sum = 0.0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) sum += 1.0 / camera.film_per_angle(camera.ray(Vec2(x, y) + 0.5f).direction);
  return {check_bound("the solid angle of a film", sum, 4.0 * std::atan(1.5 / std::sqrt(1.0 + 1.5 * 1.5 + 1.0)), 1e-4)};
}

}  // namespace

std::vector<Experiment> technique_experiments() {
  return {{0, "shares of combined techniques, by the densities of whole paths", check_shares},
          {0, "densities of emission, by what lights send to points", check_emission},
          {0, "densities of a camera", check_camera}};
}

}  // namespace vpm
