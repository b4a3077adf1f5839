// Sums of passes, and lines through them.
#include "vpm/render/film.h"

#include <fmt/format.h>
#include <cassert>
#include <functional>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

constexpr size_t kBlockValues = ExactSums::kCount;
constexpr size_t kBlockChunk = 32;  // blocks, of parallel work

/// Calls work(block, first, end) for each block of an image's values, on all threads.
void for_blocks(size_t values, const std::function<void(size_t block, size_t first, size_t end)>& work) {
  const size_t blocks = chunk_count(values, kBlockValues);
  parallel_for_chunks(blocks, kBlockChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t block = begin; block < end; ++block)
      work(block, block * kBlockValues, std::min(values, (block + 1) * kBlockValues));
  });
}

float& value_at(Image& image, size_t i) { return image.pixels[i / 3][static_cast<int>(i % 3)]; }
float value_at(const Image& image, size_t i) { return image.pixels[i / 3][static_cast<int>(i % 3)]; }

void put(const ExactSums::Values& values, Image& image, size_t first, size_t end) {
  for (size_t i = first; i < end; ++i) value_at(image, i) = static_cast<float>(values[i - first]);
}

/// n sum(x y) - sum(x) sum(y): n^2 times the covariance of n pairs.
double scaled_covariance(int n, const TwoDoubles& xy, const TwoDoubles& x, const TwoDoubles& y) {
  return (TwoDoubles{static_cast<double>(n)} * xy - x * y).value();
}

/// What the passes of a block tell.
struct BlockTotals {
  std::array<ExactSums::Totals, 2> values;  // of the halves

  BlockTotals(const FilmSums& sums, size_t block)
      : values{sums.halves[0].values[block].totals(), sums.halves[1].values[block].totals()} {}
  TwoDoubles sum(size_t i) const { return values[0][i] + values[1][i]; }

  ExactSums::Values means(int n) const {
    ExactSums::Values means;
    for (size_t i = 0; i < kBlockValues; ++i) means[i] = sum(i).value() / n;
    return means;
  }
  /// Of the means of n passes.
  ExactSums::Values variances(int n, const ExactSums& of_squares) const {
    const ExactSums::Totals squares = of_squares.totals();
    const double count = n, scale = count * count * (count - 1.0);
    ExactSums::Values variances;
    for (size_t i = 0; i < kBlockValues; ++i) variances[i] = scaled_covariance(n, squares[i], sum(i), sum(i)) / scale;
    return variances;
  }
};

/// What tells the bias of the whole mean from a half's passes: the slope of values over relative squares, times the
/// mean of these over all passes.
struct BiasLine {
  int passes = 0;
  TwoDoubles squares;   // sum
  double spread = 0.0;  // passes^2 times the variance of squares; 0: there is no slope, and no bias shows
  double mean = 0.0;

  ExactSums::Values biases(const ExactSums& of_products, const ExactSums::Totals& values) const {
    ExactSums::Values biases{};
    if (spread == 0.0) return biases;
    const ExactSums::Totals products = of_products.totals();
    for (size_t i = 0; i < kBlockValues; ++i)
      biases[i] = scaled_covariance(passes, products[i], values[i], squares) * (mean / spread);
    return biases;
  }
};

std::array<BiasLine, 2> bias_lines(const FilmSums& sums) {
  std::array<BiasLine, 2> lines;
  TwoDoubles all;
  for (int h = 0; h < 2; ++h) {
    const ExactSums::Totals squares = sums.halves[h].squares.totals();
    const int n = sums.passes.count_of(h);
    lines[h] = {n, squares[0], scaled_covariance(n, squares[1], squares[0], squares[0])};
    all = all + squares[0];
  }
  for (BiasLine& line : lines) line.mean = all.value() / std::max(1, sums.passes.count());
  if (lines[0].spread == 0.0 || lines[1].spread == 0.0) lines[0].spread = lines[1].spread = 0.0;
  return lines;
}

void merge_all(std::vector<ExactSums>& sums, const std::vector<ExactSums>& others) {
  assert(sums.size() == others.size());
  parallel_for_chunks(sums.size(), kBlockChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) sums[i].merge(others[i]);
  });
}

}  // namespace

size_t Film::blocks(int width, int height) {
  return chunk_count(3 * static_cast<size_t>(width) * static_cast<size_t>(height), kBlockValues);
}

