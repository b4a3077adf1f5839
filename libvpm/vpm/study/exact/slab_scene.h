// Scenes that are a plane layer under a beam: the problem that exact/slab.h solves, and what is measured of them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vpm/job/measurement.h"
#include "vpm/scene/scene.h"
#include "vpm/study/exact/slab.h"

namespace vpm {

struct SlabScene {
  std::array<exact::Slab, 3> channels;
  /// Planes at the faces, "reflected" and "transmitted", whose normals point outwards.
  std::vector<Detector> faces;
};

/// Where the scene is one homogeneous medium in one box, lit along an axis by one light: parallel light where the box
/// repeats itself along the two other axes; or a beam, where it does, or where its sides are 20 times as far from the
/// beam as the box is thick, so that hardly any light leaves there. Nothing for others.
std::optional<SlabScene> slab_of(const Scene& scene);

/// What a slab does with a part of the light that falls on it, as measured and in truth: shares of each channel, NaN
/// where that has no light.
struct SlabShare {
  const char* name;  // "reflected", "transmitted" or "absorbed"
  Rgbd share, standard_error, exact;
};
/// Of a scene: its own detectors are measured, and where it is a slab its faces as well.
struct SlabMeasurement {
  Measurement measurement;
  std::vector<SlabShare> shares{};  // none where it is no slab
};
/// Throws as measure() does.
SlabMeasurement measure_scene(const Scene& scene, const RenderSettings& settings, const PhotonRun& run);

}  // namespace vpm
