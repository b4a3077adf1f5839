// The procedural fields: within their bounds, empty at the faces of their box, the same on every machine; noise against
// its own definition.
#include "vpm/medium/grid/procedural.h"

#include <gtest/gtest.h>
#include <cstring>

#include "vpm/base/rng.h"

namespace vpm {
namespace {

Vec3 random_point(Rng& rng) { return {rng.uniform(), rng.uniform(), rng.uniform()}; }

TEST(Noise, GradientIsTheDerivativeOfTheValue) {
  Rng rng(1, 1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = 20.0f * random_point(rng) - 10.0f;
    const NoiseSample here = gradient_noise(p, 5);
    for (int a = 0; a < 3; ++a) {
      constexpr float kStep = 0x1p-7f;
      Vec3 step(0.0f);
      step[a] = kStep;
      const float slope = (gradient_noise(p + step, 5).value - gradient_noise(p - step, 5).value) / (2.0f * kStep);
      EXPECT_NEAR(here.gradient[a], slope, 5e-3f);
    }
  }
}

TEST(Noise, GradientNoiseVanishesAtLatticePointsAndIsSymmetric) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 100000;
  Rng rng(1, 1, 2);
  for (int i = 0; i < kCount; ++i) {
    const Vec3 p = 200.0f * random_point(rng) - 100.0f;
    EXPECT_EQ(gradient_noise(glm::floor(p), 7).value, 0.0f);
    const double value = gradient_noise(p, 7).value;
    EXPECT_LT(std::abs(value), 1.1);
    sum += value;
    squares += value * value;
  }
  // Neighbouring points are correlated within 8e6 cells only: the mean of 1e5 strays beyond 5 standard errors once in
  // 2e6 seeds.
  EXPECT_LT(std::abs(sum), 5.0 * std::sqrt(squares));
  EXPECT_NEAR(std::sqrt(squares / kCount), 0.27, 0.05);
}

TEST(Noise, CurlHasNoDivergence) {
  Rng rng(1, 1, 3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = 20.0f * random_point(rng);
    constexpr float kStep = 0x1p-6f;
    float divergence = 0.0f;
    for (int a = 0; a < 3; ++a) {
      Vec3 step(0.0f);
      step[a] = kStep;
      divergence += (curl_noise(p + step, 3)[a] - curl_noise(p - step, 3)[a]) / (2.0f * kStep);
    }
    EXPECT_NEAR(divergence, 0.0f, 0.06f);  // single derivatives reach 10
  }
}

TEST(Noise, ValueNoiseIsTrilinearBetweenLatticeValues) {
  const Vec3i corner(-3, 4, 11);
  EXPECT_FLOAT_EQ(value_noise(Vec3(corner), 9), lattice_value(corner, 9));
  const float half = 0.5f * (lattice_value(corner, 9) + lattice_value(corner + Vec3i(0, 1, 0), 9));
  EXPECT_FLOAT_EQ(value_noise(Vec3(corner) + Vec3(0.0f, 0.5f, 0.0f), 9), half);
}

TEST(Procedural, FieldsStayWithinTheirBounds) {
  Rng rng(1, 1, 4);
  for (const ProceduralField& field : procedural_fields()) {
    if (field.grid == "density") {
      EXPECT_EQ(find_procedural_field(field.name), &field);
    }
    const float unit = field.grid == "temperature" ? 2000.0f : 1.0f;  // K
    float peak = 0.0f;
    for (int i = 0; i < 20000; ++i) {
      const float value = field.value(random_point(rng)) / unit;
      ASSERT_GE(value, 0.0f) << field.name;
      ASSERT_LE(value, 1.0f) << field.name;
      peak = std::max(peak, value);
    }
    EXPECT_GT(peak, 0.8f) << field.name;
  }
  EXPECT_EQ(find_procedural_field("fog"), nullptr);
}

TEST(Procedural, SmokeAndCloudEndBeforeTheFacesOfTheirBox) {
  Rng rng(1, 1, 5);
  for (const char* name : {"smoke", "cloud"}) {
    const ProceduralField* field = find_procedural_field(name);
    for (int i = 0; i < 6000; ++i) {
      Vec3 p = random_point(rng);
      p[i % 3] = i % 2 ? 0.0f : 1.0f;
      ASSERT_EQ(field->value(p), 0.0f) << name;
    }
  }
}

TEST(Procedural, SmokeWidensAsItRises) {
  const ProceduralField* smoke = find_procedural_field("smoke");
  Rng rng(1, 1, 6);
  const auto filled = [&](float y) {
    int count = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 p = random_point(rng);
      count += smoke->value(Vec3(p.x, y + 0.1f * (p.y - 0.5f), p.z)) > 0.1f;
    }
    return count;
  };
  const int low = filled(0.1f);
  const int high = filled(0.6f);
  EXPECT_GT(low, 4);
  EXPECT_GT(high, 2 * low);
}

TEST(Procedural, TheSimpleOnesAreWhatTheySay) {
  const auto value = [](const char* name, const Vec3& p) { return find_procedural_field(name)->value(p); };
  EXPECT_FLOAT_EQ(value("constant", Vec3(0.3f)), 1.0f);
  EXPECT_FLOAT_EQ(value("ramp", Vec3(0.25f, 0.9f, 0.1f)), 0.25f);
  EXPECT_FLOAT_EQ(value("checker", Vec3(0.1f)), 1.0f);
  EXPECT_FLOAT_EQ(value("checker", Vec3(0.3f, 0.1f, 0.1f)), 0.0f);
  EXPECT_FLOAT_EQ(value("checker", Vec3(1.0f)), 0.0f);  // belongs to the last cube, (3, 3, 3)
  EXPECT_FLOAT_EQ(value("gaussian", Vec3(0.5f)), 1.0f);
  EXPECT_FLOAT_EQ(value("gaussian", Vec3(0.625f, 0.5f, 0.5f)), std::exp(-0.5f));
}

/// A hash of the bits of a field's values on a small lattice.
uint64_t fingerprint(const ProceduralField& field) {
  uint64_t hash = 0xcbf29ce484222325ull;
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        const float value = field.value((Vec3(x, y, z) + 0.5f) / 24.0f);
        uint32_t bits;
        std::memcpy(&bits, &value, sizeof(bits));
        hash = (hash ^ bits) * 0x100000001b3ull;
      }
  return hash;
}

TEST(Procedural, TheSameBitsOnEveryMachine) {
  EXPECT_EQ(fingerprint(*find_procedural_field("smoke")), 7155574032273632649u);
  EXPECT_EQ(fingerprint(*find_procedural_field("cloud")), 10986687425473002440u);
  EXPECT_EQ(fingerprint(*find_procedural_field("random")), 11466403359304859396u);
}

}  // namespace
}  // namespace vpm
