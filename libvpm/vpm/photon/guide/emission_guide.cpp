// Growing the tree of halvings, and drawing from it.
#include "vpm/photon/guide/emission_guide.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr uint64_t kRounds = 4;
constexpr double kSignificant = 3.0;   // standard deviations: the oddness of a quarter's share that is more than chance
constexpr double kLeastGain = 0.02;    // of the standard deviation, by which a halving must pay
constexpr int kDeepest = 40;           // halvings
constexpr double kUniformShare = 0.1;  // of the density
constexpr size_t kScoutChunk = 1024;   // scouts scored one after another

using Corner = std::array<double, EmissionPoint::kDimensions>;

/// A box of emission points: halves of halves of the cube.
struct Cell {
  Corner lo{};
  Corner size;
  double volume = 1.0;
  Cell() { size.fill(1.0); }

  double middle(int d) const { return lo[static_cast<size_t>(d)] + 0.5 * size[static_cast<size_t>(d)]; }
  /// Which quarter along an axis a point of the box lies in.
  size_t quarter(int d, double x) const {
    const auto i = static_cast<size_t>(d);
    return std::min<size_t>(3, static_cast<size_t>((x - lo[i]) / size[i] * 4.0));
  }
  Cell half(int d, bool upper) const {
    Cell result = *this;
    const auto i = static_cast<size_t>(d);
    result.size[i] *= 0.5;
    result.volume *= 0.5;
    if (upper) result.lo[i] += result.size[i];
    return result;
  }
};

}  // namespace

EmissionGuide::Sample EmissionGuide::sample(Rng& rng) const {
  Sample result;
  Cell cell;
  double density = 1.0;
  for (const Node* node = &nodes_[0]; node->dimension >= 0;) {
    const bool upper = rng.uniform_double() >= node->lower;
    density *= 2.0 * (upper ? 1.0 - node->lower : node->lower);
    cell = cell.half(node->dimension, upper);
    node = &nodes_[node->child + (upper ? 1 : 0)];
  }
  for (int d = 0; d < EmissionPoint::kDimensions; ++d) {
    const auto i = static_cast<size_t>(d);
    result.point.set(d, cell.lo[i] + cell.size[i] * rng.uniform_double());
  }
  result.density = static_cast<float>(density);
  return result;
}

/// Halves boxes as long as that pays.
///
/// Scores summed with weights 1 / density have the least variance where the density follows the root mean square score
/// of each place. A box of volume V whose scouts' squares sum to S then deserves probability in proportion to
/// sqrt(V S), and halving it lowers the standard deviation that is left in proportion to the sum of these roots.
class EmissionGuide::Grower {
 public:
  Grower(std::vector<Node>& nodes, std::vector<Scored>& scored) : nodes_(nodes), scored_(scored) {}

  void grow() {
    const double total = wish(0, scored_, Cell(), 0);
    if (total > 0.0) settle(0, Cell().volume, total);
  }

 private:
  /// Grows the tree below a node; returns the sum of its leaves' wishes sqrt(V S).
  double wish(uint32_t node, std::span<Scored> inside, const Cell& cell, int depth) {
    if (wishes_.size() <= node) wishes_.resize(node + 1);
    const int dimension = depth < kDeepest ? best_halving(inside, cell) : -1;
    if (dimension < 0) return wishes_[node] = std::sqrt(cell.volume * sum(inside));
    const auto middle = std::partition(inside.begin(), inside.end(),
                                       [&](const Scored& s) { return s.point[dimension] < cell.middle(dimension); });
    const auto lower = static_cast<size_t>(middle - inside.begin());
    const auto child = static_cast<uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].dimension = dimension;
    nodes_[node].child = child;
    const double below = wish(child, inside.first(lower), cell.half(dimension, false), depth + 1);
    const double above = wish(child + 1, inside.subspan(lower), cell.half(dimension, true), depth + 1);
    return wishes_[node] = below + above;
  }

  /// Turns wishes into the probabilities of lower halves.
  void settle(uint32_t node, double volume, double total) {
    Node& n = nodes_[node];
    if (n.dimension < 0) return;
    const auto probability = [&](uint32_t child) {
      return (1.0 - kUniformShare) * wishes_[child] / total + kUniformShare * 0.5 * volume;
    };
    const double lower = probability(n.child), upper = probability(n.child + 1);
    n.lower = lower / (lower + upper);
    settle(n.child, 0.5 * volume, total);
    settle(n.child + 1, 0.5 * volume, total);
  }

  /// The dimension whose quarters gain most; -1 where none gain enough. Halves may be alike where quarters are not.
  static int best_halving(std::span<const Scored> inside, const Cell& cell) {
    double whole = 0.0, squares = 0.0;
    std::array<std::array<double, 4>, EmissionPoint::kDimensions> quarters{};
    for (const Scored& s : inside) {
      if (s.square == 0.0) continue;
      whole += s.square;
      squares += s.square * s.square;
      for (int d = 0; d < EmissionPoint::kDimensions; ++d)
        quarters[static_cast<size_t>(d)][cell.quarter(d, s.point[d])] += s.square;
    }
    if (whole == 0.0) return -1;
    // The standard deviation of a quarter's share, were all alike.
    const double chance = std::sqrt(0.25 * 0.75 * squares) / whole;
    int best = -1;
    double most = kLeastGain;
    for (int d = 0; d < EmissionPoint::kDimensions; ++d) {
      double roots = 0.0, oddest = 0.0;
      for (const double quarter : quarters[static_cast<size_t>(d)]) {
        roots += std::sqrt(quarter / whole);
        oddest = std::max(oddest, std::abs(quarter / whole - 0.25));
      }
      if (oddest >= kSignificant * chance && 1.0 - 0.5 * roots > most) {
        most = 1.0 - 0.5 * roots;
        best = d;
      }
    }
    return best;
  }

  static double sum(std::span<const Scored> inside) {
    double result = 0.0;
    for (const Scored& s : inside) result += s.square;
    return result;
  }

  std::vector<Node>& nodes_;
  std::vector<Scored>& scored_;
  std::vector<double> wishes_;
};

EmissionGuide EmissionGuide::learn(uint64_t scouts, uint64_t seed, uint64_t stream, const Score& score) {
  EmissionGuide guide;
  std::vector<Scored> all(scouts);
  for (uint64_t round = 0; round < kRounds; ++round) {
    const uint64_t first = scouts * round / kRounds, end = scouts * (round + 1) / kRounds;
    parallel_for_chunks(end - first, kScoutChunk, [&](size_t begin, size_t stop, size_t) {
      for (size_t i = first + begin; i < first + stop; ++i) {
        Rng rng(seed, stream, i);
        const Sample drawn = guide.sample(rng);
        const double value = score(drawn.point, rng);
        all[i] = {drawn.point, value / drawn.density, value * value / drawn.density};
      }
    });
    std::vector<Scored> so_far(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(end));
    guide = EmissionGuide();
    Grower(guide.nodes_, so_far).grow();
  }
  for (const Scored& s : all) guide.mean_score_ += s.score / static_cast<double>(scouts);
  return guide;
}

}  // namespace vpm
