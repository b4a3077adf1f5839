// What follow() shows its visitors and asks of them; each walk beside the same one by hand.
#include "vpm/path/follow.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "support/scenes.h"

namespace vpm {
namespace {

/// Mirrors that take nothing, facing each other at x = -1 and x = 1.
Scene facing_mirrors() {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1, -9, -9), Vec3d(0, 18, 0), Vec3d(0, 0, 18)), Mirror{});
  add_shape(scene, quad_mesh(Vec3d(1, -9, -9), Vec3d(0, 18, 0), Vec3d(0, 0, 18)), Mirror{});
  scene.geometry.commit();
  return scene;
}

/// Glass in a box of coloured fog: what photons and paths from the eye make of it differs.
Scene glass_in_fog() {
  Medium fog = make_medium(nullptr, Rgb(0.9f, 1.4f, 2.0f));
  fog.sigma_s = Rgb(0.85f, 0.8f, 0.7f) * fog.sigma_t;
  Scene scene;
  scene.media.push_back(fog);
  const Interface outer{0, kVacuum}, inner{kVacuum, 0};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &outer);
  add_shape(scene, SphereShape{Vec3(0.1f), 0.6f}, Dielectric{1.5f}, &inner);
  scene.geometry.commit();
  return scene;
}

/// What a visitor is shown and asked, in its order.
struct Recorder {
  int most = kNoEventLimit;        // events after which it ends the path
  float flight = kInfinity;        // m, its limit
  float kept = 1.0f;               // of the power, by what it does in see()
  std::vector<EventKind> kinds{};  // of the events seen
  std::vector<PathState> froms{}, ats{}, cuts{};
  int scatterings = 0;

  bool see(const Event& event, const PathState& from, PathState& at) {
    kinds.push_back(event.kind);
    froms.push_back(from);
    ats.push_back(at);
    at.throughput *= kept;
    return static_cast<int>(kinds.size()) < most;
  }
  bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng) {
    ++scatterings;
    return scatter_photon(scene, event, at, rng);
  }
  float limit(const PathState&) const { return flight; }
  void cut(const PathState& at) { cuts.push_back(at); }
};

const PathState kStart{{Vec3(0.0f), Vec3(1, 0, 0)}, kVacuum, Rgb(1.0f)};

/// Follows kStart between the mirrors.
Recorder between_mirrors(Recorder recorder, int max_events, int events = 0) {
  const Scene scene = facing_mirrors();
  const auto strategy = make_distance_strategy({});
  WalkCounters counters;
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  follow({scene, *strategy, counters, max_events}, kStart, rng, recorder, events);
  return recorder;
}

TEST(Follow, ShowsEachEventBeforeItsOutcomeAndCutsAfterTheLast) {
  const Recorder seen = between_mirrors({}, 5);
  ASSERT_EQ(seen.kinds, std::vector<EventKind>(5, EventKind::surface));
  for (size_t i = 0; i < 5; ++i) {
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    EXPECT_EQ(seen.ats[i].ray.origin.x, side);
    EXPECT_EQ(seen.ats[i].ray.direction, Vec3(side, 0, 0));  // as it arrives
    EXPECT_EQ(seen.froms[i].ray.direction, Vec3(side, 0, 0));
    EXPECT_NEAR(seen.froms[i].ray.origin.x, i == 0 ? 0.0f : -side, 1e-5f);
  }
  EXPECT_EQ(seen.scatterings, 5);
  ASSERT_EQ(seen.cuts.size(), 1u);
  EXPECT_EQ(seen.cuts[0].ray.direction, Vec3(-1, 0, 0));  // as it would go on
}

TEST(Follow, CountsTheEventsMetBefore) {
  EXPECT_EQ(between_mirrors({}, 5, 3).kinds.size(), 2u);
  const Recorder none = between_mirrors({}, 5, 5);
  EXPECT_TRUE(none.kinds.empty());
  EXPECT_EQ(none.cuts.size(), 1u);
}

TEST(Follow, EndsWhereTheVisitorSaysSoOrThePowerIsGone) {
  const Recorder ended = between_mirrors({.most = 3}, 5);
  EXPECT_EQ(ended.kinds.size(), 3u);
  EXPECT_EQ(ended.scatterings, 2);
  EXPECT_TRUE(ended.cuts.empty());
  const Recorder black = between_mirrors({.kept = 0.0f}, 5);
  EXPECT_EQ(black.kinds.size(), 1u);
  EXPECT_EQ(black.scatterings, 0);
  EXPECT_TRUE(black.cuts.empty());
}

TEST(Follow, FlightsEndAtTheLimitAndGoOnAsTheyWere) {
  const Recorder seen = between_mirrors({.flight = 0.375f}, 4);
  EXPECT_EQ(seen.kinds, (std::vector{EventKind::limit, EventKind::limit, EventKind::surface, EventKind::limit}));
  EXPECT_EQ(seen.ats[0].ray.origin.x, 0.375f);
  EXPECT_EQ(seen.froms[1].ray.origin.x, 0.375f);
  EXPECT_EQ(seen.ats[1].ray.origin.x, 0.75f);
  EXPECT_EQ(seen.scatterings, 1);  // at the mirror alone
}

