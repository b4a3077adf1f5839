// The file: a line of its own kind, the line of identity, then numbers as they stand in memory.
#include "input/checkpoint.h"

#include <fmt/format.h>
#include <cassert>
#include <fstream>
#include <sstream>
#include <type_traits>

#include "base/atomic_file.h"
#include "base/error.h"

namespace vpm {
namespace {

constexpr const char* kKind = "vpm checkpoint of a render";

/// What stands before the film's pixels. The program's version is part of the identity, so the layout is its own.
struct Numbers {
  struct Half {
    int passes = 0;
    double mean_size = 0.0, size_squares = 0.0;
  };
  int width = 0, height = 0;
  Half halves[2];
  double seconds = 0.0;
  RenderStatistics statistics;
};
// Plain numbers throughout; only the vectors' constructors keep it from being trivially copyable.
static_assert(std::is_standard_layout_v<Numbers> && std::is_trivially_destructible_v<Numbers>);

void append(std::string& bytes, const void* data, size_t size) { bytes.append(static_cast<const char*>(data), size); }
void append(std::string& bytes, const std::vector<Rgbd>& values) {
  append(bytes, values.data(), values.size() * sizeof(Rgbd));
}

/// The bytes of a file from a place on.
class Reader {
 public:
  Reader(const std::string& bytes, size_t at) : bytes_(bytes), at_(at) {}
  size_t left() const { return bytes_.size() - at_; }
  void read(void* data, size_t size) {
    assert(size <= left());
    std::copy_n(bytes_.data() + at_, size, static_cast<char*>(data));
    at_ += size;
  }
  std::vector<Rgbd> values(size_t count) {
    std::vector<Rgbd> all(count);
    read(all.data(), count * sizeof(Rgbd));
    return all;
  }

 private:
  const std::string& bytes_;
  size_t at_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("cannot resume from '{}': {}", path.string(), why));
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "there is no such file; render with --checkpoint to have one after each pass");
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const std::string& identity, const RenderResult& result) {
  assert(identity.find('\n') == std::string::npos);
  std::string bytes = fmt::format("{}\n{}\n", kKind, identity);
  Numbers numbers{result.film.width(), result.film.height(), {}, result.seconds, result.statistics};
  for (size_t h = 0; h < 2; ++h) {
    const PassMoments& half = result.film.halves()[h];
    numbers.halves[h] = {half.passes, half.mean_square, half.square_spread};
  }
  append(bytes, &numbers, sizeof numbers);
  for (const PassMoments& half : result.film.halves())
    for (const std::vector<Rgbd>* plane : {&half.mean, &half.squares, &half.products}) append(bytes, *plane);
  write_text(path, bytes);
}

RenderResult read_checkpoint(const std::filesystem::path& path, const std::string& identity) {
  const std::string bytes = text_of(path);
  const size_t kind = bytes.find('\n'), end = kind == std::string::npos ? kind : bytes.find('\n', kind + 1);
  if (end == std::string::npos || bytes.substr(0, kind) != kKind) refuse(path, "it is no checkpoint");
  const std::string found = bytes.substr(kind + 1, end - kind - 1);
  if (found != identity)
    refuse(path,
           fmt::format("it is of another render; remove it, or render again what it is of\n  file:   {}\n  asked:  {}",
                       found, identity));
  Reader reader(bytes, end + 1);
  Numbers numbers;
  if (reader.left() < sizeof numbers) refuse(path, "it is not whole");
  reader.read(&numbers, sizeof numbers);
  const size_t pixels = static_cast<size_t>(numbers.width) * static_cast<size_t>(numbers.height);
  if (numbers.width < 1 || numbers.height < 1 || reader.left() != 6 * pixels * sizeof(Rgbd))
    refuse(path, "it is not whole");
  Film::Halves halves;
  for (size_t h = 0; h < 2; ++h) {
    const auto& [passes, mean_size, size_squares] = numbers.halves[h];
    halves[h] = {passes, mean_size, size_squares, reader.values(pixels), reader.values(pixels), reader.values(pixels)};
  }
  return {Film(numbers.width, numbers.height, std::move(halves)), numbers.statistics, numbers.seconds};
}

}  // namespace vpm
