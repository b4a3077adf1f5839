// The pilot of one way to render: passes with more and with fewer photons, and with other radii.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vpm/integrators/integrator.h"
#include "vpm/integrators/photon_density.h"
#include "vpm/tune/pass_model.h"
#include "vpm/tune/small_pass.h"

namespace vpm {

/// What squared errors are divided by (relative_scale), for each channel of each square of kBlock pixels.
using Scales = std::vector<Rgbd>;

/// Of a pass: its photons, and the factor of the radii.
struct PassSize {
  double photons = 0.0, radii = 1.0;
};

/// The relative squares of the light that a way misses, but another shows in the same pixels: more than four standard
/// errors, or ten where four passes say them, and twice the correction of either above what it shows.
struct Unseen {
  double in_blocks = 0.0;  // the mean of blocks
  double in_all = 0.0;     // of all together, where light is missing that no block is sure of
};

class WayPilot {
 public:
  /// What it is given by reference must live as long.
  WayPilot(const Scene& scene, const AutomaticSettings& automatic, const Clock& clock, Way way);

  /// Makes passes of ever more photons for about so many seconds. Then finds the radii that are to be chosen for as
  /// many photons as take as long as rays do.
  void find_size(double seconds);
  /// Makes so many passes of a size, though with no more than eight times the photons before, and as many with a
  /// quarter of the photons.
  void add_passes(int count, const PassSize& size);
  /// About how long one pass of either takes, s.
  double seconds_of_passes(const PassSize& size) const;

  /// What passes take, and nothing of their errors.
  PassModel times() const;
  PassModel model(const Scales& scales) const;
  /// Of squares of pixels, in the order of all blocks, two standard errors below the mean, if that is not below 0; NaN
  /// in blocks that were not followed.
  std::vector<Rgbd> surely_shown() const;
  /// The relative standard error of noise, as it differs from block to block.
  double doubt(const Scales& scales) const;
  /// The noise of the passes with most photons in each of all blocks; NaN likewise.
  std::vector<double> noise_of_blocks(const Scales& scales) const;
  Unseen unseen_beside(const WayPilot& other) const;
  /// How many were followed, in all passes, and through how many blocks.
  double rays() const;
  double blocks() const;

  /// Its settings are those that passes began with.
  const Way& way() const { return way_; }
  /// As many photons as take as long as rays do without any, by the passes so far, where their number is to be chosen.
  PassSize usual() const;
  bool chooses_photons() const;
  /// No more fit into maps of 1.3 GB.
  double most_photons() const { return most_photons_; }
  const std::vector<Choice>& radii() const { return radii_; }
  /// The radii times a factor, though no wider than kLargestRadius of the scene, are put into settings.
  void scale_radii(double factor, RenderSettings& settings) const;

 private:
  struct Passes {
    PassSize size;
    std::vector<SmallPass> made{};
  };
  SmallPass render(const PassSize& size);
  void add_pass(const PassSize& size);
  const Passes& largest() const;
  double bias2(const Scales& scales, const Line& noise, double power) const;
  template <class Use>
  void each_pass(Use&& use) const;

  const Scene* scene_;
  const AutomaticSettings* automatic_;
  const Clock* clock_;
  Way way_;
  std::vector<Choice> radii_{};
  std::optional<MapDensities> densities_{};
  BlocksTaken taken_ = BlocksTaken::quarter;
  double most_photons_ = 0.0;
  int number_ = 0;        // of the next pass
  double photons_ = 0.0;  // of the largest pass so far
  std::vector<Passes> passes_{};
};

}  // namespace vpm
