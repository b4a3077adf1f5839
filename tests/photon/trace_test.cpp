// Photon tracing: what is stored and told, by whom, and reproducibility.
#include "vpm/photon/records.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/parallel.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/photon/stored_power.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

/// A spot from above that grazes the box's side, so that photons enter by several faces.
const Light kSpot =
    SpotLight{Vec3(-1.5f, 2.5f, 0.4f), glm::normalize(Vec3(0.5f, -1.0f, -0.1f)), 0.97f, 0.9f, Rgb(4.0f, 2.0f, 1.0f)};

PhotonLists trace(const Scene& scene, const std::string& strategy, ListSettings settings) {
  settings.volume_form = VolumeForm::density_at_photon;
  return list_photons(scene, *make_distance_strategy({.strategy = strategy}), settings);
}

std::shared_ptr<const DensityGrid> grid_over_box(double (*density)(int, int, int)) {
  // Voxels of 1/8 m over [-1.5, 1.5]^3: the fading at the grid's edge stays outside the box.
  const GridFrame frame = centered_frame(12, 0.125);
  return make_grid(frame, density);
}

Medium colourful(std::shared_ptr<const DensityGrid> grid) {
  Medium medium = make_medium(std::move(grid), Rgb(0.6f, 1.2f, 2.4f));
  medium.sigma_s = medium.sigma_t * Rgb(0.95f, 0.7f, 0.3f);
  medium.phase = HenyeyGreenstein{0.5f};
  return medium;
}

/// A scene with everything a photon can meet: fog, a glass ball, a mirror, coloured walls. The fog is around the ball
/// or in it.
Scene full_scene(bool fog_in_glass = false) {
  Scene scene;
  scene.media.push_back(colourful(nullptr));
  scene.world_medium = fog_in_glass ? kVacuum : 0;
  add_shape(scene, quad_mesh(Vec3(-2, -1, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)), Lambertian{Rgb(0.8f, 0.5f, 0.2f)});
  add_shape(scene, quad_mesh(Vec3(-2, -1, -2), Vec3(4, 0, 0), Vec3(0, 3, 0)), Mirror{Rgb(0.9f, 0.8f, 0.7f)});
  const Interface media = fog_in_glass ? Interface{0, kVacuum} : Interface{kVacuum, 0};
  add_shape(scene, SphereShape{Vec3(0.0f, -0.2f, 0.0f), 0.6f}, Dielectric{1.5f}, &media);
  scene.lights.push_back(PointLight{Vec3(0.3f, 1.2f, 0.1f), Rgb(1.0f, 2.0f, 0.5f)});
  scene.lights.push_back(kSpot);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

TEST(PhotonTracing, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = full_scene();
  ListSettings settings;
  settings.emitted = 30001;
  std::vector<PhotonLists> results;
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    results.push_back(trace(scene, "homogeneous", settings));
  }
  set_threads(0);
  ASSERT_GT(results[0].volume[0].size(), 30000u);
  for (size_t i = 1; i < results.size(); ++i) {
    ASSERT_EQ(results[i].volume[0].size(), results[0].volume[0].size());
    EXPECT_EQ(std::memcmp(results[i].volume[0].data(), results[0].volume[0].data(),
                          results[0].volume[0].size() * sizeof(Photon)),
              0);
    EXPECT_EQ(
        std::memcmp(results[i].surface.data(), results[0].surface.data(), results[0].surface.size() * sizeof(Photon)),
        0);
    EXPECT_EQ(results[i].ledger.escaped, results[0].ledger.escaped);
  }
}

TEST(SlowPhotonTracing, FillsTheMapAndDividesByTheEmitted) {
  const Scene scene = full_scene();
  // The mean does not depend on how many are asked for: power stored over photons emitted.
  std::array<Moments, 2> stored;
  for (uint64_t pass = 0; pass < 40; ++pass)
    for (const int many : {0, 1}) {
      ListSettings settings;
      settings.pass = pass + 1000u * many;
      settings.stored = many ? 40000 : 10000;
      const PhotonLists photons = trace(scene, "homogeneous", settings);
      EXPECT_GE(photons.volume[0].size(), settings.stored);
      double sum = 0.0;
      for (const Photon& p : photons.volume[0]) sum += p.power.g;
      stored[many].add(sum / static_cast<double>(photons.ledger.emitted_count));
    }
  const double error = std::sqrt(stored[0].variance_of_mean() + stored[1].variance_of_mean());
  EXPECT_LT(std::abs(stored[0].mean() - stored[1].mean()), normal_quantile(kFalseAlarms) * error);
}

