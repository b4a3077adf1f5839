// The light that microfacets lose because each sends it on once, and the even lobes that give it back [Kulla2017].
//
// What would meet a second facet is left out of RoughConductor's and RoughDielectric's main lobes: the more, the
// rougher. Light that has met several has forgotten where it came from, so the loss returns in proportion to how much
// of a direction's light is lost: with E the share that the main lobe keeps at a cosine, (1 - E(v)) (1 - E(w)) over pi
// times the mean of 1 - E. By that all light that is not absorbed leaves the surface, and the BSDF stays reciprocal.
#pragma once

#include <array>
#include <memory>

#include "vpm/surface/material.h"

namespace vpm {

class FacetLoss {
 public:
  /// Integrates the material's main lobes.
  explicit FacetLoss(const RoughConductor& material);
  explicit FacetLoss(const RoughDielectric& material);

  /// The fraction of light that the main lobes lose, of what arrives at a cosine in [0, 1] on that side, except what
  /// metal absorbs.
  float lost(bool outside, float cosine) const;
  /// Of what is lost of light on that side, the share that returns there.
  float returned(bool outside) const { return side(outside).returned; }
  /// The BSDF, 1/sr, of the lobe that light takes from `cosine` on the side `outside` to `cosine_after`, there or on
  /// the other side.
  Rgb lobe(bool outside, float cosine, bool transmitted, float cosine_after) const;

 private:
  static constexpr int kCosines = 64;
  struct Side {
    std::array<float, kCosines> lost{};  // at cosines i / (kCosines - 1)
    double mean = 0.0;                   // of light from everywhere
    float returned = 1.0f;
  };
  const Side& side(bool outside) const { return sides_[outside ? 0 : 1]; }
  template <class Kept>
  static Side integrate(Kept&& kept);

  std::array<Side, 2> sides_;  // outside, inside
  Rgb tint_{1.0f};             // what further reflections on metal leave of light that would be lost
};

/// The loss of a material of microfacets; null for others.
std::shared_ptr<const FacetLoss> facet_loss_of(const Material& material);
/// Lets a material of microfacets give back its loss, which must live as long as it; others stay as they are.
void set_facet_loss(Material& material, const FacetLoss* loss);

}  // namespace vpm
