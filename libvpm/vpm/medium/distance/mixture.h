// The one-sample mixture over colour channels that keeps chromatic media free of fireflies: a distance is drawn for a
// channel chosen by its share of the photon's power, and weighted by the mixture of all channels' densities
// [Wilkie2014].
#pragma once

#include "vpm/base/rng.h"
#include "vpm/base/vec.h"
#include "vpm/medium/distance/strategy.h"

namespace vpm {

/// The shares of the channels in a power, by magnitude: those of a path's may differ in sign. Equal ones where it is
/// black.
inline Rgb channel_shares(const Rgb& power) {
  const Rgb magnitudes = glm::abs(power);
  const float sum = sum_channels(magnitudes);
  return sum > 0.0f ? magnitudes / sum : Rgb(1.0f / 3.0f);
}

/// The value of the channel that a uniform number picks by `shares`.
inline float pick_channel(const Rgb& values, const Rgb& shares, float u) {
  if (u < shares.r) return values.r;
  return u < shares.r + shares.g ? values.g : values.b;
}

/// The weight of a flight across the density `integral`, m, whose distance was drawn from the transmittance of one
/// channel, picked by `shares`. 1 in a grey medium.
Rgb analog_weight(const Medium& medium, const Rgb& shares, double integral, bool collided);

/// The exact flight in a medium of constant density [Jarosz2008, eq. 7.6 and 7.7, whose density lacks the factor
/// sigma_t].
Flight homogeneous_flight(const Medium& medium, const Interval& interval, const Rgb& power, Rng& rng);

/// A flight whose distance is drawn from exp(-rate d), rates per channel in 1/m, with the weights that correct it for
/// the medium's transmittance.
Flight exponential_flight(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& rate,
                          const Rgb& power, Rng& rng);

}  // namespace vpm
