// Light from surfaces of even radiance: points drawn by area, densities turned to solid angle.
#include "vpm/light/kinds.h"

namespace vpm {

std::optional<Incident> incident_by_area(const Rgb& radiance, const LightPoint& from, const Vec3& point) {
  const Vec3 towards = from.position - point;
  const float facing = -glm::dot(from.normal, towards);  // cosine * distance
  if (!(facing > 0.0f)) return std::nullopt;
  const float square = glm::dot(towards, towards), distance = std::sqrt(square);
  const float pdf = square * distance / (from.area * facing);
  return Incident{towards / distance, distance, radiance / pdf, pdf, from.normal};
}

float pdf_by_area(float area, const SeenLight& seen) {
  const float facing = -area * glm::dot(seen.normal, seen.direction);
  return facing > 0.0f ? seen.distance * seen.distance / facing : 0.0f;
}

}  // namespace vpm
