// The pilot of one way to render: passes with more and with fewer photons, and with other radii.
#pragma once

#include <vector>

#include "vpm/integrators/integrator.h"
#include "vpm/tune/pass_model.h"
#include "vpm/tune/shown_light.h"

namespace vpm {

/// Of a pass: its photons, and the factor of the radii.
struct PassSize {
  double photons = 0.0, radii = 1.0;
};

class WayPilot {
 public:
  /// Keeps references to scene, settings and clock.
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
  /// The noise of the passes with most photons in each block.
  std::vector<double> noise_of_blocks(const Scales& scales) const;
  /// The means of squares of pixels.
  const MeansOfPasses& squares() const { return squares_; }
  ShownLight light() const { return shown_light(blocks_, corrections_); }
  /// Of each block, in all passes.
  double pixels_of_block() const { return static_cast<double>(kBlockRays * blocks_.means()[0][0].count()); }

  /// Its settings are those that passes began with.
  const Way& way() const { return way_; }
  /// As many photons as take as long as rays that gather none, by the passes so far, where their number is to be
  /// chosen.
  PassSize usual() const;
  bool chooses_photons() const { return chooses_photons_; }
  /// No more fit into maps of 1.3 GB.
  double most_photons() const { return most_photons_; }
  const std::vector<Choice>& radii() const { return radii_; }
  /// The factor by which all of these may be wider; see widest_factor().
  double widest() const { return widest_; }

 private:
  struct Passes {
    PassSize size;
    std::vector<SmallPass> made{};
  };
  SmallPass render(const PassSize& size);
  void add_pass(const PassSize& size);
  const Passes& largest() const;
  double bias2(const Scales& scales) const;

  const Scene* scene_;
  const AutomaticSettings* automatic_;
  const Clock* clock_;
  Way way_;
  bool has_photons_, chooses_photons_;
  std::vector<Choice> radii_{};
  double widest_ = 1.0;
  double most_photons_ = 0.0, given_ = 0.0;  // of a pass; by the settings
  int number_ = 0;                           // of the next pass
  double photons_ = 0.0;                     // of the last passes
  std::vector<Passes> passes_{};
  MeansOfPasses squares_{kBlock}, blocks_{kBlockRays}, corrections_{kBlockRays, &KernelEstimate::correction};
};

}  // namespace vpm
