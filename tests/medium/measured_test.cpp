// The measured coefficients: copied right, checked by the diffuse reflectances that were printed beside them.
#include "vpm/medium/measured.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vpm {
namespace {

/// Diffuse reflectance of a half space by the dipole model [Jensen2001practical, sec. 4], for the internal reflection
/// at the relative index of refraction `eta`.
double diffuse_reflectance(double reduced_sigma_s, double sigma_a, double eta) {
  const double albedo = reduced_sigma_s / (reduced_sigma_s + sigma_a);
  const double internal = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
  const double a = (1 + internal) / (1 - internal);
  const double root = std::sqrt(3 * (1 - albedo));
  return 0.5 * albedo * (1 + std::exp(-4.0 / 3.0 * a * root)) * std::exp(-root);
}

TEST(Measured, CoefficientsGiveThePrintedReflectances) {
  const struct {
    const char* name;
    double eta, reflectance[3];
  } printed[] = {{"apple", 1.3, {0.85, 0.84, 0.53}},      {"chicken1", 1.3, {0.31, 0.15, 0.10}},
                 {"chicken2", 1.3, {0.32, 0.16, 0.10}},   {"cream", 1.3, {0.98, 0.90, 0.73}},
                 {"ketchup", 1.3, {0.16, 0.01, 0.00}},    {"marble", 1.5, {0.83, 0.79, 0.75}},
                 {"potato", 1.3, {0.77, 0.62, 0.21}},     {"skimmilk", 1.3, {0.81, 0.81, 0.69}},
                 {"skin1", 1.3, {0.44, 0.22, 0.13}},      {"skin2", 1.3, {0.63, 0.44, 0.34}},
                 {"spectralon", 1.3, {1.00, 1.00, 1.00}}, {"wholemilk", 1.3, {0.91, 0.88, 0.76}}};
  ASSERT_EQ(measured_media().size(), std::size(printed));
  for (const auto& row : printed) {
    const MeasuredMedium* medium = find_measured_medium(row.name);
    ASSERT_NE(medium, nullptr) << row.name;
    for (int c = 0; c < 3; ++c)  // both tables are rounded to two or three digits
      EXPECT_NEAR(diffuse_reflectance(medium->reduced_sigma_s[c], medium->sigma_a[c], row.eta), row.reflectance[c],
                  0.03)
          << row.name << c;
  }
}

TEST(Measured, UnknownNamesAreNull) { EXPECT_EQ(find_measured_medium("milk"), nullptr); }

}  // namespace
}  // namespace vpm
