// Scenes that are a plane layer under a beam: the problem that exact/slab.h solves.
#pragma once

#include <array>
#include <optional>
#include <vector>

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

/// The solutions of the channels; equal ones are solved once.
std::array<exact::SlabSolution, 3> solve(const SlabScene& slab);

}  // namespace vpm
