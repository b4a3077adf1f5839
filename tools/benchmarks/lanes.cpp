// Numbers side by side against one after the other.
#include <cmath>
#include <vector>

#include "benchmarks/bench.h"
#include "vpm/base/below.h"
#include "vpm/base/exp_negative.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/medium/phase/phase.h"
#include "vpm/photon/kernel.h"

namespace vpm::bench {
namespace {

constexpr size_t kPhotons = 20'000, kNumbers = 1 << 20;

struct PhotonThere {
  Vec3 place, travel;  // m, unit
};

/// What a photon brings to a ray that it lies beside: of a float and a Vec3, or of Floats and Floats3.
template <class Real, class Place>
Real light_beside(const PhotonThere& photon, const Place& origin, const Place& along) {
  const HenyeyGreenstein phase{0.5f};
  const Place offset = photon.place - origin;
  const Real t = dot(offset, along);
  const Place across = offset - t * along;
  const Real q = dot(across, across) * 4.0f;
  const Real light = phase.value(photon.travel, -1.0f * along) * exp_negative(-0.5f * t) *
                     kernel_profile<KernelKind::epanechnikov, 2>(q);
  return select((q < 1.0f) & (t >= 0.0f) & (t < 3.0f), light, 0.0f);
}

std::vector<PhotonThere> photons_of_room() {
  Rng rng(1, rng_stream(RngUse::probe, 2), 0);
  std::vector<PhotonThere> photons(kPhotons);
  for (PhotonThere& photon : photons)
    photon = {Vec3(rng.uniform(), rng.uniform(), 3.0f * rng.uniform()), uniform_sphere(rng.uniform2())};
  return photons;
}

/// Rays of a block of pixels.
Ray ray_of(size_t lane) {
  const auto i = static_cast<float>(lane % 4), j = static_cast<float>(lane / 4);
  return {Vec3(0.4f + 0.05f * i, 0.4f + 0.05f * j, 0.0f), glm::normalize(Vec3(0.01f * i, 0.01f * j, 1.0f))};
}

double beside_rays_at_once(const std::vector<PhotonThere>& photons) {
  Floats3 origin, along;
  for (size_t lane = 0; lane < kBlock; ++lane) {
    origin.set(lane, ray_of(lane).origin);
    along.set(lane, ray_of(lane).direction);
  }
  Floats sum;
  for (const PhotonThere& photon : photons) sum += light_beside<Floats>(photon, origin, along);
  double all = 0.0;
  for (size_t lane = 0; lane < kBlock; ++lane) all += double{sum[lane]};
  return all;
}

double beside_one_ray_after_the_other(const std::vector<PhotonThere>& photons) {
  double all = 0.0;
  for (size_t lane = 0; lane < kBlock; ++lane) {
    const Ray ray = ray_of(lane);
    float sum = 0.0f;
    for (const PhotonThere& photon : photons) sum += light_beside<float>(photon, ray.origin, ray.direction);
    all += double{sum};
  }
  return all;
}

std::vector<float> numbers_below_one() {
  Rng rng(1, rng_stream(RngUse::probe, 3), 0);
  std::vector<float> numbers(kNumbers);
  for (float& number : numbers) number = rng.uniform();
  return numbers;
}

double exponentials(const std::vector<float>& numbers) {
  Floats sum;
  for (size_t i = 0; i < kNumbers; i += kBlock) sum += exp_negative(-8.0f * lanes_of(&numbers[i]));
  double all = 0.0;
  for (size_t lane = 0; lane < kBlock; ++lane) all += double{sum[lane]};
  return all;
}

double exponentials_of_the_library(const std::vector<float>& numbers) {
  double all = 0.0;
  for (const float number : numbers) all += double{std::exp(-8.0f * number)};
  return all;
}

uint32_t pick_one_by_one(const float* numbers, uint32_t count, float limit, uint32_t first, float* found,
                         uint32_t* which) {
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; ++i) {
    if (!(numbers[i] < limit)) continue;
    found[kept] = numbers[i];
    which[kept++] = first + i;
  }
  return kept;
}

template <class Pick>
double picked(const std::vector<float>& numbers, const Pick& pick) {
  float found[kBlock];
  uint32_t which[kBlock];
  double sum = 0.0;
  for (uint32_t i = 0; i < kNumbers; i += kBlock) {
    const uint32_t kept = pick(&numbers[i], kBlock, 0.3f, i, found, which);
    if (kept > 0) sum += which[kept - 1] + double{found[0]};
  }
  return sum;
}

}  // namespace

void measure_lanes(Bench& bench, const Sizes&) {
  const std::vector<PhotonThere> photons = photons_of_room();
  const std::vector<float> numbers = numbers_below_one();
  const auto compare = [&](const char* title, const char* item, size_t items, std::vector<Alternative> alternatives) {
    bench.compare({title, item, static_cast<double>(items), 1e-4, Clock::processor, std::move(alternatives)});
  };
  bench.note("Width of a register", kRegisterBytes, "bytes");
  compare("Photons beside the rays of 16 pixels", "photon and ray", kPhotons * kBlock,
          {{"vpm, a photon and all rays", [&] { return beside_rays_at_once(photons); }},
           {"vpm, one ray after the other", [&] { return beside_one_ray_after_the_other(photons); }}});
  compare("Exponentials", "number", kNumbers,
          {{"vpm, exp_negative of lanes", [&] { return exponentials(numbers); }},
           {"the C library's exp", [&] { return exponentials_of_the_library(numbers); }}});
  compare("Picking numbers below a limit", "number", kNumbers,
          {{"vpm, append_below", [&] { return picked(numbers, append_below); }},
           {"one by one", [&] { return picked(numbers, pick_one_by_one); }}});
}

}  // namespace vpm::bench
