// Directions for the rays of final gathering at one point, drawn to where its photons came from [Jensen1995].
//
// The nearest photons make a histogram over cells of both hemispheres. Each photon adds what the surface scatters of
// its power towards the eye to the cell that it came from. A fraction of the rays (`share_`) is drawn from the
// histogram, the others as the material scatters. All are weighted by the mixture density of both (the balance
// heuristic of one sample [Veach1997, sec. 9.2]). This is right whatever the photons say. No ray weighs more than
// 1/(1 - share_) times what it would weigh by the material alone.
//
// The photons are those that a non-specular surface scattered last, from a map of their own, because rays gather the
// light of these and no other. Photons straight from lights, mirrors and glass would send the rays to where nothing is
// left for them to find.
#pragma once

#include <array>

#include "vpm/base/rng.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/photon_map/estimator.h"

namespace vpm {

/// The settings of gathers from that map, except the largest radius. That one depends on the scene, not on other maps:
/// what the photons say need not be sharp.
inline constexpr GatherSettings kGuidingPhotons{.mode = GatherMode::nearest, .count = 100};

class GatherGuide {
 public:
  /// Draws as the material scatters. The view must outlive the guide.
  explicit GatherGuide(const SurfaceView& view) : view_(view) {}
  /// Learns from a map, gathered by count, of photons that non-specular surfaces scattered last. The fewer photons are
  /// near, the smaller is the fraction of rays drawn from them.
  GatherGuide(const SurfaceView& view, const PhotonMap& from_rough, GatherWork work);

  /// How a gathering ray leaves; black: no ray.
  Scatter sample(Rng& rng) const;

 private:
  // Cells of equal cosine-weighted solid angle pi / kOfSide. Those of the hemisphere that the path came from are first.
  static constexpr int kRings = 4;    // of sin^2 to the shading normal
  static constexpr int kSectors = 8;  // of the azimuth
  static constexpr int kOfSide = kRings * kSectors;

  Scatter sample_by_material(Rng& rng) const;
  Scatter sample_by_photons(Rng& rng) const;
  int cell_of(const Vec3& direction) const;
  /// The density of sample(), 1/sr, given that of the material.
  float density(const Vec3& direction, float of_material) const;

  const SurfaceView& view_;
  float share_ = 0.0f;                       // the fraction of rays drawn by photons
  std::array<Vec3, 2> normals_;              // the axes of the hemispheres, unit
  std::array<double, 2 * kOfSide> up_to_{};  // sum of what photons added to the cells up to this one
};

}  // namespace vpm
