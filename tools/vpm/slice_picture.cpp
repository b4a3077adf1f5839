// Values on a raster, colours for them, and SVG around both.
#include "slice_picture.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "page/embedded.h"
#include "vpm/base/error.h"
#include "vpm/image/png.h"

namespace vpm::tools {
namespace {

/// The values of a slice, row by row from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<float> values;
  float largest = 0.0f;
};

constexpr std::array<char, 3> kAxes{'x', 'y', 'z'};

/// The axes of the drawing, to the right and up: of a slice across x they are z and y, across y x and z, across z x and
/// y.
std::array<int, 2> axes_across(int axis) { return axis == 0 ? std::array{2, 1} : std::array{0, axis == 1 ? 2 : 1}; }

Raster raster_of(const DensityGrid& grid, const Box& box, int axis, double at) {
  constexpr double kMostPixels = 2048.0;
  const auto [right, up] = axes_across(axis);
  const Vec3 extent = box.extent();
  const double pixel = std::max({double{grid.voxel_size()}, extent[right] / kMostPixels, extent[up] / kMostPixels});
  Raster raster;
  raster.width = std::max(1, static_cast<int>(std::lround(extent[right] / pixel)));
  raster.height = std::max(1, static_cast<int>(std::lround(extent[up] / pixel)));
  for (int j = 0; j < raster.height; ++j)
    for (int i = 0; i < raster.width; ++i) {
      Vec3 place;
      place[axis] = static_cast<float>(std::clamp(at, box.lo[axis] + 0.1 * pixel, box.hi[axis] - 0.1 * pixel));
      place[right] = box.lo[right] + (static_cast<float>(i) + 0.5f) / static_cast<float>(raster.width) * extent[right];
      place[up] = box.hi[up] - (static_cast<float>(j) + 0.5f) / static_cast<float>(raster.height) * extent[up];
      raster.values.push_back(grid.density(place));
      raster.largest = std::max(raster.largest, raster.values.back());
    }
  return raster;
}

/// Red, green and blue of the sRGB curve, by the share of the largest value [Green2011, eq. 2].
std::array<uint8_t, 3> colour_of(double share) {
  constexpr double kStart = 0.5, kRotations = -1.5, kHue = 1.0;
  const double angle = 2.0 * kPiD * (kStart / 3.0 + kRotations * share), c = std::cos(angle), s = std::sin(angle);
  const double amplitude = 0.5 * kHue * share * (1.0 - share);
  const std::array<double, 3> shifts{-0.14861 * c + 1.78277 * s, -0.29227 * c - 0.90649 * s, 1.97294 * c};
  std::array<uint8_t, 3> bytes;
  for (size_t k = 0; k < 3; ++k)
    bytes[k] = static_cast<uint8_t>(std::lround(255.0 * std::clamp(share + amplitude * shifts[k], 0.0, 1.0)));
  return bytes;
}

/// Each value as a square of so many pixels: viewers smooth what they enlarge
/// (findings/librsvg-smooths-every-picture.sh).
std::string picture_of(const Raster& raster, int square) {
  std::vector<uint8_t> bytes;
  for (int y = 0; y < square * raster.height; ++y)
    for (int x = 0; x < square * raster.width; ++x) {
      const float value = raster.values[static_cast<size_t>(y / square * raster.width + x / square)];
      const auto colour = colour_of(raster.largest > 0.0f ? double{value} / double{raster.largest} : 0.0);
      bytes.insert(bytes.end(), colour.begin(), colour.end());
    }
  return base64(png_of(square * raster.width, square * raster.height, bytes));
}

/// A coordinate of a box, of which rounding may have left a trace where it is 0.
double tidy(float coordinate, float extent) {
  constexpr float kRounding = 1e-6f;
  return std::abs(coordinate) < kRounding * extent ? 0.0 : double{coordinate};
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) c == '<' ? safe += "&lt;" : c == '&' ? safe += "&amp;" : safe += c;
  return safe;
}

