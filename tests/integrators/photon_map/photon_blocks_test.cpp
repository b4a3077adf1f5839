// A pass by blocks of photons makes the picture of the pass in one piece.
#include "vpm/integrators/photon_map/photon_blocks.h"

#include <gtest/gtest.h>

#include <cstring>

#include "support/scenes.h"
#include "vpm/base/parallel.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/surface/light_map.h"
#include "vpm/integrators/render_scene.h"

namespace vpm {
namespace {

constexpr uint64_t kPhotons = 4001, kPhotonsOfBlock = 600;  // 7 blocks, of 571 and 572 photons

/// What a pass in blocks and one in one piece may be apart by, of the largest value of the picture. A map keeps the
/// power of a photon, which is over another number of photons in a block, to 4e-6.
constexpr float kRounding = 1e-5f;

/// A lamp over a floor, a box of chromatic fog with a ball of glass in it, and a ball with a grid of smoke.
Scene fog_smoke_and_glass() {
  Scene scene;
  Medium fog = make_medium(nullptr, Rgb(0.5f, 1.0f, 2.0f), 0.9f);
  fog.phase = HenyeyGreenstein{0.5f};
  const auto smoke = make_grid(centered_frame(8, 0.1), [](int x, int y, int z) { return lattice_noise(x, y, z); });
  scene.media = {fog, make_medium(smoke, Rgb(4.0f), 0.8f)};
  const Interface box{0, kVacuum}, glass{kVacuum, 0}, ball{1, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.2, -0.9, -0.8), Vec3d(0.2, 0.9, 0.8)), Boundary{}, &box);
  add_shape(scene, SphereShape{Vec3(-0.5f, -0.2f, 0.0f), 0.4f}, Dielectric{1.5f}, &glass);
  add_shape(scene, SphereShape{Vec3(0.7f, 0.0f, 0.0f), 0.45f}, Boundary{}, &ball);
  add_shape(scene, quad_mesh(Vec3d(-2, -1, 2), Vec3d(4, 0, 0), Vec3d(0, 0, -4)), Lambertian{Rgb(0.5f)});
  const QuadLight lamp{Vec3(-0.5f, 1.9f, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1), Rgb(10.0f, 8.0f, 6.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  scene.camera = make_camera(Vec3(0.0f, 0.5f, 4.0f), Vec3(0.0f, -0.1f, 0.0f), Vec3(0, 1, 0), 40.0f, {24, 24});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings in_one_piece() {
  RenderSettings settings;
  settings.photons.emitted = kPhotons;
  settings.volume.radius = settings.surface.radius = settings.caustics.radius = 0.15f;
  settings.samples_per_pixel = 2;
  return settings;
}

RenderSettings in_blocks(RenderSettings settings) {
  settings.photons.block = kPhotonsOfBlock;
  return settings;
}

float largest_of(const Image& image) {
  float largest = 0.0f;
  for (const Rgb& pixel : image.pixels) largest = std::max(largest, max_channel(glm::abs(pixel)));
  return largest;
}

/// The largest difference of a pixel in a channel, over the largest value of a channel.
float apart(const Image& a, const Image& b) {
  float most = 0.0f;
  for (size_t i = 0; i < a.pixels.size(); ++i) most = std::max(most, max_channel(glm::abs(a.pixels[i] - b.pixels[i])));
  return most / largest_of(a);
}

struct Way {
  const char* name;
  void (*choose)(RenderSettings&);
};
using S = RenderSettings;

const Way kWays[] = {
    {"points", [](S& s) { s.volume.choose("radius"); }},
    {"points, a ball at a time", [](S& s) { s.volume.boundary = BoundaryRule::corrected; }},
    {"points, nothing at borders", [](S& s) { s.volume.boundary = BoundaryRule::none; }},
    {"points, density at the photon", [](S& s) { s.volume.form = VolumeForm::density_at_photon; }},
    {"points, and shadow rays of the march", [](S& s) { s.single_scattering.type = DirectLight::shadow_rays; }},
    {"beside rays", [](S& s) { s.volume.choose("beam"); }},
    {"beside rays, and equiangular light",
     [](S& s) { s.volume.choose("beam"), s.single_scattering.type = DirectLight::equiangular; }},
    {"photon beams", [](S& s) { s.volume.choose("photon-beams"); }},
    {"long beams", [](S& s) { s.volume.choose("photon-beams"), s.volume.length = BeamLength::long_beams; }},
    {"surfaces by photons alone", [](S& s) { s.direct.type = DirectLight::photons; }},
    {"surfaces, corrected at borders", [](S& s) { s.surface.boundary = BoundaryRule::corrected; }},
    {"a kernel of order 4", [](S& s) { s.surface.kernel = s.volume.kernel = KernelKind::order_4; }},
    {"final gathering", [](S& s) { s.indirect.type = IndirectLight::final_gather; }},
    {"importance", [](S& s) { s.importance.importons = 500, s.importance.scatter = true; }},
    {"random numbers", [](S& s) { s.photons.sequence = PhotonSequence::random; }},
};

// Light and what corrects kernels, in a later pass, whose radii have shrunk.
TEST(PhotonBlocks, MakeThePictureOfThePass) {
  const Scene scene = fog_smoke_and_glass();
  for (const Way& way : kWays) {
    RenderSettings settings = in_one_piece();
    way.choose(settings);
    ASSERT_NO_THROW(validate(in_blocks(settings), facts_of(scene))) << way.name;
    const Pass whole = render_photon_pass(scene, settings, 3);
    const Pass blocks = render_photon_pass(scene, in_blocks(settings), 3);
    EXPECT_GT(largest_of(whole.image), 0.0f);
    EXPECT_LT(apart(whole.image, blocks.image), kRounding) << way.name;
    EXPECT_LT(apart(whole.correction, blocks.correction), kRounding) << way.name;
    EXPECT_EQ(blocks.statistics.ledger.emitted_count, kPhotons) << way.name;
    EXPECT_GT(whole.statistics.last_volume_radius, 0.0f) << way.name;
    EXPECT_EQ(blocks.statistics.last_volume_radius, whole.statistics.last_volume_radius) << way.name;
  }
}

// Most blocks store nothing in a medium: the rays of all march through the same places.
TEST(PhotonBlocks, MayBeOfFewPhotons) {
  const Scene scene = fog_smoke_and_glass();
  RenderSettings settings = in_one_piece();
  settings.photons.emitted = 60;
  const Pass whole = render_photon_pass(scene, settings, 0);
  settings.photons.block = 1;
  EXPECT_EQ(block_count(settings), 60u);
  EXPECT_LT(apart(whole.image, render_photon_pass(scene, settings, 0).image), kRounding);
}

TEST(PhotonBlocks, HaveAllPhotonsOfThePassOnce) {
  for (const uint64_t photons : {1u, 5u, 600u, 601u, 4001u})
    for (const uint64_t most : {1u, 7u, 600u, 5000u}) {
      RenderSettings settings;
      settings.photons.emitted = photons;
      settings.photons.block = most;
      const uint64_t blocks = block_count(settings);
      EXPECT_EQ(blocks, (photons + most - 1) / most);
      uint64_t next = 0;
      for (uint64_t number = 0; number < blocks; ++number) {
        const PhotonBlock block = photon_block(settings, number);
        EXPECT_EQ(block.first, next);
        EXPECT_GE(block.count, photons / blocks);
        EXPECT_LE(block.count, most);
        next += block.count;
      }
      EXPECT_EQ(next, photons);
    }
}

TEST(PhotonBlocks, AreTheWholePassWhereNoneAreAskedFor) {
  RenderSettings settings = in_one_piece();
  EXPECT_EQ(block_count(settings), 1u);
  EXPECT_EQ(photon_block(settings, 0).count, kPhotons);
  settings.photons.emitted = 0;  // until maps are full
  EXPECT_EQ(photon_block(settings, 0).count, 0u);
  settings = in_blocks(in_one_piece());
  settings.integrator = Integrator::path;
  EXPECT_EQ(block_count(settings), 1u);
}

TEST(PhotonBlocks, AddUpInTheStatistics) {
  const Scene scene = fog_smoke_and_glass();
  RenderSettings settings = in_one_piece();
  settings.radii = RadiusSchedule::per_pixel;
  settings.volume.choose("photon-beams");
  const Pass whole = render_photon_pass(scene, settings, 0);
  const Pass blocks = render_photon_pass(scene, in_blocks(settings), 0);
  const RenderStatistics &a = whole.statistics, &b = blocks.statistics;
  EXPECT_EQ(b.passes, 1);
  EXPECT_EQ(b.ledger.emitted_count, kPhotons);
  EXPECT_EQ(b.ledger.collisions, a.ledger.collisions);
  EXPECT_NEAR(b.ledger.escaped.g, a.ledger.escaped.g, 1e-9 * a.ledger.escaped.g);
  EXPECT_EQ(b.volume_photons, a.volume_photons);
  EXPECT_EQ(b.surface_photons, a.surface_photons);
  EXPECT_EQ(b.beams, a.beams);
  EXPECT_EQ(b.eye.rays, 7 * a.eye.rays);
  EXPECT_EQ(b.last_volume_radius, a.last_volume_radius);
  EXPECT_LT(b.photon_map_bytes, a.photon_map_bytes / 4) << "of the largest block";
  EXPECT_EQ(blocks.found, whole.found) << "for the radii of the next pass";
}

TEST(PhotonBlocks, AreTheSameOnAnyNumberOfThreads) {
  const Scene scene = fog_smoke_and_glass();
  std::vector<Image> images;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    images.push_back(render_photon_pass(scene, in_blocks(in_one_piece()), 0).image);
  }
  set_threads(0);
  EXPECT_EQ(std::memcmp(images[0].pixels.data(), images[1].pixels.data(), images[0].pixels.size() * sizeof(Rgb)), 0);
}

TEST(PhotonBlocks, MakeTheLightMapOfThePass) {
  const Scene scene = fog_smoke_and_glass();
  const UvLayout layout = lay_out_light_map(scene, 3, 16);  // of the floor
  for (const IndirectLight indirect : {IndirectLight::photons, IndirectLight::final_gather}) {
    RenderSettings settings = in_one_piece();
    settings.indirect.type = indirect;
    ASSERT_NO_THROW(validate_light_map(in_blocks(settings), facts_of(scene)));
    const Pass whole = light_map_pass(scene, settings, layout, 0);
    const Pass blocks = light_map_pass(scene, in_blocks(settings), layout, 0);
    EXPECT_LT(apart(whole.image, blocks.image), kRounding);
    EXPECT_EQ(blocks.statistics.ledger.emitted_count, kPhotons);
  }
}

}  // namespace
}  // namespace vpm
