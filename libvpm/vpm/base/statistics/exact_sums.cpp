// Terms cut into words, and carries between these. Loops run over the sums side by side, so that compilers can
// vectorise them.
#include "vpm/base/statistics/exact_sums.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace vpm {
namespace {

constexpr size_t kCount = ExactSums::kCount;
constexpr int kWords = ExactSums::kHighestWord - ExactSums::kLowestWord + 1;

/// 2^(32 word), |word| < 32.
double weight(int word) { return std::bit_cast<double>(static_cast<uint64_t>(1023 + 32 * word) << 52); }

/// The word that the highest bit of a positive number stands in.
int word_of(double magnitude) {
  const int exponent = static_cast<int>(std::bit_cast<uint64_t>(magnitude) >> 52) - 1023;
  return exponent >= 0 ? exponent / 32 : -((31 - exponent) / 32);
}

/// The bits of the largest magnitude: those of an infinity or a NaN where there is one.
uint64_t largest_bits(const ExactSums::Values& values) {
  int64_t largest = 0;
  for (const double value : values)
    largest = std::max(largest, static_cast<int64_t>(std::bit_cast<uint64_t>(value) << 1 >> 1));
  return static_cast<uint64_t>(largest);
}

using WordsOfSums = std::array<uint32_t, kCount>;  // one of each number

constexpr double kMantissa = 0x1p52;  // added to an integer from 0 to 2^52, it leaves that as its lowest bits

/// Takes multiples of `weight` off numbers >= 0 that are below 2^32 times that; to the multiples kMantissa is added. Is
/// there anything left?
bool cut(ExactSums::Values& rest, double weight, ExactSums::Values& multiples) {
  const double inverse = 1.0 / weight;
  uint64_t left = 0;
  for (size_t i = 0; i < kCount; ++i) {
    const double multiple = std::trunc(rest[i] * inverse);
    multiples[i] = multiple + kMantissa;
    rest[i] -= multiple * weight;
    left |= std::bit_cast<uint64_t>(rest[i]);
  }
  return left != 0;
}

/// Adds to the words of one weight other(i) each, and leaves what goes over to the next: 0 or 1.
void add_to(uint32_t* words, const auto& other, WordsOfSums& carry) {
  for (size_t i = 0; i < kCount; ++i) {
    const uint32_t word = other(i), sum = words[i] + word, with_carry = sum + carry[i];
    carry[i] = static_cast<uint32_t>(sum < word) | static_cast<uint32_t>(with_carry < sum);
    words[i] = with_carry;
  }
}

/// All bits of a word that is below 0, none of another.
uint32_t sign_of(uint32_t word) { return static_cast<uint32_t>(static_cast<int32_t>(word) >> 31); }

}  // namespace

ExactSums::ExactSums(int lowest_word, std::vector<uint32_t> words) : lowest_(lowest_word), words_(std::move(words)) {
  const bool empty = words_.empty() && lowest_ == 0;
  const size_t planes = words_.size() / kCount;
  const bool whole = words_.size() % kCount == 0 && planes >= 2 && planes <= kWords + 1;
  const bool in_range = lowest_ >= kLowestWord && lowest_ <= kHighestWord;  // before sign_word(), which could overflow
  if (!empty && !(whole && in_range && sign_word() <= kHighestWord + 1))
    throw std::domain_error("these are no words of exact sums");
}

/// Makes room for words from `lowest` to before `sign_word`, and no more.
void ExactSums::cover(int lowest, int sign_word) {
  if (!words_.empty()) {
    if (lowest >= lowest_ && sign_word <= this->sign_word()) return;
    lowest = std::min(lowest, lowest_);
    sign_word = std::max(sign_word, this->sign_word());
  }
  std::vector<uint32_t> words(static_cast<size_t>(sign_word - lowest + 1) * kCount);
  if (!words_.empty()) {
    auto end = std::copy(words_.begin(), words_.end(), words.begin() + (lowest_ - lowest) * static_cast<int>(kCount));
    for (; end != words.end(); ++end) *end = sign_of(*(end - kCount));
  }
  words_ = std::move(words);
  lowest_ = lowest;
}

