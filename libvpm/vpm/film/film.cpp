// Sums of passes, and the errors estimated from them.
#include "vpm/film/film.h"

#include <fmt/format.h>
#include <cassert>
#include <functional>
#include <limits>
#include <utility>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

constexpr size_t kBlockValues = ExactSums::kCount;
constexpr size_t kBlockChunk = 32;    // blocks, of parallel work
constexpr size_t kPixelChunk = 4096;  // pixels, of parallel work

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

/// The values of an image from `first` to before `end`, then zeros.
ExactSums::Values values_of(const Image& image, size_t first, size_t end) {
  ExactSums::Values values{};
  for (size_t i = first; i < end; ++i) values[i - first] = value_at(image, i);
  return values;
}

void put(const ExactSums::Values& values, Image& image, size_t first, size_t end) {
  for (size_t i = first; i < end; ++i) value_at(image, i) = static_cast<float>(values[i - first]);
}

ExactSums::Values over(const ExactSums::Totals& sums, int n) {
  ExactSums::Values values;
  for (size_t i = 0; i < kBlockValues; ++i) values[i] = sums[i].value() / n;
  return values;
}

/// The variance of the mean of n numbers, from their sum and that of their squares.
double variance_of_mean_of(int n, const TwoDoubles& sum, const TwoDoubles& squares) {
  const double count = n, scale = count * count * (count - 1.0);
  return (TwoDoubles{count} * squares - sum * sum).value() / scale;
}

ExactSums::Values variances(int n, const ExactSums& of_values, const ExactSums& of_squares) {
  const ExactSums::Totals sums = of_values.totals(), squares = of_squares.totals();
  ExactSums::Values variances;
  for (size_t i = 0; i < kBlockValues; ++i) variances[i] = variance_of_mean_of(n, sums[i], squares[i]);
  return variances;
}

void merge_all(std::vector<ExactSums>& sums, const std::vector<ExactSums>& others) {
  assert(sums.size() == others.size());
  parallel_for_chunks(sums.size(), kBlockChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) sums[i].merge(others[i]);
  });
}

/// Calls add(sums, i) for each pixel, on all threads. Each chunk of pixels has sums of its own, joined in their order:
/// they are the same for any number of threads.
template <class Sums, class Add>
Sums sum_over_pixels(size_t pixels, const Add& add) {
  std::vector<Sums> parts(chunk_count(pixels, kPixelChunk));
  parallel_for_chunks(pixels, kPixelChunk, [&](size_t begin, size_t end, size_t chunk) {
    Sums part;
    for (size_t i = begin; i < end; ++i) add(part, i);
    parts[chunk] = part;
  });
  Sums all;
  for (const Sums& part : parts) all.merge(part);
  return all;
}

// --- What errors are divided by

/// The mean of the pixels around one; that pixel where it has no neighbour.
Rgbd mean_of_neighbours(const Image& image, int x, int y) {
  Rgbd sum(0.0);
  int count = 0;
  for (int v = std::max(0, y - 1); v <= std::min(image.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(image.width - 1, x + 1); ++u) {
      if (u == x && v == y) continue;
      sum += Rgbd(image.at(u, v));
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : Rgbd(image.at(x, y));
}

/// The least magnitude of the means over the up to three pixels on each of the four sides of one; infinite where it has
/// no neighbour.
Rgbd mean_of_darkest_side(const Image& image, int x, int y) {
  constexpr std::pair<int, int> kSides[] = {{-1, 0}, {0, -1}, {1, 0}, {0, 1}};
  Rgbd least(std::numeric_limits<double>::infinity());
  for (const auto& [right, down] : kSides) {
    Rgbd sum(0.0);
    int count = 0;
    for (int along = -1; along <= 1; ++along) {
      const int u = x + right + along * down, v = y + down + along * right;
      if (u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
      sum += Rgbd(image.at(u, v));
      ++count;
    }
    if (count > 0) least = glm::min(least, glm::abs(sum / static_cast<double>(count)));
  }
  return least;
}

/// What squares of errors of a pixel are divided by, as FilmErrors says; 0 in a channel that is black everywhere.
std::vector<Rgbd> relative_scales(const Image& means, const Image& variances) {
  const Rgbd channels = channel_means(means);
  std::vector<Rgbd> scales(means.pixels.size());
  parallel_for_chunks(scales.size(), kPixelChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      const auto x = static_cast<int>(i % means.width), y = static_cast<int>(i / means.width);
      const Rgbd own = glm::abs(Rgbd(means.pixels[i]));
      const Rgbd least = own - glm::sqrt(glm::max(Rgbd(0.0), Rgbd(variances.pixels[i])));
      const Rgbd of_all = glm::max(least, glm::min(own, glm::abs(mean_of_neighbours(means, x, y))));
      const Rgbd of_side = glm::max(least, glm::min(own, mean_of_darkest_side(means, x, y)));
      for (int c = 0; c < 3; ++c) scales[i][c] = relative_scale(std::sqrt(of_all[c] * of_side[c]), channels[c]);
    }
  });
  return scales;
}

double mean_over_channels(const Rgbd& squares, const Rgbd& scale) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
    if (scale[c] > 0.0) sum += squares[c] / scale[c];
  return sum / 3.0;
}

