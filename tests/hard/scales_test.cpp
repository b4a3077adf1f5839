// Worlds of any size and place: the same scene scaled by a power of two is the same picture bit for bit; far from the
// origin it is the same picture but for the rounding of its coordinates.
#include <cstring>

#include "hard/hard_scenes.h"
#include "vpm/base/statistics/tails.h"

namespace vpm {
namespace {

enum class Lamp { spot, panel, sun };

/// Anisotropic, heterogeneous smoke over a floor beside a glass ball, in units of `unit` m about `center`.
Scene small_world(float unit, const Vec3& center, Lamp lamp) {
  const auto at = [&](float x, float y, float z) { return center + unit * Vec3(x, y, z); };
  Scene scene;
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(15);
  frame.index_to_world = glm::translate(Mat4d(1.0), Vec3d(at(-1, 0, -1))) * glm::scale(Mat4d(1.0), Vec3d(unit / 8.0));
  Medium smoke = make_medium(make_grid(frame, [](int x, int y, int z) { return lattice_noise(x, y, z); }),
                             Rgb(1.0f, 2.0f, 3.0f) / unit, 0.75f);
  smoke.phase = HenyeyGreenstein{0.5f};
  scene.media.push_back(smoke);
  const Interface media{0, kVacuum};
  const auto box = [&](float x0, float x1) { return box_mesh(Vec3d(at(x0, 0.125f, -1)), Vec3d(at(x1, 2, 1))); };
  add_shape(scene, box(-1, 1), Boundary{}, &media);
  add_shape(scene, quad_mesh(Vec3d(at(-4, 0, 4)), Vec3d(8.0 * unit, 0, 0), Vec3d(0, 0, -8.0 * unit)), Lambertian{});
  add_shape(scene, SphereShape{at(2, 1, 0), 0.5f * unit}, Dielectric{1.5f});
  if (lamp == Lamp::spot)
    scene.lights.push_back(SpotLight{at(1, 4, 1), glm::normalize(Vec3(-0.3f, -1, -0.2f)), 0.9f, 0.8f,
                                     Rgb(16.0f, 8.0f, 4.0f) * (unit * unit)});
  if (lamp == Lamp::sun) scene.lights.push_back(DirectionalLight{glm::normalize(Vec3(0.3f, -1, 0.2f)), Rgb(4.0f)});
  if (lamp == Lamp::panel) {
    const QuadLight panel{at(0, 4, 0), Vec3(unit, 0, 0), Vec3(0, 0, unit), Rgb(16.0f, 8.0f, 4.0f)};
    scene.lights.push_back(panel);
    add_shape(scene, quad_mesh(Vec3d(panel.corner), Vec3d(panel.edge_u), Vec3d(panel.edge_v)), Lambertian{Rgb(0.0f)},
              nullptr, 0);
  }
  scene.camera = make_camera(at(3, 2, 5), at(0.5f, 0.75f, 0), Vec3(0, 1, 0), 40.0f, {16, 16});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings settings_for(float unit, DirectLight direct, GatherMode gather, VolumeForm form) {
  RenderSettings settings = settings_of(8000, 0.125f * unit);
  settings.single_scattering.type = settings.direct.type = direct;
  settings.volume.choose(gather == GatherMode::nearest ? "nearest" : "radius");
  settings.surface.mode = gather;
  settings.volume.form = form;
  return settings;
}

bool same_bits(const Image& a, const Image& b) {
  return std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

TEST(Scales, AWorldScaledByAPowerOfTwoIsTheSamePictureBitForBit) {
  for (const Lamp lamp : {Lamp::spot, Lamp::panel, Lamp::sun})
    for (const auto& [direct, gather, form] :
         {std::tuple(DirectLight::photons, GatherMode::radius, VolumeForm::density_at_query),
          std::tuple(DirectLight::shadow_rays, GatherMode::nearest, VolumeForm::density_at_query),
          std::tuple(DirectLight::photons, GatherMode::radius, VolumeForm::density_at_photon)}) {
      const Image benign = clean_image(small_world(1.0f, Vec3(0.0f), lamp), settings_for(1.0f, direct, gather, form));
      EXPECT_GT(mean_of(benign), 0.01);
      // The floor is 8 units wide: 1.2e-4 m and 1.7e7 m.
      for (const float unit : {0x1p-16f, 0x1p21f})
        EXPECT_TRUE(same_bits(
            clean_image(small_world(unit, Vec3(0.0f), lamp), settings_for(unit, direct, gather, form)), benign))
            << "unit " << unit << " m, lamp " << static_cast<int>(lamp);
    }
}

TEST(Scales, AWorldFarFromTheOriginIsTheSamePicture) {
  // 8 km wide, 1e6 m from the origin: coordinates are rounded to 1/16 m, 6e-5 of a unit.
  constexpr float kUnit = 1024.0f;
  Worst worst("difference of the means, in standard errors");
  for (const Lamp lamp : {Lamp::spot, Lamp::panel, Lamp::sun})
    for (const auto& [direct, gather, form] :
         {std::tuple(DirectLight::photons, GatherMode::radius, VolumeForm::density_at_query),
          std::tuple(DirectLight::shadow_rays, GatherMode::nearest, VolumeForm::density_at_photon)}) {
      const RenderSettings settings = settings_for(kUnit, direct, gather, form);
      const Moments near = clean_means(small_world(kUnit, Vec3(0.0f), lamp), settings, 6);
      const Moments far = clean_means(small_world(kUnit, Vec3(1e6f, -1e6f, 1e6f), lamp), settings, 6);
      const double error = std::sqrt(near.variance_of_mean() + far.variance_of_mean());
      worst.see((far.mean() - near.mean()) / error);
      EXPECT_NEAR(far.mean(), near.mean(), normal_quantile(kFalseAlarms) * error + 1e-3 * near.mean())
          << "lamp " << static_cast<int>(lamp);
    }
}

TEST(Scales, AMetreAThousandKilometresAwayIsCleanThoughUnresolved) {
  // Positions there are 1/16 m apart: shapes are rounded to that, which the scene file's notes say. Nothing may break.
  for (const Lamp lamp : {Lamp::spot, Lamp::panel, Lamp::sun})
    for (const DirectLight direct : {DirectLight::photons, DirectLight::shadow_rays})
      EXPECT_GT(mean_of(clean_image(small_world(1.0f, Vec3(1e6f, -1e6f, 1e6f), lamp),
                                    settings_for(1.0f, direct, GatherMode::radius, VolumeForm::density_at_query))),
                0.01);
}

}  // namespace
}  // namespace vpm