void ExactSums::add(const Values& terms) {
  const uint64_t largest = largest_bits(terms);
  if (largest == 0) return;
  if (largest >= std::bit_cast<uint64_t>(weight(kHighestWord + 1)))
    throw std::domain_error("terms of exact sums must be finite and below 2^320");
  const int highest = std::max(word_of(std::bit_cast<double>(largest)), kLowestWord);
  std::array<Values, kWords> multiples;  // from the highest word to the lowest
  Values rest;
  for (size_t i = 0; i < kCount; ++i) rest[i] = std::fabs(terms[i]);
  int lowest = highest;
  while (cut(rest, weight(lowest), multiples[static_cast<size_t>(highest - lowest)])) {
    if (lowest == kLowestWord) throw std::domain_error("terms of exact sums must be multiples of 2^-320");
    --lowest;
  }
  cover(lowest, highest + 1);
  // The two's complement of what is below 0: all bits the other way, and 1 more, which is the first carry.
  WordsOfSums negative, carry;
  for (size_t i = 0; i < kCount; ++i) {
    negative[i] = static_cast<uint32_t>(std::bit_cast<int64_t>(terms[i]) >> 63);
    carry[i] = negative[i] & 1u;
  }
  for (int word = lowest; word <= highest; ++word) {
    const Values& digits = multiples[static_cast<size_t>(highest - word)];
    const auto flipped = [&](size_t i) {
      return static_cast<uint32_t>(std::bit_cast<uint64_t>(digits[i])) ^ negative[i];
    };
    add_to(plane(word), flipped, carry);
  }
  for (int word = highest + 1; word <= sign_word(); ++word)
    add_to(
        plane(word), [&](size_t i) { return negative[i]; }, carry);
}

void ExactSums::merge(const ExactSums& other) {
  if (other.words_.empty()) return;
  cover(other.lowest_, other.sign_word());
  WordsOfSums carry{};
  for (int word = other.lowest_; word <= other.sign_word(); ++word) {
    const uint32_t* others = other.plane(word);
    add_to(
        plane(word), [&](size_t i) { return others[i]; }, carry);
  }
  const uint32_t* signs = other.plane(other.sign_word());
  for (int word = other.sign_word() + 1; word <= sign_word(); ++word)
    add_to(
        plane(word), [&](size_t i) { return sign_of(signs[i]); }, carry);
}

ExactSums::Totals ExactSums::totals() const {
  Totals totals{};
  if (words_.empty()) return totals;
  // Of magnitudes, whose words add up without cancelling.
  std::array<WordsOfSums, kWords + 1> magnitudes;
  WordsOfSums flip;
  std::array<uint64_t, kCount> carry;
  for (size_t i = 0; i < kCount; ++i) {
    flip[i] = sign_of(plane(sign_word())[i]);
    carry[i] = flip[i] & 1u;
  }
  for (int word = lowest_; word <= sign_word(); ++word)
    for (size_t i = 0; i < kCount; ++i) {
      const uint64_t sum = carry[i] + (plane(word)[i] ^ flip[i]);
      magnitudes[static_cast<size_t>(word - lowest_)][i] = static_cast<uint32_t>(sum);
      carry[i] = sum >> 32;
    }
  for (int word = sign_word(); word >= lowest_; --word)
    for (size_t i = 0; i < kCount; ++i) {
      const double digits = magnitudes[static_cast<size_t>(word - lowest_)][i] * weight(word);
      const TwoDoubles sum = exact_sum(totals.high[i], digits);
      totals.high[i] = sum.high;
      totals.low[i] += sum.low;
    }
  for (size_t i = 0; i < kCount; ++i) {
    const TwoDoubles sum = exact_sum(totals.high[i], totals.low[i]);
    const double sign = flip[i] == 0 ? 1.0 : -1.0;
    totals.high[i] = sign * sum.high;
    totals.low[i] = sign * sum.low;
  }
  return totals;
}

}  // namespace vpm
