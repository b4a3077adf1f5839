// The preview that people look at: tone curve and libpng.
#include "image/png.h"

#include <png.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "image/metrics.h"

namespace vpm {
namespace {

/// The nearest of 256 steps of the sRGB curve [IEC1999].
uint8_t srgb_byte(float linear) {
  const float c = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;  // black also where an infinite gain meets 0
  const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(255.0f * encoded));
}

}  // namespace

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
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(radiance.width);
  png.height = static_cast<png_uint_32>(radiance.height);
  png.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&png, file.path().c_str(), 0, bytes.data(), 0, nullptr)) {
    throw InputError("cannot write '" + path.string() + "': " + png.message);
  }
  file.commit();
  return broken;
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
