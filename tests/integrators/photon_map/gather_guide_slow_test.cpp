// Rays of final gathering guided by photons: their weights, and less noise where light comes from one side.
#include <gtest/gtest.h>

#include "support/photons.h"
#include "support/statistics.h"
#include "vpm/base/warp.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/surface/gather_guide.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

void expect_same(const Moments& guided, const Moments& plain, double most, const std::string& what) {
  const Check check = check_same("", guided, plain);
  EXPECT_LT(check.error, most * plain.mean()) << what;
  EXPECT_GE(check.p, kFalseAlarms) << what << ": " << check.value << " against " << check.exact << " +- "
                                   << check.error;
}

/// 60 photons about the origin, most of them out of a cone from above, the others from below the plane y = 0.
PhotonMap photons_around() {
  std::vector<Photon> photons;
  for (uint64_t i = 0; i < 60; ++i) {
    Rng rng(7, rng_stream(RngUse::test, 1), i);
    const Vec2 at = 0.1f * rng.uniform2();
    const Vec3 axis = i % 4 == 0 ? Vec3(0.0f, 1.0f, 0.0f) : glm::normalize(Vec3(-0.6f, -0.8f, 0.2f));
    photons.push_back({Vec3(at.x, 0.0f, at.y), PackedDirection(uniform_cone(axis, 0.1f, rng.uniform2())), Rgb(1.0f)});
  }
  GatherSettings gather = kGuidingPhotons;
  gather.radius = 1.0f;
  return make_photon_map(photons, gather, 1);
}

// Radiance that grows along x, and is twice as large from below, gathered by all materials, seen from both sides of a
// surface whose normal for shading leans.
TEST(GatherGuide, ItsRaysWeighWhatTheMaterialScatters) {
  const PhotonMap map = photons_around();
  const Material materials[] = {Lambertian{Rgb(0.6f)}, Phong{Rgb(0.3f), Rgb(0.5f), 20.0f},
                                RoughConductor{Rgb(0.4f), Rgb(2.5f), 0.4f}, RoughDielectric{1.5f, 0.4f}};
  Hit flat;
  flat.normal = flat.shading_normal = Vec3(0.0f, 1.0f, 0.0f);
  Hit leaning = flat;
  leaning.shading_normal = glm::normalize(Vec3(0.3f, 1.0f, 0.1f));
  for (const Hit& hit : {flat, leaning})
    for (const Material& material : materials)
      for (const float down : {-1.0f, 1.0f}) {
        const SurfaceView view{hit, material, glm::normalize(Vec3(0.5f, down, 0.3f))};
        const auto gathered = [&](const GatherGuide& guide, uint64_t stream) {
          Moments moments;
          for (uint64_t i = 0; i < 100'000; ++i) {
            Rng rng(7, rng_stream(RngUse::test, stream), i);
            const Scatter s = guide.sample(rng);
            EXPECT_TRUE(is_black(s.weight) || s.transmitted == (s.direction.y * down > 0.0f));
            moments.add(s.weight.g * s.radiance_scale * (1.5f + s.direction.x) * (s.direction.y < 0.0f ? 2.0f : 1.0f));
          }
          return moments;
        };
        GatherCounters counters;
        Neighbours near;
        expect_same(gathered(GatherGuide(view, map, {counters, near}), 2), gathered(GatherGuide(view), 3), 0.01,
                    std::to_string(material.index()) + (down < 0.0f ? " from above" : " from below"));
      }
}

TEST(GatherGuide, WithoutPhotonsDrawsAsTheMaterialScatters) {
  Hit hit;
  hit.normal = hit.shading_normal = Vec3(0.0f, 1.0f, 0.0f);
  const Material diffuse = Lambertian{Rgb(0.6f)};
  const SurfaceView view{hit, diffuse, Vec3(0.0f, -1.0f, 0.0f)};
  GatherSettings gather = kGuidingPhotons;
  gather.radius = 1.0f;
  Rng rng(7, rng_stream(RngUse::test, 4), 0), same = rng;
  GatherCounters counters;
  Neighbours near;
  const Scatter guided = GatherGuide(view, make_photon_map({}, gather, 1), {counters, near}).sample(rng);
  const Scatter plain = GatherGuide(view).sample(same);
  EXPECT_EQ(guided.direction, plain.direction);
  EXPECT_EQ(guided.weight, plain.weight);
}

