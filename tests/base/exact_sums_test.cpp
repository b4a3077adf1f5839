// Exact sums: integers where terms are integers, nothing lost where terms cancel, the same bits in any order.
#include "vpm/base/statistics/exact_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "vpm/base/rng.h"

namespace vpm {
namespace {

/// Of either sign, its magnitude evenly spread over the logarithms of `decades` around 1; a float, as films add them.
double wide(Rng& rng, double decades) {
  const double magnitude = std::pow(10.0, decades * (rng.uniform_double() - 0.5));
  return static_cast<float>(rng.uniform_double() < 0.5 ? -magnitude : magnitude);
}

std::vector<ExactSums::Values> wide_terms(int count, double decades, uint64_t seed) {
  std::vector<ExactSums::Values> terms(static_cast<size_t>(count));
  Rng rng(seed, 0, 0);
  for (ExactSums::Values& values : terms)
    for (double& value : values) value = wide(rng, decades);
  return terms;
}

void shuffle(std::vector<ExactSums::Values>& terms, Rng& rng) {
  for (size_t i = terms.size(); i > 1; --i) std::swap(terms[i - 1], terms[rng.bits() % i]);
}

ExactSums sum_of(const std::vector<ExactSums::Values>& terms) {
  ExactSums sums;
  for (const ExactSums::Values& values : terms) sums.add(values);
  return sums;
}

TEST(ExactSums, OfIntegersAreIntegers) {
  ExactSums sums;
  std::array<int64_t, ExactSums::kCount> exact{};
  Rng rng(1, 0, 0);
  for (int term = 0; term < 1000; ++term) {
    ExactSums::Values values;
    for (size_t i = 0; i < values.size(); ++i) {
      const auto units = static_cast<int64_t>(rng.bits() % (1ull << 42)) - (1ll << 41);
      exact[i] += units;
      values[i] = static_cast<double>(units) * 0x1p-20;
    }
    sums.add(values);
  }
  const ExactSums::Totals totals = sums.totals();
  for (size_t i = 0; i < exact.size(); ++i) {
    EXPECT_EQ(totals.high[i], static_cast<double>(exact[i]) * 0x1p-20);
    EXPECT_EQ(totals.low[i], 0.0);
  }
}

TEST(ExactSums, LoseNothingWhereTermsCancel) {
  std::vector<ExactSums::Values> terms = wide_terms(60, 70.0, 2);
  const ExactSums::Values left = terms[0];
  for (size_t term = 1; term < 60; ++term) {
    ExactSums::Values opposite = terms[term];
    for (double& value : opposite) value = -value;
    terms.push_back(opposite);
  }
  Rng rng(3, 0, 0);
  shuffle(terms, rng);
  const ExactSums::Totals totals = sum_of(terms).totals();
  for (size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(totals.high[i], left[i]);
    EXPECT_EQ(totals.low[i], 0.0);
  }
}

TEST(ExactSums, AreTheSameInAnyOrderAndGrouping) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<ExactSums::Values> terms = wide_terms(50, seed % 2 == 0 ? 60.0 : 3.0, seed);
    const ExactSums whole = sum_of(terms);
    Rng rng(seed, 1, 0);
    shuffle(terms, rng);
    std::vector<ExactSums> groups(1 + rng.bits() % 7);
    for (const ExactSums::Values& values : terms) groups[rng.bits() % groups.size()].add(values);
    ExactSums merged;
    for (const ExactSums& group : groups) merged.merge(group);
    EXPECT_EQ(merged, whole);
    EXPECT_EQ(ExactSums(whole.lowest_word(), {whole.words().begin(), whole.words().end()}), whole);
  }
}

TEST(ExactSums, OfOtherWordsMergeEitherWay) {
  const std::vector<ExactSums::Values> terms{
      {-1.0, 1.0, -0x1p-70}, {0x1p100, -0x1p100, 3.0}, {-0x1p-200, 0x1p-200, -5.0}, {0x1.8p40, -0x1.8p40, 0x1p90}};
  const ExactSums whole = sum_of(terms);
  for (const ExactSums::Values& first : terms)
    for (const ExactSums::Values& second : terms) {
      if (&first == &second) continue;
      ExactSums merged = sum_of({first});
      merged.merge(sum_of({second}));
      EXPECT_EQ(merged, sum_of({second, first}));
      for (const ExactSums::Values& other : terms)
        if (&other != &first && &other != &second) merged.merge(sum_of({other}));
      EXPECT_EQ(merged, whole);
    }
  EXPECT_EQ(whole.totals().high[0], 0x1p100 + 0x1.8p40);
}

