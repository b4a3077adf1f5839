// Terms cut into words, and carries between these. Loops run over the sums side by side, so that compilers can
// vectorise them.
#include "vpm/base/exact_sums.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace vpm {
namespace {

constexpr size_t kCount = ExactSums::kCount;
constexpr int kWords = ExactSums::kHighestWord - ExactSums::kLowestWord + 1;
constexpr double kWord = 0x1p32;  // units of a word in one of the next

/// 2^(32 word), 1 <= |word| <= 31.
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

using Slice = std::array<int64_t, kCount>;

/// Takes the whole parts off numbers below 2^32 and multiplies what is left by 2^32. Is there any?
bool cut(ExactSums::Values& rest, Slice& whole) {
  constexpr double kMantissa = 0x1.8p52;  // added to an integer it leaves that as its lowest bits
  uint64_t left = 0;
  for (size_t i = 0; i < kCount; ++i) {
    const double part = std::trunc(rest[i]);
    whole[i] = std::bit_cast<int64_t>(part + kMantissa) - std::bit_cast<int64_t>(kMantissa);
    rest[i] = (rest[i] - part) * kWord;
    left |= std::bit_cast<uint64_t>(rest[i]) << 1;
  }
  return left != 0;
}

/// Adds to the words of one weight, and leaves what goes over to the next.
void add_to(uint32_t* words, const int64_t* terms, Slice& carry) {
  for (size_t i = 0; i < kCount; ++i) {
    const int64_t sum = static_cast<int64_t>(words[i]) + terms[i] + carry[i];
    words[i] = static_cast<uint32_t>(sum);
    carry[i] = sum >> 32;
  }
}

}  // namespace

ExactSums::ExactSums(int lowest_word, std::vector<uint32_t> words) : lowest_(lowest_word), words_(std::move(words)) {
  const bool empty = words_.empty() && lowest_ == 0;
  const size_t planes = words_.size() / kCount;
  const bool whole = words_.size() % kCount == 0 && planes >= 2 && planes <= kWords + 1;
  if (!empty && !(whole && lowest_ >= kLowestWord && sign_word() <= kHighestWord + 1))
    throw std::domain_error("these are no words of exact sums");
}

/// Makes room for words from `lowest` to before `sign_word`.
void ExactSums::cover(int lowest, int sign_word) {
  if (words_.empty()) {
    lowest_ = lowest;
    words_.assign(static_cast<size_t>(sign_word - lowest + 1) * kCount, 0);
    return;
  }
  if (lowest < lowest_) {
    words_.insert(words_.begin(), static_cast<size_t>(lowest_ - lowest) * kCount, 0);
    lowest_ = lowest;
  }
  while (this->sign_word() < sign_word) {
    const size_t last = words_.size() - kCount;
    words_.resize(words_.size() + kCount);
    for (size_t i = 0; i < kCount; ++i)
      words_[last + kCount + i] = static_cast<uint32_t>(static_cast<int32_t>(words_[last + i]) >> 31);
  }
}

void ExactSums::add(const Values& terms) {
  const uint64_t largest = largest_bits(terms);
  if (largest == 0) return;
  if (largest >= std::bit_cast<uint64_t>(weight(kHighestWord + 1)))
    throw std::domain_error("terms of exact sums must be finite and below 2^320");
  const int highest = std::max(word_of(std::bit_cast<double>(largest)), kLowestWord);
  std::array<Slice, kWords> slices;
  const double scale = weight(-highest);
  Values rest;
  for (size_t i = 0; i < kCount; ++i) rest[i] = terms[i] * scale;
  int lowest = highest;
  while (cut(rest, slices[static_cast<size_t>(highest - lowest)])) {
    if (lowest == kLowestWord) throw std::domain_error("terms of exact sums must be multiples of 2^-320");
    --lowest;
  }
  cover(lowest, highest + 1);
  Slice carry{};
  constexpr Slice kNothing{};
  for (int word = lowest; word <= sign_word(); ++word)
    add_to(plane(word), word <= highest ? slices[static_cast<size_t>(highest - word)].data() : kNothing.data(), carry);
}

void ExactSums::merge(const ExactSums& other) {
  if (other.words_.empty()) return;
  cover(other.lowest_, other.sign_word());
  Slice carry{}, terms{};
  for (int word = other.lowest_; word <= sign_word(); ++word) {
    if (word < other.sign_word())
      std::copy_n(other.plane(word), kCount, terms.begin());
    else if (word == other.sign_word())
      for (size_t i = 0; i < kCount; ++i) terms[i] = static_cast<int32_t>(other.plane(word)[i]);
    else
      terms.fill(0);
    add_to(plane(word), terms.data(), carry);
  }
}

ExactSums::Totals ExactSums::totals() const {
  Totals totals{};
  if (words_.empty()) return totals;
  // Of magnitudes, whose words add up without cancelling.
  std::array<std::array<uint32_t, kCount>, kWords + 1> magnitudes;
  std::array<uint32_t, kCount> flip;
  std::array<uint64_t, kCount> carry;
  for (size_t i = 0; i < kCount; ++i) {
    flip[i] = static_cast<uint32_t>(static_cast<int32_t>(plane(sign_word())[i]) >> 31);
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
