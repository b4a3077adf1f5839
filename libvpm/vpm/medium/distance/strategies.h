// The classes behind the names of the distance strategies.
#pragma once

#include "vpm/medium/distance/strategy.h"

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

class RayMarchAdaptive final : public DistanceStrategy {
 public:
  RayMarchAdaptive(float step, float optical_step) : step_(step), optical_step_(optical_step) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float step_;          // the longest, in voxels
  float optical_step_;  // optical thickness of a step, under the largest density around
};

class Delta final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class DeltaLocal final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class ProgressiveNull final : public DistanceStrategy {
 public:
  /// The majorant of pass 0, as a share of the medium's largest density. It doubles with every pass.
  ProgressiveNull(float majorant, uint64_t pass);
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  double share_;  // the most that a majorant may be of the medium's largest density
};

class Weighted final : public DistanceStrategy {
 public:
  explicit Weighted(float majorant) : majorant_(majorant) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float majorant_;  // the most that a majorant may be, as a share of the medium's largest density
};

class Decomposition final : public DistanceStrategy {
 public:
  explicit Decomposition(bool needs_density) : needs_density_(needs_density) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  bool needs_density_;  // at collisions
};

}  // namespace vpm
