// The light that a microfacet model loses because it scatters light at one facet only, and additional smooth lobes that
// give it back [Kulla2017].
//
// The main lobes of RoughConductor and RoughDielectric leave out light that would meet a second facet. The rougher the
// surface, the more is lost. Light that has met several facets hardly depends on where it came from. It is therefore
// returned into each direction in proportion to the fraction of that direction's light that is lost. Let E be the
// fraction that the main lobe keeps at a cosine: the added lobe is (1 - E(v)) (1 - E(w)) / (pi mean(1 - E)). With it
// all light that is not absorbed leaves the surface, and the BSDF stays reciprocal.
#pragma once

#include <array>
#include <memory>

#include "vpm/surface/material/material.h"

namespace vpm {

class FacetLoss {
 public:
  /// Integrates the material's main lobes.
  explicit FacetLoss(const RoughConductor& material);
  explicit FacetLoss(const RoughDielectric& material);

  /// The fraction that the main lobes lose of the light that arrives on that side at a cosine in [0, 1]. Light that the
  /// metal absorbs is not counted as lost.
  float lost(bool outside, float cosine) const;
  /// The fraction of the light lost on that side that returns to the same side.
  float returned(bool outside) const { return side(outside).returned; }
  /// The BSDF, 1/sr, of the added lobe, for light that arrives at `cosine` on the side `outside` and leaves at
  /// `cosine_after`: on the other side if `transmitted`, else on the same one.
  Rgb lobe(bool outside, float cosine, bool transmitted, float cosine_after) const;

 private:
  static constexpr int kCosines = 64;
  struct Side {
    std::array<float, kCosines> lost{};  // at cosines i / (kCosines - 1)
    double mean = 0.0;                   // fraction lost of light that arrives evenly from all directions
    float returned = 1.0f;
  };
  const Side& side(bool outside) const { return sides_[outside ? 0 : 1]; }
  template <class Kept>
  static Side integrate(Kept&& kept);

  std::array<Side, 2> sides_;  // outside, inside
  Rgb tint_{1.0f};             // fraction of the lost light that further reflections on metal leave
};

/// The loss of a material of microfacets; null for others.
std::shared_ptr<const FacetLoss> facet_loss_of(const Material& material);
/// Lets a material of microfacets give back its loss. `loss` must live as long as the material. Other materials stay as
/// they are.
void set_facet_loss(Material& material, const FacetLoss* loss);

}  // namespace vpm
