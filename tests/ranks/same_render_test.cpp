// What rank 0 tells: the render, and what came of it.
#include "vpm/ranks/messages.h"

#include <gtest/gtest.h>

#include "input/expectations.h"
#include "ranks/ranks_in_memory.h"
#include "vpm/base/rng.h"
#include "vpm/render/named_fields.h"

namespace vpm {
namespace {

RenderJob job_of_seed(uint64_t seed) {
  RenderJob job;
  job.settings.seed = seed;
  return job;
}

TEST(SameRender, IsToldByRank0AndCheckedByTheOthers) {
  Post post(3);
  RankInMemory leader(post, 0), other(post, 1), third(post, 2);
  send_render(leader, identity_of(job_of_seed(7)));
  RenderJob same = job_of_seed(7), differs = job_of_seed(8);
  EXPECT_NO_THROW(adopt_render(same, receive_render(other)));
  const std::string words = message_of([&] { adopt_render(differs, receive_render(third)); });
  EXPECT_NE(words.find("render.seed: 7 of rank 0, 8 here"), std::string::npos) << words;
}

/// What is left to choose is chosen by rank 0 alone, and taken by the others.
TEST(SameRender, WhatRank0ChoseIsTaken) {
  Post post(2);
  RankInMemory leader(post, 0), other(post, 1);
  RenderJob led = job_of_seed(7), job = job_of_seed(7);
  for (RenderJob* each : {&led, &job}) each->automatic.default_radii = {"integrator.volume.radius"};
  led.choices = {{"integrator.volume.radius", "0.25", ""}};
  led.settings.volume.radius = 0.25f;
  send_render(leader, identity_of(led));
  adopt_render(job, receive_render(other));
  EXPECT_EQ(job.settings.volume.radius, led.settings.volume.radius);
  ASSERT_EQ(job.choices.size(), 1u);
  EXPECT_EQ(job.choices[0].value, "0.25");
}

TEST(SameRender, AnotherMessageIsAnotherProgram) {
  Post post(2);
  RankInMemory leader(post, 0), other(post, 1);
  leader.send(1, "good morning");
  EXPECT_THROW(receive_render(other), std::runtime_error);
  leader.send(1, "good night");
  EXPECT_THROW(receive_result(other), FieldError);
}

TEST(SameRender, TheResultIsToldToTheLastBitWithItsErrors) {
  RenderResult result{Film(4, 3), {}, 2.5, {}};
  result.layers.emplace_back(4, 3);
  Rng rng(3, 0, 0);
  for (int pass = 0; pass < 9; ++pass) {
    Image image(4, 3), correction(4, 3);
    for (Rgb& pixel : image.pixels) pixel = Rgb(rng.uniform());
    for (Rgb& pixel : correction.pixels) pixel = Rgb(0.1f * rng.uniform());
    result.film.add(pass, image, correction);
    result.layers[0].add(pass, image);
  }
  result.statistics.eye.rays = 108;
  result.errors = result.film.errors();
  Post post(2);
  RankInMemory leader(post, 0), other(post, 1);
  send_result(leader, result);
  const RenderResult told = receive_result(other);
  EXPECT_TRUE(told.film.sums() == result.film.sums());
  ASSERT_EQ(told.layers.size(), 1u);
  EXPECT_TRUE(told.layers[0].sums() == result.layers[0].sums());
  EXPECT_EQ(told.seconds, 2.5);
  EXPECT_EQ(told.statistics.eye.rays, 108u);
  ASSERT_TRUE(told.errors);
  EXPECT_EQ(told.errors->variance.pixels[5].g, result.errors->variance.pixels[5].g);
}

}  // namespace
}  // namespace vpm
