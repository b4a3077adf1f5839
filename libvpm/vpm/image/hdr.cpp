// Radiance pictures: a header of text, a line of the size, and rows of four bytes a pixel.
//
// It is read here because stb_image, which Debian packages, leaves out what the header says of exposure and primaries,
// and takes a file that ends too early for one whose last rows are black.
#include "vpm/image/hdr.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/image/primaries.h"

namespace vpm {
namespace {

using Pixel = std::array<unsigned char, 4>;  // mantissas of red, green and blue, and their exponent

class HdrReader {
 public:
  HdrReader(const std::filesystem::path& path, std::string bytes) : path_(path), bytes_(std::move(bytes)) {}

  HdrPicture read() {
    read_header();
    const Order order = read_size();
    std::vector<Pixel> row(static_cast<size_t>(order.along.pixels));
    for (int line = 0; line < order.lines.pixels; ++line) {
      cancellation_point();
      read_row(row);
      for (int i = 0; i < order.along.pixels; ++i) order.pixel(picture_.image, line, i) = value_of(row[size_t(i)]);
    }
    convert();
    return std::move(picture_);
  }

 private:
  /// An axis of the picture, and whether pixels are written from its right or lower end on.
  struct Axis {
    bool vertical = false, backwards = false;
    int pixels = 0;

    int place(int number) const { return backwards ? pixels - 1 - number : number; }
  };
  /// How the pixels of a file follow each other: lines, and those along a line.
  struct Order {
    Axis lines, along;

    Rgb& pixel(Image& image, int line, int number) const {
      const int a = lines.place(line), b = along.place(number);
      return lines.vertical ? image.at(b, a) : image.at(a, b);
    }
  };

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError("cannot read '" + path_.string() + "': " + why);
  }

  std::string next_line() {
    const size_t end = bytes_.find('\n', at_);
    if (end == std::string::npos) refuse("it ends within its header");
    std::string line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    line.resize(line.find_last_not_of(" \t\r") + 1);
    return line;
  }

  void read_header() {
    if (const std::string first = next_line(); first != "#?RADIANCE" && first != "#?RGBE")
      refuse("it does not begin with #?RADIANCE or #?RGBE");
    for (std::string line = next_line(); !line.empty(); line = next_line()) {
      const size_t equals = line.find('=');
      const std::string name = line.substr(0, equals);
      std::istringstream value(equals == std::string::npos ? "" : line.substr(equals + 1));
      if (name == "FORMAT") {
        std::string format;
        if (!(value >> format) || format != "32-bit_rle_rgbe")
          refuse("its format is '" + format + "', and 32-bit_rle_rgbe is read");
      } else if (name == "EXPOSURE") {
        exposure_ *= positive(value, line);
      } else if (name == "COLORCORR") {
        for (int c = 0; c < 3; ++c) exposure_[c] *= positive(value, line);
      } else if (name == "GAMMA") {
        if (positive(value, line) != 1.0)
          picture_.notes.push_back("its header says '" + line +
                                   "', which is not applied: its values are taken for linear");
      } else if (name == "PRIMARIES") {
        Primaries& p = primaries_;
        for (glm::dvec2* xy : {&p.red, &p.green, &p.blue, &p.white})
          if (!(value >> xy->x >> xy->y)) refuse("its primaries '" + line + "' are not eight numbers");
      }
    }
  }

  double positive(std::istringstream& value, const std::string& line) const {
    double number = 0.0;
    if (!(value >> number) || !(number > 0.0) || std::isinf(number))
      refuse("its line '" + line + "' has no positive number");
    return number;
  }

  /// "-Y 512 +X 1024": lines from the top, and pixels from the left; y points up in these files.
  Order read_size() {
    const std::string line = next_line();
    std::istringstream words(line);
    std::string axes[2], rest;
    int64_t sizes[2] = {0, 0};
    const bool read = bool(words >> axes[0] >> sizes[0] >> axes[1] >> sizes[1]) && !(words >> rest);
    const auto is_axis = [](const std::string& word, char name) {
      return word.size() == 2 && (word[0] == '+' || word[0] == '-') && word[1] == name;
    };
    const bool rows = is_axis(axes[0], 'Y') && is_axis(axes[1], 'X');
    if (!read || (!rows && !(is_axis(axes[0], 'X') && is_axis(axes[1], 'Y'))))
      refuse("its size '" + line + "' is not as -Y HEIGHT +X WIDTH");
    constexpr int64_t kMost = 65536, kPixelsOfOneGiB = (1 << 30) / sizeof(Rgb);
    if (std::min(sizes[0], sizes[1]) < 1 || std::max(sizes[0], sizes[1]) > kMost ||
        sizes[0] * sizes[1] > kPixelsOfOneGiB)
      refuse(fmt::format("its {} x {} pixels need more than 1 GiB, or are none", sizes[rows ? 1 : 0],
                         sizes[rows ? 0 : 1]));
    if (static_cast<size_t>(sizes[0]) > (bytes_.size() - at_) / sizeof(Pixel)) refuse("it ends within its pixels");
    const auto axis = [&](int i) {
      const bool vertical = axes[i][1] == 'Y';
      return Axis{vertical, (axes[i][0] == '+') == vertical, static_cast<int>(sizes[i])};
    };
    const Order order{axis(0), axis(1)};
    picture_.image =
        rows ? Image(order.along.pixels, order.lines.pixels) : Image(order.lines.pixels, order.along.pixels);
    return order;
  }