/// What variances of pixels sum to, over all pixels.
struct VarianceSums {
  Sum parts, squared_parts;     // relative, means over channels
  std::array<Sum, 3> channels;  // (W/(m^2 sr))^2

  void merge(const VarianceSums& other) {
    parts.merge(other.parts);
    squared_parts.merge(other.squared_parts);
    for (int c = 0; c < 3; ++c) channels[c].merge(other.channels[c]);
  }
};

VarianceSums sum_variances(const Image& variances, const std::vector<Rgbd>& scales) {
  return sum_over_pixels<VarianceSums>(scales.size(), [&](VarianceSums& sums, size_t i) {
    const Rgbd variance(variances.pixels[i]);
    const double part = mean_over_channels(variance, scales[i]);
    sums.parts.add(part);
    sums.squared_parts.add(part * part);
    for (int c = 0; c < 3; ++c) sums.channels[c].add(variance[c]);
  });
}

/// The relative variance of an error that all pixels have in common: what the means over the picture vary more than
/// they would if pixels were independent.
double variance_in_common(const VarianceSums& sums, double pixels, const Rgbd& of_channel_means, const Rgbd& channels) {
  Rgbd common;
  for (int c = 0; c < 3; ++c)
    common[c] = std::max(0.0, of_channel_means[c] - sums.channels[c].value() / (pixels * pixels));
  return mean_over_channels(common, channels * channels);
}

/// The mean over pixels, and by how much a squared error is off from it. An error is a nearly normal number, and its
/// square has a standard deviation of sqrt(2) times its mean: of each pixel by itself, and of what all have in common,
/// which is no more than the whole.
Estimated variance_part_of(const Image& variances, const std::vector<Rgbd>& scales, const Rgbd& of_channel_means,
                           const Rgbd& channels) {
  const VarianceSums sums = sum_variances(variances, scales);
  const auto pixels = static_cast<double>(scales.size());
  const double mean = sums.parts.value() / pixels, own = std::sqrt(sums.squared_parts.value()) / pixels;
  const double common = std::min(mean, variance_in_common(sums, pixels, of_channel_means, channels));
  return {mean, std::sqrt(2.0) * std::hypot(own, common)};
}

// --- Bias

using GroupMeans = std::array<Image, FilmSums::kGroups>;

/// The relative mean product of two groups' corrections.
double relative_product(const Image& a, const Image& b, const std::vector<Rgbd>& scales) {
  const auto sum = sum_over_pixels<Sum>(scales.size(), [&](Sum& part, size_t i) {
    part.add(mean_over_channels(Rgbd(a.pixels[i]) * Rgbd(b.pixels[i]), scales[i]));
  });
  return sum.value() / static_cast<double>(scales.size());
}

/// The mean of the products of all pairs of groups, and its jackknife over groups: from the means of the pairs without
/// each [Tukey1958].
Estimated mean_product(const std::vector<const Image*>& groups, const std::vector<Rgbd>& scales) {
  const size_t n = groups.size();
  if (n < 2) return {0.0, std::numeric_limits<double>::infinity()};
  double all = 0.0;
  std::vector<double> with(n, 0.0);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < i; ++j) {
      const double product = relative_product(*groups[i], *groups[j], scales);
      all += product;
      with[i] += product;
      with[j] += product;
    }
  const auto count = static_cast<double>(n);
  const double pairs = count * (count - 1.0) / 2.0;
  if (n < 3) return {all / pairs, std::numeric_limits<double>::infinity()};
  Moments without;
  for (const double of_group : with) without.add((all - of_group) / (pairs - (count - 1.0)));
  const double spread = without.variance() * (count - 1.0);  // the sum of squared deviations
  return {all / pairs, std::sqrt((count - 1.0) / count * spread)};
}

bool is_zero(const ExactSums& sums) { return sums.words().empty(); }

}  // namespace

