// The file: a line of its own kind, the line of identity, numbers as they stand in memory, and the checksum of all.
#include "vpm/input/checkpoint.h"

#include <fmt/format.h>
#include <cassert>
#include <fstream>
#include <sstream>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/fnv.h"

namespace vpm {
namespace {

constexpr const char* kKind = "vpm checkpoint of a render";
constexpr size_t kChecksum = 16;  // characters at the end

// Each number of a structure by itself: between them may stand bytes of no meaning. A structure that gains a number
// does not compile here until that is named.
void each_number(WalkCounters& counters, auto&& use) {
  auto& [lookups, bricks, nulls, violations, crossings, mismatches] = counters;
  use(lookups, bricks, nulls, violations, crossings, mismatches);
}
void each_number(WeightMoments& weights, auto&& use) {
  auto& [sum, squares, largest] = weights;
  use(sum, squares, largest);
}
void each_number(Ledger& ledger, auto&& use) {
  auto& [emitted_count, emitted, in_media, on_surfaces, escaped, cut, cut_count, imbalance, weights, collisions,
         surface_hits, floored, non_finite, walk] = ledger;
  use(emitted_count, emitted, in_media, on_surfaces, escaped, cut, cut_count, imbalance, collisions, surface_hits,
      floored, non_finite);
  each_number(weights, use);
  each_number(walk, use);
}
void each_number(EyeCounters& eye, auto&& use) {
  auto& [rays, steps, volume_queries, surface_queries, shadow_rays, gather_rays, lookups, misses, cut_paths, non_finite,
         weights, gather, walk] = eye;
  auto& [searches, visited, used, corrected, least_shares] = gather;
  use(rays, steps, volume_queries, surface_queries, shadow_rays, gather_rays, lookups, misses, cut_paths, non_finite,
      searches, visited, used, corrected, least_shares);
  each_number(weights, use);
  each_number(walk, use);
}
void each_number(RenderStatistics& statistics, auto&& use) {
  auto& [passes, guide, trace, build, eye_pass, ledger, volume, surface, caustic, guiding, points, merged, bytes,
         guide_bytes, volume_radius, surface_radius, eye] = statistics;
  use(passes, guide, trace, build, eye_pass, volume, surface, caustic, guiding, points, merged, bytes, guide_bytes,
      volume_radius, surface_radius);
  each_number(ledger, use);
  each_number(eye, use);
}

/// What stands before the film's pixels. The program's version is part of the identity, so the layout is its own.
struct Numbers {
  struct Half {
    int passes = 0;
    double mean_size = 0.0, size_squares = 0.0;
  };
  int width = 0, height = 0;
  Half halves[2];
  double seconds = 0.0;
  uint64_t discs = 0;  // of pixels: as many as these, or none
  RenderStatistics statistics;

  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  size_t bytes_of_pixel() const { return 6 * sizeof(Rgbd) + (discs > 0 ? sizeof(PixelDisc) : 0); }
};
void each_number(Numbers& numbers, auto&& use) {
  use(numbers.width, numbers.height, numbers.seconds);
  for (auto& [passes, mean_size, size_squares] : numbers.halves) use(passes, mean_size, size_squares);
  use(numbers.discs);
  each_number(numbers.statistics, use);
}

std::string checksum(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.digits();
}

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Takes bytes off the front.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}
  size_t left() const { return left_.size(); }
  void read(void* data, size_t size) {
    assert(size <= left());
    std::copy_n(left_.data(), size, static_cast<char*>(data));
    left_.remove_prefix(size);
  }
  template <class T>
  std::vector<T> values(size_t count) {
    std::vector<T> all(count);
    read(all.data(), count * sizeof(T));
    return all;
  }

 private:
  std::string_view left_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("cannot resume from '{}': {}", path.string(), why));
}

/// Numbers that a film can have been written with.
Numbers read_numbers(const std::filesystem::path& path, Reader& reader) {
  Numbers numbers;
  bool whole = true;
  each_number(numbers, [&](auto&... number) {
    ((whole = whole && sizeof number <= reader.left(), whole ? reader.read(&number, sizeof number) : void()), ...);
  });
  if (!whole || numbers.width < 1 || numbers.height < 1 || numbers.halves[0].passes < 0 ||
      numbers.halves[1].passes < 0 || (numbers.discs > 0 && numbers.discs != numbers.pixels()) ||
      reader.left() / numbers.bytes_of_pixel() != numbers.pixels() || reader.left() % numbers.bytes_of_pixel() != 0)
    refuse(path, "its numbers are none that a render writes");
  return numbers;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "there is no such file; render with --checkpoint to have one after each pass");
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

/// The second line.
std::string identity_in(const std::filesystem::path& path, const std::string& bytes) {
  const size_t kind = bytes.find('\n'), end = kind == std::string::npos ? kind : bytes.find('\n', kind + 1);
  if (end == std::string::npos || bytes.substr(0, kind) != kKind) refuse(path, "it is no checkpoint");
  return bytes.substr(kind + 1, end - kind - 1);
}

}  // namespace

std::string checkpoint_identity(const std::filesystem::path& path) { return identity_in(path, text_of(path)); }

void write_checkpoint(const std::filesystem::path& path, const std::string& identity, const RenderResult& result) {
  assert(identity.find('\n') == std::string::npos);
  Numbers numbers{result.film.width(), result.film.height(), {},
                  result.seconds,      result.discs.size(),  result.statistics};
  for (size_t h = 0; h < 2; ++h) {
    const PassMoments& half = result.film.halves()[h];
    numbers.halves[h] = {half.passes, half.mean_square, half.square_spread};
  }
  std::string bytes = fmt::format("{}\n{}\n", kKind, identity);
  each_number(numbers,
              [&](auto&... number) { (bytes.append(reinterpret_cast<const char*>(&number), sizeof number), ...); });
  for (const PassMoments& half : result.film.halves())
    for (const std::vector<Rgbd>* plane : {&half.mean, &half.squares, &half.products}) append(bytes, *plane);
  append(bytes, result.discs);
  write_text(path, bytes + checksum(bytes));
}

RenderResult read_checkpoint(const std::filesystem::path& path, const std::string& identity) {
  const std::string bytes = text_of(path);
  const std::string found = identity_in(path, bytes);
  const size_t end = std::string_view(kKind).size() + 1 + found.size();
  if (found != identity)
    refuse(path,
           fmt::format("it is of another render; remove it, or render again what it is of\n  file:   {}\n  asked:  {}",
                       found, identity));
  const size_t sum_at = bytes.size() - std::min(bytes.size() - end - 1, kChecksum);
  const std::string_view content = std::string_view(bytes).substr(0, sum_at);
  if (checksum(content) != bytes.substr(sum_at)) refuse(path, "it is damaged or not whole: its checksum is wrong");
  Reader reader(content.substr(end + 1));
  const Numbers numbers = read_numbers(path, reader);
  const size_t pixels = numbers.pixels();
  Film::Halves halves;
  for (size_t h = 0; h < 2; ++h) {
    const auto& [passes, mean_size, size_squares] = numbers.halves[h];
    halves[h] = {passes,
                 mean_size,
                 size_squares,
                 reader.values<Rgbd>(pixels),
                 reader.values<Rgbd>(pixels),
                 reader.values<Rgbd>(pixels)};
  }
  return {Film(numbers.width, numbers.height, std::move(halves)), numbers.statistics, numbers.seconds,
          reader.values<PixelDisc>(numbers.discs)};
}

}  // namespace vpm
