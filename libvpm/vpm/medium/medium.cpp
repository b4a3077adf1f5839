// Density integrals along rays.
#include "vpm/medium/medium.h"

namespace vpm {

DensityIntegral density_integral(const Medium& medium, const Ray& ray, const Interval& interval) {
  DensityIntegral result;
  result.lookups = medium.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    result.value += piece.integral();
    return true;
  });
  return result;
}

}  // namespace vpm
