// Flights through null collisions: what the tracking strategies share. A flight meets tentative collisions at the rate
// of a majorant; each is real with the density's share of the majorant, or null, as if nothing were there
// [Woodcock1965].
//
// Channels share one majorant. Whether a collision is real is drawn by the mean of their chances, each with its share
// of the power that the photon carries by then, and the weights are how much a channel's own chance differs: the
// mixture of [Wilkie2014] at every tentative collision, as [Kutz2017] has it where probabilities follow the path's
// history. The sum over channels of power times weight does not change on the way.
//
// Where a majorant does not bound, channels of which more collides than the majorant's rate have null collisions of
// negative weight [Galtier2013; Novak2018]. There the mixture is of the magnitudes of what collides and what goes on,
// and their sum over channels grows by the same factor whichever is drawn.
#pragma once

#include <cmath>

#include "vpm/base/cancel.h"
#include "vpm/base/counters.h"
#include "vpm/medium/distance/mixture.h"

namespace vpm {

/// A flight under way. A strategy says where the next tentative collision is looked for, and under which majorant.
class NullCollisionFlight {
 public:
  NullCollisionFlight(const Medium& medium, const Interval& interval, const Rgb& power, Rng& rng);

  /// Moves t to the next tentative collision before t1 under that majorant (a density). Where there is none it returns
  /// false, and the flight goes on in the next stretch.
  bool advance(double& t, double t1, double majorant) {
    if (!(left_ > 0.0)) left_ = rng_.exponential();
    const double rate = sigma_t_ * majorant;
    const double reach = rate > 0.0 ? (t1 - t) * rate : 0.0;
    if (!(left_ < reach)) {
      left_ -= reach;
      return false;
    }
    cancellation_point();
    t += left_ / rate;
    left_ = 0.0;
    decision_ = rng_.uniform_double();
    return true;
  }

  /// Passes a stretch of that length if the next tentative collision is known to lie behind it. Without a branch on the
  /// density: empty bricks and others follow each other as no processor foresees.
  bool passes(double length, double majorant) {
    const double reach = length * (sigma_t_ * majorant);
    if (!(reach < left_)) return false;
    left_ -= reach;
    return true;
  }

  /// Is the tentative collision real where the density has at least that share of the majorant?
  bool is_real(double share) const { return decision_ < chance_ * share; }

  /// Ends the flight by a real collision at t.
  void collide(double t, double density) {
    flight_.collided = true;
    flight_.t = static_cast<float>(t);
    flight_.density = static_cast<float>(density);
  }

  /// Meets the tentative collision at t with the density that a look-up found there; true where it is real. A majorant
  /// that does not bound is counted, and cuts the density to itself.
  bool meet(double t, float density, double majorant) {
    count(flight_.lookups);
    double share = density / majorant;
    if (share > 1.0) {
      ++flight_.majorant_violations;
      share = 1.0;
    }
    if (is_real(share)) {
      collide(t, share * majorant);
      return true;
    }
    count(flight_.null_collisions);
    if (!grey_) weigh_null(share);
    return false;
  }

  /// The same in a stretch, whose density is looked up only where it is needed: in grey media a collision that its
  /// bounds show to be null makes no look-up, and a real one does not wait for it.
  bool meet(double t, const DensityStretch& stretch, double majorant) {
    const DensityBounds bounds = stretch.bounds(t);
    if (grey_ && !is_real(bounds.max / majorant)) {
      count(flight_.null_collisions);
      return false;
    }
    if (bounds.max > majorant || !is_real(bounds.min / majorant)) return meet(t, stretch.density(t), majorant);
    count_lookup();
    collide(t, stretch.density(t));
    return true;
  }

  /// The same, but a majorant that does not bound leaves the density whole: weights make up for it, and may be
  /// negative.
  bool meet_weighted(double t, float density, double majorant) {
    return density > majorant ? meet_beyond(t, density, majorant) : meet(t, density, majorant);
  }

  void count_lookup() { count(flight_.lookups); }

  /// The flight that ended by a real collision, or reached the interval's end, over so many bricks.
  Flight result(uint32_t bricks) const;

 private:
  bool meet_beyond(double t, float density, double majorant);
  void weigh_null(double share);
  void drop_exhausted_channels();

  Rng& rng_;
  Flight flight_;          // its weight: what all channels share
  double left_ = 0.0;      // optical thickness under the majorant up to the next tentative collision; 0: not drawn yet
  double decision_ = 0.0;  // uniform: what a tentative collision is
  double sigma_t_;         // the largest extinction at density 1 of channels that still carry power, 1/m
  double chance_ = 1.0;    // mean of extinctions over the magnitudes of the power carried, over sigma_t_
  bool grey_;
  Rgbd coefficients_;  // extinction of the channels at density 1, 1/m
  Rgbd shares_;        // of the power, when the flight began
  Rgbd weight_{1.0};   // in chromatic media; the sum of shares_ times magnitudes stays as it was
};

/// Carries a flight through the bricks on the way, in each under the majorant that majorant(its largest density) says,
/// to the first tentative collision of which meets(flight, t, stretch, majorant) is true.
template <class Majorant, class Meets>
Flight track_bricks(const Medium& medium, const Ray& ray, const Interval& interval, NullCollisionFlight flight,
                    Majorant&& majorant, Meets&& meets) {
  const auto passes = [&](double length, float max) { return flight.passes(length, majorant(max)); };
  const auto visit = [&](const DensityStretch& stretch) {
    const double most = majorant(stretch.max);
    for (double t = stretch.t0; flight.advance(t, stretch.t1, most);)
      if (meets(flight, t, stretch, most)) return false;
    return true;
  };
  return flight.result(medium.visit_majorants(ray, interval, passes, visit));
}

}  // namespace vpm
