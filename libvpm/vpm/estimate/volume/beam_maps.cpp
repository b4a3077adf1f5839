// What photons have left of their powers along their flights.
#include "vpm/estimate/volume/beam_maps.h"

#include "vpm/medium/distance/mixture.h"

namespace vpm {
namespace {

/// At the distance `s` on a beam.
Rgb left_along(const Medium& medium, bool long_beams, const Ray& beam, const Rgb& power, float s) {
  if (long_beams) return transmittance(medium, density_integral(medium, beam, {0.0f, s}).value);
  return weight_along(medium, beam, power, s);
}

}  // namespace

Rgb weight_along(const Medium& medium, const Ray& beam, const Rgb& power, float s) {
  if (is_grey(medium.sigma_t)) return Rgb(1.0f);
  const double integral = density_integral(medium, beam, {0.0f, s}).value;
  return analog_weight(medium, channel_shares(power), integral, false);
}

void multiply_by_left(const Medium& medium, const PhotonBeamSettings& settings, const Vec3& origin,
                      const BeamPlaces& found, Passed& passed) {
  const bool fades = settings.long_beams || !is_grey(medium.sigma_t);
  const bool by_density = settings.maps.form == VolumeForm::density_at_photon;
  if (!fades && !by_density) return;
  for (size_t i = 0; i < found.size; ++i) {
    const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
    const Vec3 place = origin + Vec3(found.x[i], found.y[i], found.z[i]);
    Rgb left(1.0f);
    if (fades)
      left = left_along(medium, settings.long_beams, {place - found.s[i] * direction, direction},
                        {found.r[i], found.g[i], found.b[i]}, found.s[i]);
    if (by_density) left *= medium.density(place);
    passed.r[i] *= left.r;
    passed.g[i] *= left.g;
    passed.b[i] *= left.b;
  }
}

}  // namespace vpm