size_t Film::blocks(int width, int height) {
  return chunk_count(3 * static_cast<size_t>(width) * static_cast<size_t>(height), kBlockValues);
}

Film::Film(int width, int height) : width_(width), height_(height) {
  const size_t count = blocks(width, height);
  sums_.values.resize(count);
  sums_.squares.resize(count);
  for (std::vector<ExactSums>& group : sums_.corrections) group.resize(count);
}

Film::Film(int width, int height, FilmSums sums) : width_(width), height_(height), sums_(std::move(sums)) {}

void Film::add(int pass, const Image& image, const Image& correction) {
  assert(image.width == width_ && image.height == height_ && pass >= 0);
  assert(correction.pixels.empty() || correction.pixels.size() == image.pixels.size());
  assert(!sums_.passes.overlaps({pass, pass + 1}));
  std::vector<ExactSums>& corrections = sums_.corrections[pass % kGroups];
  for_blocks(3 * image.pixels.size(), [&](size_t block, size_t first, size_t end) {
    const ExactSums::Values values = values_of(image, first, end);
    ExactSums::Values squares;
    for (size_t i = 0; i < kBlockValues; ++i) squares[i] = values[i] * values[i];  // of floats: exact in doubles
    sums_.values[block].add(values);
    sums_.squares[block].add(squares);
    if (!correction.pixels.empty()) corrections[block].add(values_of(correction, first, end));
  });
  const Rgbd means = channel_means(image), squares = means * means;
  sums_.channel_means.add({means.r, means.g, means.b, squares.r, squares.g, squares.b});
  sums_.passes.add({pass, pass + 1});
}

void Film::merge(const Film& other) {
  assert(width_ == other.width_ && height_ == other.height_);
  for (const PassRange& range : other.sums_.passes.ranges())
    if (sums_.passes.overlaps(range))
      throw InputError(fmt::format("films of the same passes do not add up: both have some of {} to {}", range.first,
                                   range.end - 1));
  for (const PassRange& range : other.sums_.passes.ranges()) sums_.passes.add(range);
  merge_all(sums_.values, other.sums_.values);
  merge_all(sums_.squares, other.sums_.squares);
  for (size_t g = 0; g < kGroups; ++g) merge_all(sums_.corrections[g], other.sums_.corrections[g]);
  sums_.channel_means.merge(other.sums_.channel_means);
}

Image Film::mean() const {
  Image image(width_, height_);
  const int n = std::max(1, passes());
  for_blocks(3 * image.pixels.size(), [&](size_t block, size_t first, size_t end) {
    put(over(sums_.values[block].totals(), n), image, first, end);
  });
  return image;
}

Image Film::variance_of_mean() const {
  assert(passes() > 1);
  Image image(width_, height_);
  for_blocks(3 * image.pixels.size(), [&](size_t block, size_t first, size_t end) {
    put(variances(passes(), sums_.values[block], sums_.squares[block]), image, first, end);
  });
  return image;
}

bool Film::shows_bias() const {
  for (const std::vector<ExactSums>& group : sums_.corrections)
    if (!std::all_of(group.begin(), group.end(), is_zero)) return true;
  return false;
}

FilmErrors Film::errors() const {
  assert(passes() > 1);
  FilmErrors errors;
  errors.variance = variance_of_mean();
  errors.bias = Image(width_, height_);
  const Image mean_of_passes = mean();
  const std::vector<Rgbd> scales = relative_scales(mean_of_passes, errors.variance);
  const ExactSums::Totals means = sums_.channel_means.totals();
  for (int c = 0; c < 3; ++c)
    errors.variance_of_channel_means[c] = variance_of_mean_of(passes(), means[c], means[c + 3]);
  errors.variance_part =
      variance_part_of(errors.variance, scales, errors.variance_of_channel_means, channel_means(mean_of_passes));
  if (!shows_bias()) return errors;
  GroupMeans groups;
  std::vector<const Image*> filled;
  for (int g = 0; g < kGroups; ++g) {
    const int n = sums_.passes.count_of(g, kGroups);
    if (n == 0) continue;
    groups[g] = Image(width_, height_);
    const float share = static_cast<float>(n) / static_cast<float>(passes());
    for_blocks(3 * scales.size(), [&](size_t block, size_t first, size_t end) {
      put(over(sums_.corrections[g][block].totals(), n), groups[g], first, end);
      for (size_t i = first; i < end; ++i) value_at(errors.bias, i) -= share * value_at(groups[g], i);
    });
    filled.push_back(&groups[g]);
  }
  errors.bias_part = mean_product(filled, scales);
  return errors;
}

}  // namespace vpm