TEST(PhotonTracing, StopsWhenEitherMapIsFullAndTracesNoPhotonTwice) {
  ListSettings settings;
  settings.stored = 100000;
  for (const bool fog_in_glass : {false, true}) {  // fills the volume map, the surface map
    const PhotonLists photons = trace(full_scene(fog_in_glass), "homogeneous", settings);
    EXPECT_GE((fog_in_glass ? photons.surface : photons.volume[0]).size(), settings.stored);
    EXPECT_LT((fog_in_glass ? photons.volume[0] : photons.surface).size(), settings.stored);
    std::vector<std::array<float, 3>> places;
    for (const Photon& p : photons.volume[0]) places.push_back({p.position.x, p.position.y, p.position.z});
    std::sort(places.begin(), places.end());
    EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end());
  }
}

TEST(PhotonTracing, LightPhotonsEndOrBecomeATenth) {
  // The photons' power alone tells: without the division by the survival some would stay lighter.
  const auto checker = grid_over_box([](int x, int y, int z) { return ((x ^ y ^ z) & 4) ? 4.0 : 0.1; });
  const Scene scene = boxed_medium(make_medium(checker, Rgb(1.5f), 0.9f), kSpot);
  ListSettings settings;
  settings.emitted = 5000;
  const PhotonLists photons = trace(scene, "mean-extinction", settings);
  const double tenth = 0.1 * sum_channels(light_power(kSpot, scene.bounds));
  int at_the_limit = 0;
  double collided = 0.0;
  for (const Photon& p : photons.volume[0]) {
    const double power = sum_channels(p.power);
    ASSERT_GT(power, 0.9999 * tenth);
    at_the_limit += power < 1.0001 * tenth;
    collided += power;
  }
  EXPECT_GT(at_the_limit, 50);
  // What is stored is what collided: the medium absorbs 1 - albedo of it.
  const Rgbd absorbed = photons.ledger.absorbed_in_media;
  EXPECT_NEAR(0.1 * collided / (absorbed.r + absorbed.g + absorbed.b), 1.0, 1e-4);
}

TEST(PhotonTracing, LeavesOutWhatIsNotAskedFor) {
  const Scene scene = full_scene();
  ListSettings settings;
  settings.emitted = 5000;
  const PhotonLists all = trace(scene, "homogeneous", settings);
  settings.direct_collisions = false;
  settings.direct_hits = false;
  const PhotonLists indirect = trace(scene, "homogeneous", settings);
  EXPECT_LT(indirect.volume[0].size(), all.volume[0].size());
  EXPECT_LT(indirect.surface.size(), all.surface.size());
  EXPECT_EQ(indirect.ledger.collisions, all.ledger.collisions);
  for (const Photon& p : all.surface) EXPECT_NEAR(p.position.y, -1.0f, 1e-6f);  // the mirror keeps none
}

/// Notes what it is told.
class Notes : public PhotonRecorder {
 public:
  explicit Notes(const Box& box) : box_(box) {}
  std::unique_ptr<PhotonRecorder> part() const override { return std::make_unique<Notes>(box_); }
  void join(PhotonRecorder& part) override {
    auto& other = static_cast<Notes&>(part);
    numbers.insert(numbers.end(), other.numbers.begin(), other.numbers.end());
    track += other.track;
    tracks.merge(other.tracks);
    collisions.merge(other.collisions);
    collided_ += other.collided_;
  }
  void emitted(uint64_t number) override {
    numbers.push_back(number);
    tracks.add(track);
    collisions.add(collided_);
    track = collided_ = 0.0;
  }
  void flew(const Track& flown, const ArrivingPhoton&, Rng&) override {
    double t0 = 0.0, t1 = flown.interval.t1;
    clip_to_box(Vec3d(flown.ray.origin), Vec3d(flown.ray.direction), Vec3d(box_.lo), Vec3d(box_.hi), t0, t1);
    if (t1 > t0) track += flown.throughput.g * (t1 - t0);
  }
  void collided(const ArrivingPhoton& photon) override {
    if (glm::all(glm::lessThan(box_.lo, photon.state.ray.origin)) &&
        glm::all(glm::lessThan(photon.state.ray.origin, box_.hi)))
      collided_ += photon.state.throughput.g;
  }