TEST(ExactSums, AreReadToTwoDoubles) {
  ExactSums sums;
  for (const double term : {1.0, 0x1p-60, 0x1p-90}) sums.add({term, -term});
  for (const size_t i : {0u, 1u}) {
    const double sign = i == 0 ? 1.0 : -1.0;
    EXPECT_EQ(sums.totals()[i].high, sign);
    EXPECT_EQ(sums.totals()[i].low, sign * (0x1p-60 + 0x1p-90));
  }
}

TEST(ExactSums, TakeTheRoomThatTermsSpan) {
  ExactSums sums;
  sums.add({});
  EXPECT_TRUE(sums.words().empty());
  EXPECT_EQ(sums.totals().high[0], 0.0);
  sums.add({1.0, 1.5});  // bits 0 and -1: words 0 and -1, and that of the sign
  EXPECT_EQ(sums.lowest_word(), -1);
  EXPECT_EQ(sums.words().size(), 3 * ExactSums::kCount);
  sums.add({0x1p32});
  EXPECT_EQ(sums.words().size(), 4 * ExactSums::kCount);
  for (int bit = -320; bit < 320; ++bit) {
    ExactSums one;
    one.add({std::ldexp(1.0, bit)});
    EXPECT_EQ(one.words().size(), 2 * ExactSums::kCount) << bit;
    EXPECT_EQ(one.lowest_word(), (bit + 320) / 32 - 10) << bit;
    EXPECT_EQ(one.totals().high[0], std::ldexp(1.0, bit));
  }
}

TEST(ExactSums, TakeWhatFloatsAndTheirProductsCanBe) {
  const double largest = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
  ExactSums sums;
  sums.add({largest * largest, least * least, -largest, least});
  sums.add({least * least, -least * least, largest, least});
  const ExactSums::Totals totals = sums.totals();
  EXPECT_EQ(totals.high[0], largest * largest);
  EXPECT_EQ(totals.low[0], least * least);
  EXPECT_EQ(totals.high[1], 0.0);
  EXPECT_EQ(totals.high[2], 0.0);
  EXPECT_EQ(totals.high[3], 2.0 * least);
}

TEST(ExactSums, RefuseWhatTheyCannotHold) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double term : {infinity, -infinity, std::nan(""), 0x1p320, -0x1p400, 0x1p-321, 0x1.8p-320, 5e-324})
    EXPECT_THROW(ExactSums().add({0.0, term}), std::domain_error) << term;
  EXPECT_THROW(ExactSums().add({0x1p300, 5e-324}), std::domain_error);
  for (const double term : {0x1.8p319, 0x1p-320, -0x1.8p-319}) EXPECT_NO_THROW(ExactSums().add({0.0, term})) << term;
  const auto words = [](size_t count) { return std::vector<uint32_t>(count); };
  EXPECT_NO_THROW(ExactSums(-10, words(2 * ExactSums::kCount)));
  EXPECT_THROW(ExactSums(1, {}), std::domain_error);
  EXPECT_THROW(ExactSums(0, words(ExactSums::kCount)), std::domain_error);
  EXPECT_THROW(ExactSums(0, words(2 * ExactSums::kCount + 1)), std::domain_error);
  EXPECT_THROW(ExactSums(-11, words(2 * ExactSums::kCount)), std::domain_error);
  EXPECT_THROW(ExactSums(9, words(3 * ExactSums::kCount)), std::domain_error);
  EXPECT_THROW(ExactSums(std::numeric_limits<int>::max(), words(2 * ExactSums::kCount)), std::domain_error);
}

TEST(TwoDoubles, KeepWhatOneDoubleLoses) {
  const TwoDoubles third{1.0 / 3.0}, tiny{0x1p-80};
  EXPECT_EQ(((TwoDoubles{1.0} + tiny) - TwoDoubles{1.0}).value(), 0x1p-80);
  // 1/3 is rounded down by 2^-54 / 3: three times it is 1 less 2^-54.
  EXPECT_EQ((third * TwoDoubles{3.0} - TwoDoubles{1.0}).value(), -0x1p-54);
  const TwoDoubles more = TwoDoubles{1.0} + TwoDoubles{0x1p-60};
  EXPECT_EQ((more * more - TwoDoubles{1.0}).value(), 0x1p-59);
}

}  // namespace
}  // namespace vpm