  unsigned char next_byte() {
    if (at_ >= bytes_.size()) refuse("it ends within its pixels");
    return static_cast<unsigned char>(bytes_[at_++]);
  }
  Pixel next_pixel() {
    Pixel pixel;
    for (unsigned char& byte : pixel) byte = next_byte();
    return pixel;
  }

  /// The first pixel says how a row is packed: (2, 2, its length) before four runs of bytes of a kind.
  void read_row(std::vector<Pixel>& row) {
    const Pixel first = next_pixel();
    const bool packed = first[0] == 2 && first[1] == 2 && first[2] < 128 && row.size() >= 8 && row.size() < 32768;
    if (!packed) return read_pixels(first, row);
    if ((size_t{first[2]} << 8 | first[3]) != row.size()) refuse("a row has another length than the picture");
    for (size_t kind = 0; kind < 4; ++kind) read_kind(kind, row);
  }

  /// Runs of one byte, whose length less 128 comes first, and bytes one by one, whose number does.
  void read_kind(size_t kind, std::vector<Pixel>& row) {
    for (size_t x = 0; x < row.size();) {
      size_t count = next_byte();
      const bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || x + count > row.size()) refuse("a run of bytes is longer than its row, or empty");
      const unsigned char byte = run ? next_byte() : static_cast<unsigned char>(0);
      for (size_t i = 0; i < count; ++i) row[x++][kind] = run ? byte : next_byte();
    }
  }

  /// Pixels one by one; (1, 1, 1, n) repeats the last one n times, and the next such 256 n times.
  void read_pixels(Pixel pixel, std::vector<Pixel>& row) {
    int shift = 0;
    for (size_t x = 0;; pixel = next_pixel()) {
      if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
        const size_t count = shift < 32 ? size_t{pixel[3]} << shift : row.size();
        if (x == 0 || x + count > row.size()) refuse("a run of pixels is longer than its row, or comes first");
        std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
        x += count;
        shift += 8;
      } else {
        row[x++] = pixel;
        shift = 0;
      }
      if (x == row.size()) return;
    }
  }

  /// In the middle of what the mantissas stand for, as Radiance has it; 0 where the exponent is.
  Rgb value_of(const Pixel& pixel) const {
    if (pixel[3] == 0) return Rgb(0.0f);
    const double step = std::ldexp(1.0, pixel[3] - (128 + 8));
    return Rgb(Rgbd(pixel[0] + 0.5, pixel[1] + 0.5, pixel[2] + 0.5) * step / exposure_);
  }

  void convert() {
    const auto& [r, g, b] = std::array{exposure_.r, exposure_.g, exposure_.b};
    if (r != g || g != b)
      picture_.notes.push_back(fmt::format("its exposure, {:.4g}, {:.4g} and {:.4g}, is divided out", r, g, b));
    else if (r != 1.0)
      picture_.notes.push_back(fmt::format("its exposure, {:.4g}, is divided out", r));
    if (primaries_.are_those_of_rec709()) return;
    const glm::dmat3 matrix = to_rec709(primaries_);
    for (Rgb& pixel : picture_.image.pixels) pixel = Rgb(matrix * Rgbd(pixel));
    picture_.notes.push_back(conversion_text(primaries_));
  }

  const std::filesystem::path& path_;
  const std::string bytes_;
  size_t at_ = 0;
  Rgbd exposure_{1.0};
  Primaries primaries_;
  HdrPicture picture_;
};

}  // namespace

HdrPicture read_hdr(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError("cannot read '" + path.string() + "': there is no such file");
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) throw InputError("cannot read '" + path.string() + "': it cannot be opened");
  return HdrReader(path, std::move(bytes)).read();
}

}  // namespace vpm
