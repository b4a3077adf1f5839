// The classes behind the names of the distance strategies.
#pragma once

#include "medium/distance/strategy.h"

namespace vpm {

class Homogeneous final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class Regular final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class LocalExtinction final : public DistanceStrategy {
 public:
  explicit LocalExtinction(float extinction_floor) : extinction_floor_(extinction_floor) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float extinction_floor_;  // as a fraction of the mean extinction
};

class MeanExtinction final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class RayMarch final : public DistanceStrategy {
 public:
  explicit RayMarch(float step) : step_(step) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float step_;  // in voxels
};

}  // namespace vpm