Film::Film(int width, int height) : width_(width), height_(height) {
  const size_t count = blocks(width, height);
  sums_.squares.resize(count);
  for (FilmSums::Half& half : sums_.halves)
    for (std::vector<ExactSums>* sums : {&half.values, &half.products}) sums->resize(count);
}

Film::Film(int width, int height, FilmSums sums) : width_(width), height_(height), sums_(std::move(sums)) {}

void Film::add(int pass, const Image& image, float relative_square) {
  assert(image.width == width_ && image.height == height_ && pass >= 0);
  assert(!sums_.passes.overlaps({pass, pass + 1}));
  FilmSums::Half& half = sums_.halves[pass % 2];
  for_blocks(3 * image.pixels.size(), [&](size_t block, size_t first, size_t end) {
    // Products of floats are exact in double precision.
    ExactSums::Values values{}, squares, products;
    for (size_t i = first; i < end; ++i) values[i - first] = value_at(image, i);
    for (size_t i = 0; i < kBlockValues; ++i) {
      squares[i] = values[i] * values[i];
      products[i] = values[i] * double{relative_square};
    }
    half.values[block].add(values);
    half.products[block].add(products);
    sums_.squares[block].add(squares);
  });
  half.squares.add({relative_square, double{relative_square} * relative_square});
  sums_.passes.add({pass, pass + 1});
}

void Film::merge(const Film& other) {
  assert(width_ == other.width_ && height_ == other.height_);
  for (const PassRange& range : other.sums_.passes.ranges())
    if (sums_.passes.overlaps(range))
      throw InputError(fmt::format("films of the same passes do not add up: both have some of {} to {}", range.first,
                                   range.end - 1));
  for (const PassRange& range : other.sums_.passes.ranges()) sums_.passes.add(range);
  merge_all(sums_.squares, other.sums_.squares);
  for (size_t h = 0; h < 2; ++h) {
    FilmSums::Half& half = sums_.halves[h];
    const FilmSums::Half& others = other.sums_.halves[h];
    half.squares.merge(others.squares);
    merge_all(half.values, others.values);
    merge_all(half.products, others.products);
  }
}

Image Film::mean() const {
  Image image(width_, height_);
  const int n = std::max(1, passes());
  for_blocks(3 * image.pixels.size(), [&](size_t block, size_t first, size_t end) {
    put(BlockTotals(sums_, block).means(n), image, first, end);
  });
  return image;
}

Image Film::variance_of_mean() const {
  assert(passes() > 1);
  Image image(width_, height_);
  for_blocks(3 * image.pixels.size(), [&](size_t block, size_t first, size_t end) {
    put(BlockTotals(sums_, block).variances(passes(), sums_.squares[block]), image, first, end);
  });
  return image;
}

bool Film::shows_bias() const { return bias_lines(sums_)[0].spread > 0.0; }

FilmErrors Film::errors() const {
  assert(passes() > 1);
  FilmErrors errors{Image(width_, height_), Image(width_, height_)};
  const int n = passes();
  const auto& [a, b] = sums_.halves;
  const std::array<BiasLine, 2> lines = bias_lines(sums_);
  const Image means = mean();
  const Rgbd channels = channel_means(means);
  const size_t values = 3 * means.pixels.size();
  std::vector<std::array<double, 2>> parts(sums_.squares.size());  // of blocks: due to variance, due to bias
  for_blocks(values, [&](size_t block, size_t first, size_t end) {
    const BlockTotals totals(sums_, block);
    const ExactSums::Values of_mean = totals.means(n), variances = totals.variances(n, sums_.squares[block]);
    const ExactSums::Values of_a = lines[0].biases(a.products[block], totals.values[0]);
    const ExactSums::Values of_b = lines[1].biases(b.products[block], totals.values[1]);
    ExactSums::Values biases;
    for (size_t i = 0; i < kBlockValues; ++i) biases[i] = 0.5 * (of_a[i] + of_b[i]);
    put(variances, errors.variance, first, end);
    put(biases, errors.bias, first, end);
    for (size_t i = 0; i < end - first; ++i) {
      const double scale = relative_scale(of_mean[i], channels[static_cast<int>((first + i) % 3)]);
      if (scale == 0.0) continue;  // a black channel is exact
      parts[block][0] += variances[i] / scale;
      parts[block][1] += of_a[i] * of_b[i] / scale;
    }
  });
  for (const auto& [variance, bias] : parts) {
    errors.variance_part += variance / static_cast<double>(values);
    errors.bias_part += bias / static_cast<double>(values);
  }
  return errors;
}

}  // namespace vpm