  std::vector<uint64_t> numbers;  // of photons, in the order in which they were told of
  Moments tracks, collisions;     // W m and W in the box, of each photon but the last of a chunk
  double track = 0.0;

 private:
  Box box_;
  double collided_ = 0.0;
};

// In any box the fluence by the length of flights is that by collisions, in expectation: no kernel, no map.
TEST(PhotonTracing, TellsRecordersOfPhotonsInOrderAndOfFlightsAsOfCollisions) {
  const Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.5f), 0.8f), kSpot);
  const Medium& medium = scene.media[0];
  Notes notes({Vec3(-0.4f), Vec3(0.4f)});
  Progress silent("photons", 0, false);
  const Ledger ledger = trace_photons(scene, *make_distance_strategy({}), {.emitted = 200'000}, {&notes}, silent);
  ASSERT_EQ(notes.numbers.size(), ledger.emitted_count);
  for (uint64_t i = 0; i < notes.numbers.size(); ++i) ASSERT_EQ(notes.numbers[i], i);
  const double by_length = notes.tracks.mean() * medium.sigma_t.g, by_collisions = notes.collisions.mean();
  const double error = std::sqrt(notes.tracks.variance_of_mean() * medium.sigma_t.g * medium.sigma_t.g +
                                 notes.collisions.variance_of_mean());
  EXPECT_NEAR(by_length, by_collisions, 5.0 * error);  // false alarms: below 1e-6
  EXPECT_LT(error, 0.02 * by_collisions);
}

/// The fluence in a box times the root of the relative density, by channel, in W m over sigma_t: of passes of few
/// photons. By collisions alone its variance is finite, as that of the fluence itself would not be.
std::vector<Moments> thin_fluence(const Scene& scene, const std::string& strategy, float density_floor) {
  const Medium& medium = scene.media[0];
  const auto flies = make_distance_strategy({.strategy = strategy});
  return sample_moments(3, 2000, 17, [&](Rng& rng, double* out) {
    ListSettings settings;
    settings.seed = rng.bits();
    settings.emitted = 50;
    settings.density_floor = density_floor;
    const PhotonLists lists = list_photons(scene, *flies, settings);
    for (const Photon& photon : lists.volume[0])
      if (max_channel(glm::abs(photon.position)) < 0.6f)
        for (int c = 0; c < 3; ++c)
          out[c] += photon.power[c] * std::sqrt(relative_density(medium, medium.density(photon.position)));
  });
}

std::shared_ptr<const DensityGrid> sparse_grid() {
  return grid_over_box([](int x, int y, int z) { return std::pow(lattice_noise(x, y, z), 4.0); });
}

TEST(PhotonTracing, ADensityFloorKeepsTheFluence) {
  const Scene grey = boxed_medium(make_medium(sparse_grid(), Rgb(4.0f), 0.9f), kSpot);
  Medium dense = colourful(sparse_grid());
  dense.sigma_s *= 8.0f;
  dense.sigma_t *= 8.0f;
  const Scene colours = boxed_medium(dense, kSpot);
  for (const Scene* scene : {&grey, &colours})
    for (const char* strategy : {"regular", "delta", "decomposition"})
      expect_same_means(thin_fluence(*scene, strategy, 0.0f), thin_fluence(*scene, strategy, 0.15f), kFalseAlarms,
                        strategy);
}

TEST(PhotonTracing, ADensityFloorBoundsThePowers) {
  const Scene scene = boxed_medium(make_medium(sparse_grid(), Rgb(4.0f)), kSpot);
  const Medium& medium = scene.media[0];
  ListSettings settings;
  settings.emitted = 20000;
  for (const float asked : {0.05f, 0.9f}) {
    settings.density_floor = asked;
    const float floor = std::min(asked, static_cast<float>(medium.mean_density()) / medium.max_density());
    const PhotonLists lists = list_photons(scene, *make_distance_strategy({}), settings);
    int thin = 0;
    for (const Photon& photon : lists.volume[0]) {
      thin += relative_density(medium, medium.density(photon.position)) < floor;
      ASSERT_LE(photon.power.r, 1.001f * light_power(kSpot, scene.bounds).r / floor);
    }
    EXPECT_GT(thin, 500);
    EXPECT_NEAR(static_cast<double>(lists.ledger.floored), thin, 0.001 * thin);  // positions are rounded
  }
}

TEST(PhotonTracing, PhotonsThroughABoundaryStayDirect) {
  Medium medium =
      make_medium(nullptr, Rgb(100.0f), 1e-6f);  // all but black: every stored photon is at its first collision
  const Scene scene = boxed_medium(medium, kSpot);
  ListSettings settings;
  settings.emitted = 2000;
  EXPECT_GT(trace(scene, "homogeneous", settings).volume[0].size(), 500u);
  settings.direct_collisions = false;
  EXPECT_EQ(trace(scene, "homogeneous", settings).volume[0].size(), 0u);
}

TEST(PhotonTracing, PowerStaysEvenInColour) {
  // The channel mixture keeps the sum over channels as it was, flight by flight and collision by collision.
  const Scene scene =
      boxed_medium(colourful(grid_over_box([](int x, int y, int z) { return lattice_noise(x, y, z); })), kSpot);
  ListSettings settings;
  settings.emitted = 20000;
  for (const char* strategy : {"regular", "ray-march", "ray-march-adaptive", "delta", "delta-local", "decomposition"}) {
    const Ledger ledger = trace(scene, strategy, settings).ledger;
    EXPECT_NEAR(ledger.weights.largest, 1.0, 1e-4) << strategy;
    EXPECT_NEAR(ledger.weights.squares / ledger.weights.sum, 1.0, 1e-4) << strategy;  // so all are 1
    EXPECT_GT(ledger.weights.sum, 0.9 * settings.emitted) << strategy;
  }
}

TEST(PhotonTracing, CutsEndlessPathsAndCountsThem) {
  Medium medium = make_medium(nullptr, Rgb(5.0f), 1.0f);
  Scene scene;
  scene.media.push_back(medium);
  scene.world_medium = 0;
  scene.lights.push_back(PointLight{});
  scene.geometry.commit();
  finish(scene);
  ListSettings settings;
  settings.emitted = 50;
  settings.max_events = 500;
  const Ledger ledger = trace(scene, "homogeneous", settings).ledger;
  EXPECT_EQ(ledger.cut_count, 50u);
  EXPECT_NEAR(ledger.cut.r, ledger.emitted.r, 1e-6 * ledger.emitted.r);
}

/// Points of the sequence reach the draws that they are meant for: of 1024 photons one collides in each interval of
/// equal probability, and each absorbs or scatters into one interval of the second collision's direction. Random ones
/// leave more than a third of the intervals empty; rounded places may fall beyond the border of theirs.
TEST(PhotonTracing, DistancesAndDirectionsAreEvenByTheSequence) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(2.0f), 1.0f));
  scene.world_medium = 0;
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  for (const std::string strategy : {"homogeneous", "regular", "delta"}) {
    ListSettings settings;
    settings.emitted = 1024;
    settings.max_events = 2;
    settings.sequence = PhotonSequence::sobol;
    const std::vector<Photon> photons = trace(scene, strategy, settings).volume[0];
    ASSERT_EQ(photons.size(), 2 * 1024u);
    std::set<int> distances, heights;
    for (size_t i = 0; i < photons.size(); i += 2) {
      distances.insert(static_cast<int>(-1024.0 * std::expm1(-2.0 * glm::length(Vec3d(photons[i].position)))));
      const Vec3d flight = glm::normalize(Vec3d(photons[i + 1].position - photons[i].position));
      heights.insert(static_cast<int>(512.0 * (1.0 + flight.z)));
    }
    EXPECT_GT(distances.size(), 1000u) << strategy;
    if (strategy == "delta") continue;  // it asks whether a collision is real
    EXPECT_GT(heights.size(), 1000u) << strategy;
  }
}

}  // namespace
}  // namespace vpm
