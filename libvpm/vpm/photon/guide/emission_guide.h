// Guided emission: a density over the uniform numbers that determine an emission, learned from the scores of scouts.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "vpm/photon/emission.h"

namespace vpm {

/// A density over emission points. It is constant in each leaf of a tree that halves the cube of emission points again
/// and again. It does not depend on the kind or shape of lights: whatever the numbers mean to a light, only the scores
/// of the emissions count.
class EmissionGuide {
 public:
  /// The uniform density.
  EmissionGuide() : nodes_(1) {}

  struct Sample {
    EmissionPoint point;
    float density = 1.0f;  // over the cube, > 0
  };
  Sample sample(Rng& rng) const;

  /// How much an emission contributes, >= 0.
  using Score = std::function<float(const EmissionPoint& point, Rng& rng)>;
  /// Learns a density that is roughly proportional to the root mean square score. That density gives sums over photons
  /// the least variance. A tenth of it is uniform, so that no photon's power grows much by the guiding. `scouts` >= 1
  /// points are scored in rounds; each round draws from the density of the round before. `score` is called from several
  /// threads at once. Each scout has its own random numbers, from `seed` and `stream`.
  static EmissionGuide learn(uint64_t scouts, uint64_t seed, uint64_t stream, const Score& score);

  /// The mean score over uniform emission points, as learn() estimated it.
  double mean_score() const { return mean_score_; }
  size_t memory_bytes() const { return nodes_.size() * sizeof(Node); }

 private:
  struct Node {
    int dimension = -1;  // the dimension that is halved; -1: a leaf
    uint32_t child = 0;  // number of the lower half's node; the upper half's is the next one
    double lower = 0.5;  // the probability of the lower half
  };
  struct Scored {
    EmissionPoint point;
    double score = 0.0;   // over the density the point was drawn with
    double square = 0.0;  // score^2 over that density
  };
  class Grower;

  std::vector<Node> nodes_;
  double mean_score_ = 0.0;
};

}  // namespace vpm
