// Emission points and the photons they yield.
#include "vpm/photon/emission.h"

#include <algorithm>

#include "vpm/base/warp.h"
#include "vpm/light/emitting_volume.h"

namespace vpm {

double EmissionPoint::operator[](int dimension) const {
  switch (dimension) {
    case 0:
      return light;
    case 1:
      return numbers.choice;
    case 2:
      return numbers.face;
    case 3:
      return numbers.place.x;
    case 4:
      return numbers.place.y;
    case 5:
      return numbers.direction.x;
    default:
      return numbers.direction.y;
  }
}

void EmissionPoint::set(int dimension, double value) {
  // A float just below 1 may round up to it, which no uniform number is.
  const float single = std::min(static_cast<float>(value), 1.0f - 0x1p-24f);
  switch (dimension) {
    case 0:
      light = value;
      break;
    case 1:
      numbers.choice = value;
      break;
    case 2:
      numbers.face = value;
      break;
    case 3:
      numbers.place.x = single;
      break;
    case 4:
      numbers.place.y = single;
      break;
    case 5:
      numbers.direction.x = single;
      break;
    default:
      numbers.direction.y = single;
      break;
  }
}

EmissionPoint draw_emission_point(Rng& rng) { return {rng.uniform_double(), draw_emission_numbers(rng)}; }

PathState emit_from_medium(const Scene& scene, const PickedLight& light, const EmissionNumbers& u) {
  const auto& source = std::get<VolumeLight>(scene.lights[light.number]);
  const MediumId number = source.medium;
  const EmittingVolume::Place place = source.volume->draw(u.choice, u.face, u.place);
  const Ray ray{place.position, uniform_sphere(u.direction)};
  PathState photon{ray, number, Rgb(0.0f)};
  const Rgbd emitted = emission_coefficient(scene.media[number], place.position);
  const double mean = (emitted.r + emitted.g + emitted.b) / 3.0;
  if (place.rest * place.bound >= mean || medium_of_ray(scene, kSeveralMedia, ray) != number) return photon;
  // The bound is exceeded at most by what rounding moves a place.
  photon.throughput = Rgb(source.volume->bound() / std::min(mean, place.bound) / light.probability * emitted);
  return photon;
}

PathState emit_photon(const Scene& scene, const EmissionPoint& point) {
  const PickedLight light = pick_light(scene, point.light);
  if (std::holds_alternative<VolumeLight>(scene.lights[light.number]))
    return emit_from_medium(scene, light, point.numbers);
  const Emission emission =
      emit(scene.lights[light.number], entrance_of(scene, scene.lights[light.number]), point.numbers);
  return {emission.ray, medium_of_ray(scene, scene.light_medium[light.number], emission.ray),
          emission.power / light.probability};
}

}  // namespace vpm
