// Reflectances of dielectrics and conductors.
#include "surface/fresnel.h"

#include <cassert>

namespace vpm {

namespace {

/// In real numbers: with a + i b = sqrt((eta + i k)^2 - sin^2), both polarisations depend on a and on a^2 + b^2 alone.
float reflectance(float cosine, float eta, float k) {
  const float sine2 = (1.0f - cosine) * (1.0f + cosine);
  const float real = eta * eta - k * k - sine2, imaginary = 2.0f * eta * k;  // of (a + i b)^2
  const float modulus = std::hypot(real, imaginary);                         // a^2 + b^2
  // (modulus + real) / 2, without its cancellation where eta is small against k.
  const float a2 = real > 0.0f ? 0.5f * (modulus + real) : 0.5f * imaginary * imaginary / (modulus - real);
  const float square = modulus + cosine * cosine, twice = 2.0f * std::sqrt(a2) * cosine;
  const float perpendicular = (square - twice) / (square + twice);
  const float sum = modulus * cosine * cosine + sine2 * sine2, cross = twice * sine2;
  const float parallel = perpendicular * ((sum - cross) / (sum + cross));
  return 0.5f * (parallel + perpendicular);
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