TEST(Follow, AnEscapeIsTheLastEventSeen) {
  Scene scene;
  scene.geometry.commit();
  const auto strategy = make_distance_strategy({});
  WalkCounters counters;
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  Recorder seen;
  follow({scene, *strategy, counters}, kStart, rng, seen);
  EXPECT_EQ(seen.kinds, std::vector{EventKind::escape});
  EXPECT_EQ(seen.scatterings, 0);
  EXPECT_TRUE(seen.cuts.empty());
}

/// A path's events by hand: where, and with what power.
using Track = std::vector<std::pair<Vec3, Rgb>>;

Track track_by_hand(const Scene& scene, const DistanceStrategy& strategy, bool from_eye, Rng& rng) {
  Track track;
  PathState state{{Vec3(-2.0f, 0.2f, 0.1f), Vec3(1, 0, 0)}, kVacuum, Rgb(1.0f)};
  WalkCounters counters;
  for (;;) {
    const Event event = next_event(scene, strategy, state, rng, counters);
    track.emplace_back(state.ray.origin, state.throughput);
    if (event.kind == EventKind::escape) return track;
    if (event.kind == EventKind::collision) {
      if (!scatter_in_medium(scene.media[state.medium].properties(state.ray.origin), state, rng)) return track;
      continue;
    }
    Scatter scatter;
    if (!scatter_at_surface(scene, event.hit, state, rng, scatter)) return track;
    state.throughput *= from_eye ? scatter.radiance_scale : scatter.flux_scale;
  }
}

/// Photons and paths from the eye draw the same random numbers in the same order as a loop over next_event() that says
/// how each of them scatters: equal to the last bit, and so is the random number after the last.
TEST(Follow, IsTheLoopOverEventsWrittenByHand) {
  const Scene scene = glass_in_fog();
  const auto strategy = make_distance_strategy({});
  const PathState start{{Vec3(-2.0f, 0.2f, 0.1f), Vec3(1, 0, 0)}, kVacuum, Rgb(1.0f)};
  size_t events = 0;
  for (uint64_t i = 0; i < 500; ++i)
    for (const bool from_eye : {false, true}) {
      Rng by_hand(1, rng_stream(RngUse::test, 0), i), followed = by_hand;
      const Track expected = track_by_hand(scene, *strategy, from_eye, by_hand);
      Track track;
      const auto see = [&](const Event&, const PathState&, const PathState& at) {
        track.emplace_back(at.ray.origin, at.throughput);
        return true;
      };
      WalkCounters counters;
      const Walk walk{scene, *strategy, counters};
      if (from_eye)
        follow(walk, start, followed, EyeVisitor{see});
      else
        follow(walk, start, followed, PhotonVisitor{see});
      ASSERT_EQ(track, expected) << i;
      ASSERT_EQ(followed.bits(), by_hand.bits()) << i;
      events += track.size();
    }
  EXPECT_GT(events, 3000u);
}

/// Splits every path in two at each of its first events, flying no further than 0.3 m at a time in fog: as photon
/// tracing may.
class Splitter {
 public:
  Splitter(const Walk& walk, Rng& rng) : walk_(walk), rng_(rng) {}

  void trace(const PathState& start) {
    follow(walk_, start, rng_, *this);
    while (!waiting_.empty()) {
      Branch branch = waiting_.back();
      waiting_.pop_back();
      events_ = branch.events;
      if (branch.event.kind == EventKind::limit || scatter(walk_.scene, branch.event, branch.state, rng_))
        follow(walk_, branch.state, rng_, *this, branch.events);
    }
  }

  bool see(const Event& event, const PathState&, PathState& at) {
    ++events_;
    if (event.kind == EventKind::escape) {
      escaped += at.throughput.r;
      ++paths;
    } else if (events_ <= 4) {
      at.throughput *= 0.5f;
      waiting_.push_back({at, event, events_});
    }
    return true;
  }
  static bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng) {
    return scatter_photon(scene, event, at, rng);
  }
  static float limit(const PathState& from) { return from.medium == kVacuum ? kInfinity : 0.3f; }
  void cut(const PathState& at) { cut_power += at.throughput.r; }

  double escaped = 0.0, cut_power = 0.0;  // W
  int paths = 0;                          // that escaped

 private:
  struct Branch {
    PathState state;
    Event event;
    int events = 0;
  };

  const Walk& walk_;
  Rng& rng_;
  std::vector<Branch> waiting_;
  int events_ = 0;
};

/// Fog that absorbs nothing, in an open box: all of the power that halves are made of escapes or is cut, exactly.
TEST(Follow, SplitPathsKeepAllPower) {
  const Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.5f), 1.0f), PointLight{Vec3(0.0f), Rgb(1.0f)});
  const auto strategy = make_distance_strategy({});
  WalkCounters counters;
  double cut = 0.0;
  for (uint64_t i = 0; i < 100; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 0), i);
    const Walk walk{scene, *strategy, counters, 30};
    Splitter splitter(walk, rng);
    splitter.trace({{Vec3(0.0f), Vec3(1, 0, 0)}, 0, Rgb(1.0f)});
    EXPECT_EQ(splitter.escaped + splitter.cut_power, 1.0) << i;
    EXPECT_LE(splitter.paths, 16);
    cut += splitter.cut_power;
  }
  EXPECT_GT(cut, 0.0);
  EXPECT_LT(cut, 100.0);
}

}  // namespace
}  // namespace vpm
