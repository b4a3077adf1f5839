// Planck's law, seen by the eye's three channels.
#include "vpm/medium/blackbody.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vpm {
namespace {

constexpr double kFirstNm = 360.0, kStepNm = 5.0;
/// The colour matching functions x, y and z from 360 nm to 830 nm, every 5 nm.
constexpr std::array<std::array<double, 3>, 95> kMatching{{
    {0.0001299, 3.917e-06, 0.0006061},
    {0.0002321, 6.965e-06, 0.001086},
    {0.0004149, 1.239e-05, 0.001946},
    {0.0007416, 2.202e-05, 0.003486},
    {0.001368, 3.9e-05, 0.006450001},
    {0.002236, 6.4e-05, 0.01054999},
    {0.004243, 0.00012, 0.02005001},
    {0.00765, 0.000217, 0.03621},
    {0.01431, 0.000396, 0.06785001},
    {0.02319, 0.00064, 0.1102},
    {0.04351, 0.00121, 0.2074},
    {0.07763, 0.00218, 0.3713},
    {0.13438, 0.004, 0.6456},
    {0.21477, 0.0073, 1.0390501},
    {0.2839, 0.0116, 1.3856},
    {0.3285, 0.01684, 1.62296},
    {0.34828, 0.023, 1.74706},
    {0.34806, 0.0298, 1.7826},
    {0.3362, 0.038, 1.77211},
    {0.3187, 0.048, 1.7441},
    {0.2908, 0.06, 1.6692},
    {0.2511, 0.0739, 1.5281},
    {0.19536, 0.09098, 1.28764},
    {0.1421, 0.1126, 1.0419},
    {0.09564, 0.13902, 0.8129501},
    {0.05795001, 0.1693, 0.6162},
    {0.03201, 0.20802, 0.46518},
    {0.0147, 0.2586, 0.3533},
    {0.0049, 0.323, 0.272},
    {0.0024, 0.4073, 0.2123},
    {0.0093, 0.503, 0.1582},
    {0.0291, 0.6082, 0.1117},
    {0.06327, 0.71, 0.07824999},
    {0.1096, 0.7932, 0.05725001},
    {0.1655, 0.862, 0.04216},
    {0.2257499, 0.9148501, 0.02984},
    {0.2904, 0.954, 0.0203},
    {0.3597, 0.9803, 0.0134},
    {0.4334499, 0.9949501, 0.008749999},
    {0.5120501, 1.0, 0.005749999},
    {0.5945, 0.995, 0.0039},
    {0.6784, 0.9786, 0.002749999},
    {0.7621, 0.952, 0.0021},
    {0.8425, 0.9154, 0.0018},
    {0.9163, 0.87, 0.001650001},
    {0.9786, 0.8163, 0.0014},
    {1.0263, 0.757, 0.0011},
    {1.0567, 0.6949, 0.001},
    {1.0622, 0.631, 0.0008},
    {1.0456, 0.5668, 0.0006},
    {1.0026, 0.503, 0.00034},
    {0.9384, 0.4412, 0.00024},
    {0.8544499, 0.381, 0.00019},
    {0.7514, 0.321, 0.0001},
    {0.6424, 0.265, 4.999999e-05},
    {0.5419, 0.217, 3e-05},
    {0.4479, 0.175, 2e-05},
    {0.3608, 0.1382, 1e-05},
    {0.2835, 0.107, 0.0},
    {0.2187, 0.0816, 0.0},
    {0.1649, 0.061, 0.0},
    {0.1212, 0.04458, 0.0},
    {0.0874, 0.032, 0.0},
    {0.0636, 0.0232, 0.0},
    {0.04677, 0.017, 0.0},
    {0.0329, 0.01192, 0.0},
    {0.0227, 0.00821, 0.0},
    {0.01584, 0.005723, 0.0},
    {0.01135916, 0.004102, 0.0},
    {0.008110916, 0.002929, 0.0},
    {0.005790346, 0.002091, 0.0},
    {0.004109457, 0.001484, 0.0},
    {0.002899327, 0.001047, 0.0},
    {0.00204919, 0.00074, 0.0},
    {0.001439971, 0.00052, 0.0},
    {0.0009999493, 0.0003611, 0.0},
    {0.0006900786, 0.0002492, 0.0},
    {0.0004760213, 0.0001719, 0.0},
    {0.0003323011, 0.00012, 0.0},
    {0.0002348261, 8.48e-05, 0.0},
    {0.0001661505, 6e-05, 0.0},
    {0.000117413, 4.24e-05, 0.0},
    {8.307527e-05, 3e-05, 0.0},
    {5.870652e-05, 2.12e-05, 0.0},
    {4.150994e-05, 1.499e-05, 0.0},
    {2.935326e-05, 1.06e-05, 0.0},
    {2.067383e-05, 7.4657e-06, 0.0},
    {1.455977e-05, 5.2578e-06, 0.0},
    {1.025398e-05, 3.7029e-06, 0.0},
    {7.221456e-06, 2.6078e-06, 0.0},
    {5.085868e-06, 1.8366e-06, 0.0},
    {3.581652e-06, 1.2934e-06, 0.0},
    {2.522525e-06, 9.1093e-07, 0.0},
    {1.776509e-06, 6.4153e-07, 0.0},
    {1.251141e-06, 4.5181e-07, 0.0},
}};

/// 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1), W/(m^2 sr) per m of wavelength.
double planck(double metres, double kelvin) {
  constexpr double kH = 6.62607015e-34, kC = 299792458.0, kK = 1.380649e-23;  // J s, m/s, J/K: the SI's [BIPM2019]
  return 2.0 * kH * kC * kC / std::pow(metres, 5) / std::expm1(kH * kC / (metres * kK * kelvin));
}

/// The logarithms of X, Y and Z: at temperatures even in 1/T up to 10,000 K, in which they are nearly straight lines,
/// and from there on even in ln T, as radiance then goes with T.
class Table {
 public:
  Table() {
    for (int i = 0; i < kNodes; ++i) {
      set(1.0 / (kLeast + (i - 1) * kStep), warm_[i]);
      set(kMiddle * std::exp((i - 1) * kHotStep), hot_[i]);
    }
  }

