// What may not depend on the world's size, handedness or orientation, nor on the number of photons: flows, fluence and
// what a camera sees of a scene with everything, against the same scene changed.
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "vpm/estimate/volume_estimate.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/small_pass.h"

namespace vpm {

namespace {

/// A map of the world onto another one: a turn or a mirror, times a scale.
struct Variation {
  std::string name;
  Mat3d turn{1.0};
  double scale = 1.0;
  uint64_t photons = 100;  // of a pass

  Vec3 point(const Vec3d& p) const { return Vec3(scale * (turn * p)); }
  Vec3 direction(const Vec3d& d) const { return Vec3(glm::normalize(turn * d)); }
};

TriangleMesh changed(TriangleMesh mesh, const Variation& change) {
  for (Vec3& p : mesh.positions) p = change.point(Vec3d(p));
  if (glm::determinant(change.turn) < 0.0)
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

/// Voxels of 1/4 m that fill [-1, 1]^3, random.
std::shared_ptr<const DensityGrid> changed_grid(const Variation& change) {
  GridFrame frame;
  frame.index_to_world = Mat4d(0.25 * change.scale * change.turn);
  frame.lo = Vec3i(-4);
  frame.hi = Vec3i(4);
  return make_grid(frame, [](int x, int y, int z) {
    const auto index = static_cast<uint64_t>((x + 4) + 9 * ((y + 4) + 9 * (z + 4)));
    return 2.0 * Rng(5, rng_stream(RngUse::test, 0), index).uniform_double();
  });
}

/// Coloured fog in a box over a floor, a sphere of glass in it, a spot.
Scene changed_scene(const Variation& change) {
  Scene scene;
  Medium fog;
  fog.sigma_t = Rgb(0.8f, 1.2f, 2.0f) / static_cast<float>(change.scale);
  fog.sigma_s = Rgb(0.9f, 0.8f, 0.7f) * fog.sigma_t;
  fog.phase = HenyeyGreenstein{0.6f};
  fog.grid = changed_grid(change);
  scene.media.push_back(fog);
  const Interface media{0, kVacuum};
  add_shape(scene, changed(box_mesh(Vec3d(-1.0), Vec3d(1.0)), change), Boundary{}, &media);
  add_shape(scene, changed(quad_mesh(Vec3d(-2.0, -1.2, -2.0), Vec3d(0.0, 0.0, 4.0), Vec3d(4.0, 0.0, 0.0)), change),
            Lambertian{Rgb(0.8f, 0.6f, 0.4f)});
  add_shape(scene, SphereShape{change.point({0.5, -0.4, 0.3}), 0.3f * static_cast<float>(change.scale)},
            Dielectric{1.5f});
  scene.lights.push_back(
      SpotLight{change.point({-1.5, 1.8, 0.4}), change.direction({1.2, -1.6, -0.2}), 0.97f, 0.9f, Rgb(3.0f)});
  scene.camera = make_camera(change.point({0.8, 1.0, 3.5}), change.point({0.1, -0.3, 0.0}),
                             change.direction({0.0, 1.0, 0.0}), 40.0f, {4, 4});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

enum Quantity : size_t { in_fog, on_floor, away, here, seen, quantities };

/// Absorbed in the fog, absorbed by the floor, escaped (W); fluence at a point (W) and radiance of the film (W/sr)
/// times the scale's square.
std::vector<Moments> measure(const Variation& change, const Effort& effort) {
  const Scene scene = changed_scene(change);
  const auto strategy = make_distance_strategy({});
  const GatherSettings gather{GatherMode::radius, static_cast<float>(0.5 * change.scale), 0, KernelKind::epanechnikov};
  RenderSettings settings;
  settings.photons.emitted = change.photons;
  settings.radii = RadiusSchedule::constant;
  settings.volume.radius = settings.surface.radius = gather.radius;
  return sample_moments(
      quantities, effort.count(1'000, 24'000), effort.seed_of("change: " + change.name), [&](Rng& rng, double* out) {
        PhotonLists photons = small_pass(scene, *strategy, rng, change.photons);
        const Ledger& ledger = photons.ledger;
        const auto emitted = static_cast<double>(ledger.emitted_count);
        out[in_fog] = ledger.absorbed_in_media.r / emitted;
        out[on_floor] = ledger.absorbed_on_surfaces.g / emitted;
        out[away] = ledger.escaped.b / emitted;
        const PhotonMap map = make_photon_map(std::move(photons.volume[0]), gather, ledger.emitted_count);
        out[here] =
            fluence(scene.media[0].majorant(), change.point({-0.3, 0.3, 0.2}), map).g * change.scale * change.scale;
        RenderSettings own = settings;
        own.seed = rng.bits();
        out[seen] = channel_means(render_photon_pass(scene, own, 0).image).g * change.scale * change.scale;
      });
}

std::vector<Check> check_changes(const Effort& effort) {
  const Mat3d turned(glm::rotate(Mat4d(1.0), 1.1, glm::normalize(Vec3d(0.3, 1.0, -0.5))));
  const Mat3d mirrored(-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
  std::vector<Check> checks;
  const auto base = measure({.name = "none"}, effort);
  for (const Variation& change :
       {Variation{.name = "1000 times as large", .scale = 1000.0},
        Variation{.name = "a thousandth as large", .scale = 1e-3}, Variation{.name = "mirrored", .turn = mirrored},
        Variation{.name = "turned", .turn = turned}, Variation{.name = "twice the photons", .photons = 200}}) {
    const auto found = measure(change, effort);
    static constexpr std::array<const char*, quantities> kNames{"absorbed in fog", "absorbed by the floor", "escaped",
                                                                "fluence", "radiance seen"};
    for (size_t q = 0; q < quantities; ++q)
      checks.push_back(check_same(fmt::format("{}, {}", change.name, kNames[q]), found[q], base[q]));
  }
  return checks;
}

}  // namespace

std::vector<Experiment> symmetry_experiments() {
  return {{1, "the same world: larger, mirrored, turned, with more photons", check_changes}};
}

}  // namespace vpm