/// The bar of colours from `top` down, with five numbers beside it.
std::string scale_of(double x, double top, double height, float largest, const std::string& unit) {
  constexpr int kSteps = 64, kNumbers = 4;
  constexpr double kWide = 18.0;
  std::string svg;
  for (int step = 0; step < kSteps; ++step) {
    const auto [r, g, b] = colour_of((step + 0.5) / kSteps);
    svg += fmt::format("<rect x='{:.1f}' y='{:.2f}' width='{}' height='{:.2f}' fill='#{:02x}{:02x}{:02x}'/>\n", x,
                       top + height * (kSteps - 1 - step) / kSteps, kWide, height / kSteps + 0.5, r, g, b);
  }
  for (int k = 0; k <= kNumbers; ++k)
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}'>{:.3g}{}</text>\n", x + kWide + 6.0,
                       top + height * (kNumbers - k) / kNumbers + 4.0, static_cast<double>(largest) * k / kNumbers,
                       k == kNumbers ? " " + escaped(unit) : "");
  return svg;
}

}  // namespace

SliceWish slice_wish(const std::string& text) {
  const auto axis = std::find(kAxes.begin(), kAxes.end(), text.empty() ? ' ' : text[0]);
  if (axis == kAxes.end() || (text.size() > 1 && text[1] != '=')) throw std::invalid_argument("no axis");
  SliceWish wish{static_cast<int>(axis - kAxes.begin()), std::nullopt};
  if (text.size() == 1) return wish;
  size_t read = 0;
  wish.at = std::stod(text.substr(2), &read);
  if (read != text.size() - 2 || !std::isfinite(*wish.at)) throw std::invalid_argument("no number");
  return wish;
}

std::string slice_drawing(const DensityGrid& grid, const SliceWish& wish, const std::string& title,
                          const std::string& unit) {
  const Box box = grid.bounds();
  const int axis = wish.axis;
  const double lo = double{box.lo[axis]}, hi = double{box.hi[axis]}, at = wish.at.value_or(0.5 * (lo + hi));
  if (!(at >= lo && at <= hi))
    throw InputError(fmt::format("--slice {}={:g}: the grid goes from {:g} to {:g} m", kAxes[axis], at, lo, hi));
  const Raster raster = raster_of(grid, box, axis, at);
  const auto [right, up] = axes_across(axis);
  constexpr int kLonger = 480;  // pixels, of what is drawn in squares
  constexpr double kMargin = 88.0, kScale = 150.0;
  const int square = std::max(1, kLonger / std::max(raster.width, raster.height));
  const double width = square * raster.width, tall = square * raster.height, height = std::max(120.0, tall);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' fill='white'/>\n",
      width + kMargin + kScale, height + 2.0 * kMargin);
  svg += fmt::format("<text x='{}' y='24' font-size='14'>{}, {} = {:.4g} m</text>\n", kMargin, escaped(title),
                     kAxes[axis], at);
  svg += fmt::format(
      "<image x='{}' y='40' width='{:.1f}' height='{:.1f}' "
      "href='data:image/png;base64,{}'/>\n",
      kMargin, width, tall, picture_of(raster, square));
  const double bottom = 40.0 + tall;
  const auto end = [&](const Vec3& corner, int a) { return tidy(corner[a], box.extent()[a]); };
  svg += fmt::format("<text x='{}' y='{:.1f}'>{} = {:.4g} m</text>\n", kMargin, bottom + 18.0, kAxes[right],
                     end(box.lo, right));
  svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{:.4g}</text>\n", kMargin + width, bottom + 18.0,
                     end(box.hi, right));
  svg += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{} = {:.4g}</text>\n", kMargin - 6.0, bottom, kAxes[up],
                     end(box.lo, up));
  svg += fmt::format("<text x='{}' y='50' text-anchor='end'>{:.4g}</text>\n", kMargin - 6.0, end(box.hi, up));
  svg += scale_of(kMargin + width + 16.0, 46.0, height - 12.0, raster.largest, unit);
  return svg + "</svg>\n";
}

std::string unit_of_grid(const std::string& name) {
  if (name.starts_with("fluence")) return "W/m^2";
  if (name.starts_with("absorbed")) return "W/m^3";
  return "";
}

}  // namespace vpm::tools
