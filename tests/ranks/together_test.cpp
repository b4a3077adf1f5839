// Ranks that render together give the bits of one process, end where it ends, and leave nothing behind.
#include "vpm/ranks/together.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <set>
#include <thread>

#include "ranks/ranks_in_memory.h"
#include "vpm/base/cancel.h"
#include "vpm/base/rng.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/pieces.h"
#include "vpm/ranks/messages.h"
#include "vpm/render/named_fields.h"

namespace vpm {
namespace {

constexpr int kWidth = 6, kHeight = 5;

/// A pass of random values with a layer and counts, of a few milliseconds, so that ranks overtake each other.
Pass some_pass(int number) {
  Rng rng(17, static_cast<uint64_t>(number), 0);
  Pass pass(kWidth, kHeight);
  Image layer(kWidth, kHeight);
  for (size_t i = 0; i < pass.image.pixels.size(); ++i) {
    pass.image.pixels[i] = Rgb(1.0f + rng.uniform(), 1e6f * rng.uniform(), rng.uniform());
    pass.correction.pixels[i] = Rgb(0.01f * rng.uniform());
    layer.pixels[i] = Rgb(rng.uniform());
  }
  pass.layers = {layer};
  pass.statistics.eye.rays = 30;
  pass.statistics.ledger.imbalance.add(Rgbd(rng.uniform_double()));
  pass.statistics.last_volume_radius = 1.0f / static_cast<float>(number + 1);
  std::this_thread::sleep_for(std::chrono::microseconds(rng.uniform() < 0.2f ? 4000 : 400));
  return pass;
}

PassMaker maker() {
  return {[](int number, const RenderResult&, const PassProgress&) { return some_pass(number); }, 1};
}

RenderResult nothing() { return {Film(kWidth, kHeight), {}, 0.0, {}}; }

/// The render of so many ranks.
RenderResult together(int ranks, const StopRule& until, RenderResult begun = nothing(), const RunControl& control = {},
                      const PassMaker& of_leader = maker()) {
  Post post(ranks);
  std::vector<std::thread> others;
  for (int rank = 1; rank < ranks; ++rank)
    others.emplace_back([&post, rank] {
      RankInMemory self(post, rank);
      make_passes(self, maker());
    });
  struct JoinAll {
    std::vector<std::thread>& threads;
    ~JoinAll() {
      for (std::thread& each : threads) each.join();
    }
  };
  RenderResult result = nothing();
  {
    const JoinAll joined{others};
    RankInMemory leader(post, 0);
    result = lead_passes(leader, until, of_leader, std::move(begun), control);
  }
  EXPECT_TRUE(post.empty()) << "a message is left";
  return result;
}

RenderResult alone(const StopRule& until) { return run_passes(until, maker(), nothing(), {}); }

void expect_same(const RenderResult& a, const RenderResult& b) {
  EXPECT_EQ(a.film.sums(), b.film.sums());
  ASSERT_EQ(a.layers.size(), 1u);
  EXPECT_EQ(a.layers[0].sums(), b.layers[0].sums());
  EXPECT_EQ(a.statistics.eye.rays, b.statistics.eye.rays);
  EXPECT_EQ(a.statistics.ledger.imbalance.standard_error(), b.statistics.ledger.imbalance.standard_error())
      << "sums in order";
  EXPECT_EQ(a.statistics.last_volume_radius, b.statistics.last_volume_radius) << "that of the last pass";
}

TEST(Together, AnyNumberOfRanksGiveTheBitsOfOneProcess) {
  const StopRule until{.passes = 41};
  const RenderResult one = alone(until);
  for (const int ranks : {2, 3, 4, 8}) expect_same(together(ranks, until), one);
}

TEST(Together, EndWhereTheErrorOfOneProcessEnds) {
  const double error = 1.02 * highest_error(alone({.passes = 29}));
  const StopRule until{.error = error};
  const RenderResult one = alone(until);
  EXPECT_GT(one.film.passes(), 9);
  for (const int ranks : {2, 5}) expect_same(together(ranks, until), one);
}

TEST(Together, GoOnWithAPieceThatHasPassesAlready) {
  const StopRule piece{.passes = 20, .first = 30};
  RenderResult begun = alone({.passes = 4, .first = 30});
  expect_same(together(3, piece, std::move(begun)), alone(piece));
}

TEST(Together, RenderForATime) {
  const RenderResult result = together(4, {.seconds = 0.3});
  const int passes = result.film.passes();
  EXPECT_GE(passes, 1);
  EXPECT_EQ(result.film.sums().passes.ranges(), (std::vector<PassRange>{{0, passes}}));
  expect_same(result, alone({.passes = passes}));
}

TEST(Together, TellEachPassInOrder) {
  std::vector<int> told;
  const RunControl control{ProgressMode::never,
                           [&](const RenderResult& so_far) { told.push_back(so_far.film.passes()); }};
  together(4, {.passes = 9}, nothing(), control);
  EXPECT_EQ(told, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

// As where a signal came: another rank may be gone, and nobody waits for it.
TEST(Together, AStopWaitsForNobody) {
  Post post(2);
  RankInMemory leader(post, 0), gone(post, 1);
  gone.send(0, "a");  // asks for a number, and is never heard of again
  std::atomic<bool> stop{false}, given{false};
  const RunControl control{ProgressMode::never, [&](const RenderResult& so_far) { stop = so_far.film.passes() == 3; }};
  // The leader's own passes wait until the other rank has given its one, whose number is 0 or 1, and end after three.
  const PassMaker slow{[&](int number, const RenderResult&, const PassProgress&) {
                         for (; !given || number > 3; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
                           cancellation_point();
                         return some_pass(number);
                       },
                       1};
  std::thread other([&] {  // makes the one pass that it is told to
    const std::string order = wait_for_message(gone).bytes;
    gone.send(0, "p" + order.substr(1) + "\n" + bytes_of(some_pass(std::stoi(order.substr(1)))));
    given = true;
  });
  const CancelScope scope(stop);
  const RenderResult result = lead_passes(leader, {.passes = 100}, slow, nothing(), control);
  other.join();
  EXPECT_EQ(result.film.passes(), 3);
}

TEST(Together, WhatTheMakerThrowsComesOut) {
  const PassMaker broken{
      [](int, const RenderResult&, const PassProgress&) -> Pass { throw std::domain_error("broken"); }, 1};
  EXPECT_THROW(together(3, {.passes = 50}, nothing(), {}, broken), std::domain_error);
}

TEST(Together, WhatTheMakerOfAnotherRankThrowsComesOutThere) {
  Post post(2);
  RankInMemory other(post, 1);
  post.send(0, 1, "m0");
  const PassMaker broken{
      [](int, const RenderResult&, const PassProgress&) -> Pass { throw std::domain_error("broken"); }, 1};
  EXPECT_THROW(make_passes(other, broken), std::domain_error);
}

TEST(Together, RadiiOfPixelsAreRefused) {
  Post post(2);
  RankInMemory leader(post, 0);
  RenderSettings settings;
  settings.radii = RadiusSchedule::per_pixel;
  EXPECT_THROW(lead_render(leader, Scene{}, settings, nothing(), {}), SettingError);
}

TEST(PassBytes, ComeBackToTheLastBit) {
  Pass pass = some_pass(5);
  pass.found = {7, 1u << 31, 0};
  const std::string bytes = bytes_of(pass);
  const Pass back = pass_of(bytes);
  EXPECT_EQ(bytes_of(back), bytes);
  EXPECT_EQ(back.image.width, kWidth);
  EXPECT_EQ(std::memcmp(back.image.pixels.data(), pass.image.pixels.data(), 30 * sizeof(Rgb)), 0);
  EXPECT_EQ(back.found, pass.found);
  EXPECT_EQ(back.layers.size(), 1u);
  for (const size_t length : {size_t{0}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(pass_of(std::string_view(bytes).substr(0, length)), FieldError);
}

}  // namespace
}  // namespace vpm