/// A diffuse room of 2 m with a light, a wall of rough metal, and a ball of frosted glass with something dark inside.
Scene furnished_room() {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(0.5f), 0.0f));
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(0.6f)});
  add_shape(scene, quad_mesh(Vec3d(-0.8, -0.9, -0.5), Vec3d(0, 0, 1), Vec3d(0, 1, 0)),
            RoughConductor{Rgb(0.4f), Rgb(2.5f), 0.4f});
  const Interface glass{0, kVacuum};
  add_shape(scene, SphereShape{Vec3(0.3f, -0.5f, 0.1f), 0.35f}, RoughDielectric{1.5f, 0.4f}, &glass);
  scene.lights.push_back(PointLight{Vec3(0.1f, 0.8f, 0.3f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// A dark room of 2 m; what light there is falls in as a beam 0.4 m wide, as through a hole, and lights that much of a
/// wall.
Scene camera_obscura() {
  Scene scene;
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(0.2f)});
  scene.lights.push_back(BeamLight{Vec3(-0.9f, 0.2f, 0.1f), Vec3(1.0f, 0.0f, 0.0f), 0.2f, Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// Final gathering guided by photons.
RenderSettings guided_gathering() {
  RenderSettings settings;
  settings.photons.emitted = 100'000;
  settings.surface.mode = GatherMode::nearest;
  settings.surface.radius = settings.caustics.radius = 0.15f;
  settings.indirect.type = IndirectLight::final_gather;
  settings.indirect.rays_by = GatherBy::photons;
  settings.indirect.rays = 1;
  return settings;
}

/// What the surface that a ray from vacuum meets sends back, green, one gathering ray a sample.
Moments gathered(const Scene& scene, bool guided, const Ray& ray, int samples, EyeCounters& counters) {
  RenderSettings settings = guided_gathering();
  if (!guided) settings.indirect.rays_by = GatherBy::material;
  RenderStatistics statistics;
  const Estimators estimators = plan_estimators(scene, settings, 0);
  prepare_pass(scene, settings, estimators, {}, statistics);
  const Hit hit = *scene.geometry.intersect(ray);
  const Material material = material_at(scene, hit);
  const SurfaceView view{hit, material, ray.direction, kVacuum};
  EyeScratch scratch;
  Moments moments;
  for (int i = 0; i < samples; ++i) {
    Rng rng(8, rng_stream(RngUse::test, guided ? 1 : 0), static_cast<uint64_t>(i));
    EyeWork work{rng, counters, scratch};
    moments.add(estimators.surface->sent(view, work).value.g);
  }
  return moments;
}

// One ray in a hundred meets the bright spot by chance. Rays that photons guide go to its cells, of which it fills a
// part: seen is a sixth of the variance.
TEST(GatherGuide, FindsTheLightThatComesFromOneSpot) {
  const Scene scene = camera_obscura();
  const Ray ray{Vec3(0.0f), glm::normalize(Vec3(-0.2f, -1.0f, 0.3f))};
  EyeCounters counters;
  const Moments guided = gathered(scene, true, ray, 80'000, counters);
  const Moments plain = gathered(scene, false, ray, 80'000, counters);
  EXPECT_LT(4.0 * guided.variance(), plain.variance());
  expect_same(guided, plain, 0.05, "");
}

// What its map holds and what the caustic map holds with direct light are all photons of the surface map.
TEST(GatherGuide, IsMadeOfWhatTheCausticMapLeavesOut) {
  const Scene scene = furnished_room();
  HitRecorder all(scene, any_photon, HitUse::surface_map), from_rough(scene, photon_from_rough, HitUse::other_map),
      caustics(scene, caustic_photons(true, true), HitUse::other_map);
  trace_into(scene, {.emitted = 10'000}, {&all, &from_rough, &caustics});
  EXPECT_GT(from_rough.photons.size(), 10'000u);
  EXPECT_EQ(from_rough.photons.size() + caustics.photons.size(), all.photons.size());
}

}  // namespace
}  // namespace vpm
