// Reflectances of dielectrics and conductors.
#include "vpm/surface/material/fresnel.h"

#include <cassert>

namespace vpm {

namespace {

float square(float x) { return x * x; }

/// In real numbers: with a + i b = sqrt((eta + i k)^2 - sin^2), each polarisation is a quotient of sums of squares,
/// which no rounding carries out of [0, 1].
float reflectance(float cosine, float eta, float k) {
  const float sine2 = (1.0f - cosine) * (1.0f + cosine);
  const float real = eta * eta - k * k - sine2, imaginary = 2.0f * eta * k;  // of (a + i b)^2
  // a^2 and b^2 are (modulus + real) / 2 and (modulus - real) / 2: the larger so, the other by a b = imaginary / 2.
  const float larger = 0.5f * (std::hypot(real, imaginary) + std::abs(real));
  const float smaller = 0.25f * imaginary * imaginary / larger;
  const float a = std::sqrt(real > 0.0f ? larger : smaller), b2 = real > 0.0f ? smaller : larger;
  const float perpendicular = (square(a - cosine) + b2) / (square(a + cosine) + b2);
  const float shift = b2 * square(cosine);
  const float ratio = (square(a * cosine - sine2) + shift) / (square(a * cosine + sine2) + shift);  // parallel over it
  return 0.5f * perpendicular * (1.0f + ratio);
}

}  // namespace

float cos_transmitted(float cos_incident, float eta) {
  const float square = cos_incident * cos_incident + (eta - 1.0f) * (eta + 1.0f);
  return square < 0.0f ? -1.0f : std::sqrt(square) / eta;
}

float fresnel_dielectric(float cos_incident, float eta) {
  assert(cos_incident >= 0.0f && cos_incident <= 1.0f && eta > 0.0f);
  if (eta == 1.0f) return 0.0f;
  const float cos_t = cos_transmitted(cos_incident, eta);
  if (cos_t < 0.0f) return 1.0f;
  const float parallel = (eta * cos_incident - cos_t) / (eta * cos_incident + cos_t);
  const float perpendicular = (cos_incident - eta * cos_t) / (cos_incident + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

Rgb fresnel_conductor(float cos_incident, const Rgb& eta, const Rgb& k) {
  assert(cos_incident >= 0.0f && cos_incident <= 1.0f);
  return {reflectance(cos_incident, eta.r, k.r), reflectance(cos_incident, eta.g, k.g),
          reflectance(cos_incident, eta.b, k.b)};
}

}  // namespace vpm