  Vec3d xyz(double kelvin) const {
    if (kelvin <= kMiddle) return between(warm_, (1.0 / kelvin - kLeast) / kStep + 1.0);
    return between(hot_, std::log(kelvin / kMiddle) / kHotStep + 1.0);
  }

 private:
  static constexpr int kNodes = 512;
  static constexpr double kMiddle = 10'000.0, kHottest = 1e8;  // K
  static constexpr double kLeast = 1.0 / kMiddle, kStep = (1.0 / kColdestSeen - kLeast) / (kNodes - 4);
  static inline const double kHotStep = std::log(kHottest / kMiddle) / (kNodes - 4);
  using Nodes = std::array<std::array<double, 3>, kNodes>;

  static void set(double kelvin, std::array<double, 3>& logarithms) {
    const Vec3d xyz = blackbody_xyz(kelvin);
    for (int c = 0; c < 3; ++c) logarithms[c] = std::log(xyz[c]);
  }

  /// By the cubic through the four nodes around.
  static Vec3d between(const Nodes& nodes, double place) {
    const int i = std::clamp(static_cast<int>(place), 1, kNodes - 3);
    const double f = place - i;
    const double before = -f * (f - 1.0) * (f - 2.0) / 6.0, at = (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0;
    const double next = -(f + 1.0) * f * (f - 2.0) / 2.0, last = (f + 1.0) * f * (f - 1.0) / 6.0;
    Vec3d result;
    for (int c = 0; c < 3; ++c)
      result[c] =
          std::exp(before * nodes[i - 1][c] + at * nodes[i][c] + next * nodes[i + 1][c] + last * nodes[i + 2][c]);
    return result;
  }

  Nodes warm_{}, hot_{};
};

}  // namespace

Vec3d blackbody_xyz(double kelvin) {
  Vec3d sum(0.0);
  for (size_t i = 0; i < kMatching.size(); ++i) {
    const double radiance = planck(1e-9 * (kFirstNm + kStepNm * static_cast<double>(i)), kelvin);
    sum += radiance * Vec3d(kMatching[i][0], kMatching[i][1], kMatching[i][2]);
  }
  return 1e-9 * kStepNm * sum;
}

Rgbd blackbody(double kelvin) {
  static const Table table;
  if (!(kelvin > kColdestSeen)) return Rgbd(0.0);
  return glm::max(Rgbd(0.0), linear_srgb_of_xyz(table.xyz(kelvin)));
}

}  // namespace vpm
