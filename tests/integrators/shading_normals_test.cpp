// Bumpy plates: what photons carry off them is what eye paths see on them, and the ledger closes.
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/base/warp.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/photon/records.h"

namespace vpm {
namespace {

/// A square of half edge 1.5 m in y = 0 that faces +y, its vertices' normals tilted at random by up to about 35
/// degrees.
TriangleMesh bumpy_plate() {
  constexpr int kVertices = 9;  // along an edge
  TriangleMesh mesh;
  Rng rng(3, rng_stream(RngUse::test, 0), 0);
  for (int z = 0; z < kVertices; ++z)
    for (int x = 0; x < kVertices; ++x) {
      mesh.positions.emplace_back(0.375f * static_cast<float>(x) - 1.5f, 0.0f, 0.375f * static_cast<float>(z) - 1.5f);
      mesh.normals.push_back(Vec3(rng.uniform() - 0.5f, 1.0f, rng.uniform() - 0.5f));
    }
  for (uint32_t z = 0; z + 1 < kVertices; ++z)
    for (uint32_t x = 0; x + 1 < kVertices; ++x) {
      const uint32_t a = z * kVertices + x, b = a + kVertices;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  return mesh;
}

/// A detector, all but black: a square of 0.8 m in y = `height` that faces the plate.
struct Detector {
  float height;
  static constexpr float kEdge = 0.8f;
  Vec3 corner() const { return {-1.0f, height, -0.6f}; }
  Vec3 normal() const { return {0, height > 0.0f ? -1.0f : 1.0f, 0}; }
  TriangleMesh mesh() const {
    const Vec3d x(kEdge, 0, 0), z(0, 0, kEdge);
    return height > 0.0f ? quad_mesh(Vec3d(corner()), x, z) : quad_mesh(Vec3d(corner()), z, x);
  }
};

/// A lamp 1.2 m above the plate that shines down on it, and a detector beside the light or below the plate: no straight
/// line joins them.
Scene lamp_plate_detector(const TriangleMesh& plate, const Material& material, const Detector& detector) {
  Scene scene;
  const QuadLight lamp{Vec3(0.1f, 1.2f, -0.3f), Vec3(0.7f, 0, 0), Vec3(0, 0, 0.7f), Rgb(2.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  add_shape(scene, plate, material);
  add_shape(scene, detector.mesh(), Lambertian{Rgb(1e-6f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The flux onto the detector, W, by photons that came by way of the plate: one value for each batch.
Moments flux_by_photons(const Scene& scene, const Detector& detector) {
  const auto strategy = make_distance_strategy({});
  Moments flux;
  for (uint64_t batch = 0; batch < 100; ++batch) {
    ListSettings settings;
    settings.pass = batch;
    settings.emitted = 10000;
    settings.direct_hits = false;
    const PhotonLists photons = list_photons(scene, *strategy, settings);
    double sum = 0.0;
    for (const Photon& p : photons.surface)
      if (std::abs(p.position.y - detector.height) < 1e-3f) sum += p.power.g;
    flux.add(sum / static_cast<double>(photons.ledger.emitted_count));
  }
  return flux;
}

/// The same by radiance along rays that leave the detector: area times pi times its mean over cosine directions.
Moments flux_by_eye_paths(const Scene& scene, const Detector& detector) {
  const PathContext context = make_path_context(scene, {});
  EyeCounters counters;
  Moments flux;
  for (uint64_t i = 0; i < 400000; ++i) {
    Rng rng(7, rng_stream(RngUse::test, 0), i);
    const Vec2 u = rng.uniform2();
    const Vec3 on = detector.corner() + Detector::kEdge * Vec3(u.x, 0, u.y);
    const Ray ray{leave_surface_at(on, detector.normal(), detector.normal()),
                  cosine_hemisphere(detector.normal(), rng.uniform2())};
    const double area = double{Detector::kEdge} * Detector::kEdge;
    flux.add(area * kPiD * path_radiance(context, ray, kVacuum, rng, counters).g);
  }
  return flux;
}

TEST(SlowShadingNormals, PhotonsCarryTheFluxThatEyePathsSee) {
  const TriangleMesh bumpy = bumpy_plate();
  for (const auto& [name, material, height] : {std::tuple("diffuse", Material(Lambertian{Rgb(0.8f)}), 1.2f),
                                               std::tuple("mirror", Material(Mirror{Rgb(0.9f)}), 1.2f),
                                               std::tuple("glass, above", Material(Dielectric{2.5f}), 1.2f),
                                               std::tuple("glass, below", Material(Dielectric{1.5f}), -1.0f)}) {
    const Detector detector{height};
    const Scene scene = lamp_plate_detector(bumpy, material, detector);
    const Moments photons = flux_by_photons(scene, detector), eyes = flux_by_eye_paths(scene, detector);
    const double error = std::sqrt(photons.variance_of_mean() + eyes.variance_of_mean());
    EXPECT_LT(std::abs(photons.mean() - eyes.mean()), normal_quantile(kFalseAlarms) * error)
        << name << ": " << photons.mean() << " against " << eyes.mean() << " +- " << error;
    EXPECT_LT(error, 0.04 * eyes.mean()) << name;
    std::printf("%s: %.5f and %.5f +- %.5f W\n", name, photons.mean(), eyes.mean(), error);
  }
}

// A light in a box whose walls have tilted normals.
TEST(ShadingNormals, TheLedgerCloses) {
  for (const Material& material :
       {Material(Lambertian{Rgb(0.7f, 0.5f, 0.3f)}), Material(Mirror{Rgb(0.8f)}), Material(Dielectric{1.4f})}) {
    Scene scene;
    for (const int axis : {0, 1, 2})
      for (const double side : {-1.0, 1.0}) {
        Vec3d out(0.0), u(0.0), v(0.0);
        out[axis] = side;
        u[(axis + 1) % 3] = 2.0;
        v[(axis + 2) % 3] = 2.0 * side;
        TriangleMesh wall = quad_mesh(out - 0.5 * (u + v), u, v);
        wall.normals = {Vec3(out + 0.2 * u), Vec3(out - 0.1 * v), Vec3(out), Vec3(out + 0.1 * u - 0.2 * v)};
        add_shape(scene, wall, material);
      }
    scene.lights.push_back(PointLight{Vec3(0.3f, 0.2f, -0.1f), Rgb(1.0f, 2.0f, 0.5f)});
    scene.geometry.commit();
    finish(scene);
    ListSettings settings;
    settings.emitted = 100000;
    const Ledger ledger = list_photons(scene, *make_distance_strategy({}), settings).ledger;
    const Rgbd emitted = ledger.emitted / static_cast<double>(ledger.emitted_count);  // W; and floats' rounding
    const Rgbd lost = ledger.imbalance.mean(), error = ledger.imbalance.standard_error();
    for (int c = 0; c < 3; ++c) {
      EXPECT_LT(std::abs(lost[c]), normal_quantile(kFalseAlarms) * error[c] + 1e-6 * emitted[c]);
      EXPECT_LT(error[c], 0.01 * emitted[c]);
    }
    EXPECT_EQ(ledger.non_finite, 0u);
    EXPECT_EQ(ledger.cut_count, 0u);
  }
}

// A plate with one shading normal n under parallel light along d reflects reflectance / pi times E |d . n|, whether its
// irradiance is of shadow rays or of photons, which tell of E |cos_g|.
TEST(ShadingNormals, ADiffusePlateIsAsBrightAsItsShadingCosine) {
  const Vec3 n = glm::normalize(Vec3(0.5f, 1.0f, 0.2f)), d = glm::normalize(Vec3(-0.6f, -1.0f, 0.1f));
  TriangleMesh plate = quad_mesh(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  plate.normals.assign(4, n);
  Scene scene;
  add_shape(scene, plate, Lambertian{Rgb(0.6f)});
  scene.lights.push_back(DirectionalLight{d, Rgb(3.0f)});
  scene.camera = make_camera(Vec3(0.3f, 2, 1), Vec3(0.0f), Vec3(0, 1, 0), 20.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  const double expected = 0.6 / kPiD * 3.0 * -glm::dot(d, n);
  for (const auto& [integrator, direct] : {std::pair(Integrator::path, DirectLight::shadow_rays),
                                           {Integrator::photon, DirectLight::shadow_rays},
                                           {Integrator::photon, DirectLight::photons}}) {
    RenderSettings settings;
    settings.integrator = integrator;
    settings.direct.type = direct;
    settings.surface.radius = 0.1f;
    settings.photons.emitted = 50000;
    const bool by_photons = direct == DirectLight::photons;
    Moments mean;
    for (int pass = 0; pass < (by_photons ? 12 : 2); ++pass) {
      const Pass rendered = integrator == Integrator::path ? render_path_pass(scene, settings, pass)
                                                           : render_photon_pass(scene, settings, pass);
      double sum = 0.0;
      for (const Rgb& pixel : rendered.image.pixels) sum += pixel.g;
      mean.add(sum / static_cast<double>(rendered.image.pixels.size()));
    }
    if (by_photons)
      expect_mean(mean, expected, kFalseAlarms, "photons");
    else
      EXPECT_NEAR(mean.mean(), expected, 1e-5);
  }
}

// The same plate with a texture: the mean radiance of whole periods is that of the texture's mean.
TEST(Textures, AreReadWhereLightIsScattered) {
  Image checker(2, 2);
  checker.pixels = {Rgb(0.0f), Rgb(0.8f), Rgb(0.8f), Rgb(0.0f)};
  Scene scene;
  TriangleMesh plate = quad_mesh(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  for (Vec2& uv : plate.uvs) uv *= 4.0f;
  const auto texture = std::make_shared<Texture>(checker, TextureFilter::nearest);
  add_shape(scene, plate, Lambertian{texture->mean()});
  scene.textures = {texture};
  scene.lights.push_back(DirectionalLight{Vec3(0, -1, 0), Rgb(kPi)});
  scene.geometry.commit();
  finish(scene);
  const PathContext context = make_path_context(scene, {});
  EyeCounters counters;
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (const auto& [x, z, expected] : {std::tuple(0.25f, -0.25f, 0.8f), {0.75f, -0.25f, 0.0f}, {-0.25f, 0.75f, 0.0f}})
    EXPECT_NEAR(path_radiance(context, {Vec3(x, 1, z), Vec3(0, -1, 0)}, kVacuum, rng, counters).g, expected, 1e-6);
  // Photons are kept on black texels too: they count for the irradiance of the coloured ones beside them.
  ListSettings settings;
  settings.emitted = 20000;
  const PhotonLists photons = list_photons(scene, *make_distance_strategy({}), settings);
  EXPECT_EQ(photons.surface.size(), photons.ledger.surface_hits);
  const double share = photons.ledger.absorbed_on_surfaces.g /
                       (photons.ledger.emitted.g / 20000.0 * static_cast<double>(photons.ledger.surface_hits));
  EXPECT_NEAR(share, 0.6, normal_quantile(kFalseAlarms) * 0.4 / std::sqrt(photons.ledger.surface_hits));
}

}  // namespace
}  // namespace vpm
