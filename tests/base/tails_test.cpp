// Tails of distributions: known values, ends, and inverses.
#include "vpm/base/tails.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vpm {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(NormalTail, KnownValues) {
  EXPECT_EQ(normal_tail(0.0), 1.0);
  const double known[][2] = {{0.5, 0.61707507745197379},     {1.0, 0.3173105078629141},
                             {-3.0, 0.0026997960632601891},  {5.0, 5.7330314375838782e-7},
                             {10.0, 1.5239706048321052e-23}, {30.0, 9.8134278542963741e-198}};
  for (const auto& [z, p] : known) EXPECT_NEAR(normal_tail(z) / p, 1.0, 1e-12) << z;
  EXPECT_TRUE(std::isnan(normal_tail(kNotANumber)));
}

TEST(NormalQuantile, KnownValues) {
  const double known[][2] = {{0.5, 0.67448975019608174},  {0.05, 1.9599639845400542}, {0.01, 2.5758293035489008},
                             {1e-3, 3.2905267314918948},  {1e-6, 4.8916384756985904}, {1e-12, 7.1305068481713245},
                             {1e-100, 21.305940069351527}};
  for (const auto& [p, z] : known) EXPECT_NEAR(normal_quantile(p), z, 1e-13 * z) << p;
  EXPECT_NEAR(normal_quantile(1.0), 0.0, 1e-15);
}

TEST(Chi2Tail, KnownValues) {
  const double known[][3] = {// statistic, degrees of freedom, p
                             {3.841458820694124, 1, 0.050000000000000057},
                             {0.5, 1, 0.47950012218695346},
                             {2.0, 2, 0.36787944117144232},
                             {1e-6, 3, 0.99999999973403856},
                             {10, 10, 0.44049328506521241},
                             {100, 50, 3.4549313829848639e-5},
                             {30, 99, 0.99999999999833578},
                             {120, 99, 0.07424385580596679},
                             {1000, 1000, 0.49405285382923964},
                             {1100, 1000, 0.014614408126295194},
                             {900, 1000, 0.98928276190871026},
                             {100000, 100000, 0.49940529189520669},
                             {101000, 100000, 0.01286884037723367},
                             {50, 5, 1.3857973367009593e-9},
                             {600, 3, 1.0078435921645642e-129},
                             {0.3, 0.5, 0.33317180231535664}};
  for (const auto& [x, dof, p] : known)
    EXPECT_NEAR(chi2_tail(x, dof) / p, 1.0, 1e-12 * std::min(10.0, 1.0 + dof)) << x << " " << dof;
}

TEST(Chi2Tail, Ends) {
  EXPECT_EQ(chi2_tail(0.0, 7.0), 1.0);
  EXPECT_EQ(chi2_tail(HUGE_VAL, 7.0), 0.0);
  EXPECT_EQ(chi2_tail(1e6, 7.0), 0.0);
  EXPECT_TRUE(std::isnan(chi2_tail(kNotANumber, 7.0)));
}

TEST(Chi2Tail, AgreesWithTheNormalTailForOneDegree) {
  for (double z = 0.1; z < 8.0; z += 0.1) EXPECT_NEAR(chi2_tail(z * z, 1.0) / normal_tail(z), 1.0, 1e-10) << z;
}

TEST(StudentTail, ClosedFormsOfFewDegrees) {
  for (const double t : {0.0, 0.01, 0.5, 1.0, 2.0, 5.0, 40.0}) {
    const double sine = t / std::sqrt(10.0 + t * t), square = 10.0 / (10.0 + t * t);
    const double ten = sine * (1 + square / 2 * (1 + square * 3 / 4 * (1 + square * 5 / 6 * (1 + square * 7 / 8))));
    EXPECT_NEAR(student_tail(t, 1.0), 1.0 - 2.0 / M_PI * std::atan(t), 1e-14) << t;
    EXPECT_NEAR(student_tail(-t, 2.0), 1.0 - t / std::sqrt(2.0 + t * t), 1e-14) << t;
    EXPECT_NEAR(student_tail(t, 10.0), 1.0 - ten, 1e-14) << t;
  }
}

TEST(StudentTail, BecomesNormal) {
  // the quantile's expansion in 1 / dof starts z + (z^3 + z) / (4 dof)
  for (const double z : {0.5, 1.0, 3.0, 5.0}) {
    const double dof = 1e5, t = z + (z * z * z + z) / (4.0 * dof);
    EXPECT_NEAR(student_tail(t, dof) / normal_tail(z), 1.0, 1e-8 * z * z * z * z * z) << z;
  }
  EXPECT_NEAR(student_tail(2.0, 1e12) / normal_tail(2.0), 1.0, 1e-10);
  EXPECT_DOUBLE_EQ(student_tail(2.0, HUGE_VAL), normal_tail(2.0));
  EXPECT_TRUE(std::isnan(student_tail(kNotANumber, 7.0)));
}

TEST(StudentQuantile, IsTheInverseOfTheTail) {
  for (const double dof : {1.0, 3.0, 15.5, 1e4})
    for (const double p : {1e-6, 0.05, 0.5, 1.0})
      EXPECT_NEAR(student_tail(student_quantile(p, dof), dof) / p, 1.0, 1e-12);
}

}  // namespace
}  // namespace vpm
