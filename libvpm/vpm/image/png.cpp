// Pictures of bytes: tone curve and libpng.
#include "vpm/image/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

/// The nearest of 256 steps of the sRGB curve [IEC1999].
uint8_t srgb_byte(float linear) {
  const float c = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;  // black also where an infinite gain meets 0
  const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(255.0f * encoded));
}

/// The linear value that a step of the sRGB curve stands for [IEC1999].
float linear_of_srgb(int byte) {
  const double c = byte / 255.0;
  return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

/// A picture that is to be written, of three bytes to a pixel.
png_image rgb_picture(int width, int height) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png.format = PNG_FORMAT_RGB;
  return png;
}

/// An open picture; frees what libpng holds on every way out.
struct OpenPng {
  png_image png{};
  explicit OpenPng(const std::filesystem::path& path) {
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&png, path.c_str())) fail(path);
  }
  ~OpenPng() { png_image_free(&png); }
  OpenPng(const OpenPng&) = delete;
  OpenPng& operator=(const OpenPng&) = delete;
  [[noreturn]] void fail(const std::filesystem::path& path) const {
    throw InputError("cannot read '" + path.string() + "': " + png.message);
  }
};

/// Throws InputError where a chunk is longer than what is left of the file: libpng would ask for memory for it first.
/// What is no PNG file is left to libpng.
void check_chunks(const std::filesystem::path& path) {
  constexpr uint64_t kSignature = 8, kHead = 8, kChecksum = 4;  // bytes
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<uint64_t>(std::max<std::streamoff>(0, file.tellg()));
  std::array<png_byte, kHead> head{};
  const auto read_head = [&](uint64_t at) {
    return at + kHead <= size && file.seekg(static_cast<std::streamoff>(at)) &&
           file.read(reinterpret_cast<char*>(head.data()), kHead);
  };
  if (!read_head(0) || png_sig_cmp(head.data(), 0, kSignature) != 0) return;
  for (uint64_t at = kSignature; read_head(at);) {
    const uint64_t length = png_get_uint_32(head.data());
    if (length + kHead + kChecksum > size - at)
      throw InputError("'" + path.string() + "' is cut off: its chunk at byte " + std::to_string(at) + " says that " +
                       std::to_string(length) + " bytes follow, and " + std::to_string(size - at - kHead) + " do");
    at += kHead + length + kChecksum;
  }
}

/// The four bytes of each pixel: red, green, blue, opacity.
std::vector<uint8_t> read_bytes(const std::filesystem::path& path, int& width, int& height) {
  constexpr double kMostPixelBytes = 0x1p30;
  check_chunks(path);
  OpenPng open(path);
  if (double{sizeof(Rgb)} * open.png.width * open.png.height > kMostPixelBytes)
    throw InputError("'" + path.string() + "' takes more than 1 GiB in memory");
  if (open.png.format & PNG_FORMAT_FLAG_LINEAR)
    throw InputError("'" + path.string() + "' has 16 bits a channel; write it with 8, or as an .exr");
  width = static_cast<int>(open.png.width);
  height = static_cast<int>(open.png.height);
  open.png.format = PNG_FORMAT_RGBA;
  std::vector<uint8_t> bytes(PNG_IMAGE_SIZE(open.png));
  if (!png_image_finish_read(&open.png, nullptr, bytes.data(), 0, nullptr)) open.fail(path);
  return bytes;
}

}  // namespace

Image read_png(const std::filesystem::path& path, PngValues values) {
  std::array<float, 256> linear{};
  for (int i = 0; i < 256; ++i)
    linear[static_cast<size_t>(i)] = values == PngValues::srgb ? linear_of_srgb(i) : static_cast<float>(i) / 255.0f;
  int width = 0, height = 0;
  const std::vector<uint8_t> bytes = read_bytes(path, width, height);
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const uint8_t* pixel = &bytes[4 * i];
    if (pixel[3] != 255)
      throw InputError("'" + path.string() + "' is transparent at column " + std::to_string(i % image.width) +
                       ", row " + std::to_string(i / image.width) + "; all of it must be opaque");
    image.pixels[i] = Rgb(linear[pixel[0]], linear[pixel[1]], linear[pixel[2]]);
  }
  return image;
}

size_t write_png(const std::filesystem::path& path, const Image& radiance, float exposure) {
  assert(!radiance.pixels.empty() && std::isfinite(exposure));
  const float gain = std::exp2(exposure);
  std::vector<uint8_t> bytes;
  bytes.reserve(3 * radiance.pixels.size());
  size_t broken = 0;
  for (const Rgb& pixel : radiance.pixels) {
    const bool finite = is_finite(pixel);
    if (!finite) ++broken;
    const Rgb shown = finite ? gain * pixel : Rgb(1.0f, 0.0f, 1.0f);
    for (int c = 0; c < 3; ++c) bytes.push_back(srgb_byte(shown[c]));
  }

  TemporaryFile file(path);
  png_image png = rgb_picture(radiance.width, radiance.height);
  if (!png_image_write_to_file(&png, file.path().c_str(), 0, bytes.data(), 0, nullptr)) {
    throw InputError("cannot write '" + path.string() + "': " + png.message);
  }
  file.commit();
  return broken;
}

std::vector<uint8_t> png_of(int width, int height, const std::vector<uint8_t>& rgb) {
  png_image png = rgb_picture(width, height);
  png_alloc_size_t size = 0;
  std::vector<uint8_t> file;
  if (png_image_write_to_memory(&png, nullptr, &size, 0, rgb.data(), 0, nullptr)) {
    file.resize(size);
    if (png_image_write_to_memory(&png, file.data(), &size, 0, rgb.data(), 0, nullptr)) return file;
  }
  throw InputError(std::string("cannot make a PNG picture: ") + png.message);
}

float auto_exposure(const Image& radiance) {
  std::vector<float> lit;
  for (const Rgb& pixel : radiance.pixels) {
    const float y = luminance(pixel);
    if (std::isfinite(y) && y > 0.0f) lit.push_back(y);
  }
  if (lit.empty()) return 0.0f;
  const auto percentile = lit.begin() + static_cast<ptrdiff_t>(0.99 * static_cast<double>(lit.size() - 1));
  std::nth_element(lit.begin(), percentile, lit.end());
  return std::log2(0.8f / *percentile);
}

}  // namespace vpm
