// The terms of a flight, from the sums that its sub-path would carry a metre on.
#include "vpm/integrators/combined/flight_terms.h"

#include <cmath>

namespace vpm {
FlightTerms flight_terms(const TechniqueCounts& counts, const Departure& from, const Rgb& before, const Vec3& origin) {
  const Leg a_metre{Rgb(1.0f), 1.0};
  const Junction there{Junction::Kind::medium, Vec3(0.0f), Rgb(1.0f)};
  const Vec3 place = from.point + from.direction;
  const double unit = 1.0 / (from.forward * counts.short_beams);
  FlightTerms terms;
  terms.before = before;
  terms.offset = glm::distance(from.point, origin);
  terms.parallel = from.parallel;
  if (const double back = arrival(from.from, from.direction, a_metre); back > 0.0) {
    const double behind = further_behind(counts, from, a_metre, false) / counts.weigh(back);
    const double weighed = counts.heuristic == Heuristic::power ? std::sqrt(behind) : behind;
    const bool collided = from.from.kind == Junction::Kind::medium;
    terms.back =
        (collided ? from.from.sigma_t : Rgb(static_cast<float>(back))) * (finite_density(weighed * unit) / 3.0f);
  }
  const bool round = from.light && std::holds_alternative<SphereLight>(*from.light);
  if (round) {
    terms.round = from.light;
    terms.normal = from.from.normal;
  }
  terms.adjacent = finite_density((round ? 1.0 / from.place : connections_over(from, a_metre, there, place)) * unit);
  return terms;
}

float adjacent_at(const FlightTerms& terms, const Vec3& place, const Vec3& travel, float distance) {
  if (!terms.round) return terms.adjacent;
  return finite_density(terms.adjacent * sampled_density(*terms.round, place, {-travel, distance, terms.normal}));
}

}  // namespace vpm
