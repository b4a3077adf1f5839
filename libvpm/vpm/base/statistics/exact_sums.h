// Sums of doubles without rounding: the same bits whatever the order and the grouping of their terms. And numbers of
// twice the precision of a double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vpm {

/// A number as the unevaluated sum of two doubles, about 106 bits [Dekker1971]: |low| is at most half a unit in the
/// last place of high.
struct TwoDoubles {
  double high = 0.0, low = 0.0;

  double value() const { return high + low; }
};

/// a + b without rounding error, whichever is larger [Knuth1997, sec. 4.2.2, theorem B].
inline TwoDoubles exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}
/// To a relative 2^-104 [Joldes2017, algorithm 6].
inline TwoDoubles operator+(const TwoDoubles& a, const TwoDoubles& b) {
  const TwoDoubles high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
  const TwoDoubles sum = exact_sum(high.high, high.low + low.high);
  return exact_sum(sum.high, sum.low + low.low);
}
inline TwoDoubles operator-(const TwoDoubles& a, const TwoDoubles& b) { return a + TwoDoubles{-b.high, -b.low}; }
/// To a relative 2^-102 or so; without error where both are single doubles.
inline TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b) {
  const double product = a.high * b.high, rest = std::fma(a.high, b.high, -product);
  return exact_sum(product, rest + (a.high * b.low + a.low * b.high));
}

/// kCount sums side by side, as integers of any length in units of a power of 2 [Kulisch1986]. Each is the exact sum of
/// its terms, and the whole state a function of the set of terms alone: equal sets of terms compare equal.
///
/// Numbers are kept in two's complement, in words of 32 bits. The words of all sums start at the lowest bit that any
/// term has set and end beyond the highest, so that terms of like magnitudes take little room: 4 bytes for each 32 bits
/// that terms span, and 4 for the sign and what sums have grown by. Terms are finite, multiples of 2^-320 and below
/// 2^320 in magnitude (floats, their products and squares are), fewer than 2^31 for each sum.
class ExactSums {
 public:
  static constexpr size_t kCount = 128;
  static constexpr int kLowestWord = -10, kHighestWord = 9;  // in units of 2^(32 word)
  using Values = std::array<double, kCount>;
  struct Totals {
    Values high{}, low{};

    TwoDoubles operator[](size_t i) const { return {high[i], low[i]}; }
  };

  ExactSums() = default;
  /// What lowest_word() and words() were. Throws std::domain_error where they cannot have been those of any sums.
  ExactSums(int lowest_word, std::vector<uint32_t> words);

  /// Adds a term to each sum. Throws std::domain_error where one is no such number.
  void add(const Values& terms);
  /// Adds sums of other terms.
  void merge(const ExactSums& other);
  /// The sums, rounded to two doubles.
  Totals totals() const;

  /// The state: the words of all sums of one weight, then those of the next weight, the last ones signed; none where
  /// all terms were 0.
  int lowest_word() const { return lowest_; }
  std::span<const uint32_t> words() const { return words_; }
  bool operator==(const ExactSums&) const = default;

 private:
  /// One beyond the highest word that a term has reached.
  int sign_word() const { return lowest_ + static_cast<int>(words_.size() / kCount) - 1; }
  uint32_t* plane(int word) { return words_.data() + static_cast<size_t>(word - lowest_) * kCount; }
  const uint32_t* plane(int word) const { return words_.data() + static_cast<size_t>(word - lowest_) * kCount; }
  void cover(int lowest, int sign_word);

  int lowest_ = 0;
  std::vector<uint32_t> words_;
};

}  // namespace vpm
