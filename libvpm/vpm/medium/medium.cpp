// Columns along rays.
#include "vpm/medium/medium.h"

namespace vpm {

Column column(const Medium& medium, const Ray& ray, const Interval& interval) {
  Column result;
  result.lookups = medium.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    result.value += piece.column();
    return true;
  });
  return result;
}

}  // namespace vpm
