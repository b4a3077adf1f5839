// Where to emit: a density over the uniform numbers of which photons are made, learned from what they came to.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "vpm/photon/emission.h"

namespace vpm {

/// A density over emission points, constant in the boxes of a tree of halvings. It knows nothing of lights: each shape
/// and kind is guided alike, as whatever its numbers mean, it is what they lead to that counts.
class EmissionGuide {
 public:
  /// The uniform density.
  EmissionGuide() : nodes_(1) {}

  struct Sample {
    EmissionPoint point;
    float density = 1.0f;  // over the cube, > 0
  };
  Sample sample(Rng& rng) const;

  /// What an emission came to, >= 0.
  using Score = std::function<float(const EmissionPoint& point, Rng& rng)>;
  /// Learns a density near to the root mean square score: that of least variance where what photons carry is summed. A
  /// tenth of it is uniform, so that no photon becomes much heavier than without. `scouts` >= 1 points are scored, in
  /// rounds each of which draws from the one before. `score` is called from several threads at once, with the random
  /// numbers of its scout alone, of that seed and stream.
  static EmissionGuide learn(uint64_t scouts, uint64_t seed, uint64_t stream, const Score& score);

  /// The mean over uniform emission points of what learn() scored.
  double mean_score() const { return mean_score_; }
  size_t memory_bytes() const { return nodes_.size() * sizeof(Node); }

 private:
  struct Node {
    int dimension = -1;  // that is halved; -1: a leaf
    uint32_t child = 0;  // the lower half's; the upper half's is the next one
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
