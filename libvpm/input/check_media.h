// Do the media that shapes name on their two sides agree with each other?
#pragma once

#include <optional>

#include "scene/scene.h"

namespace vpm {

/// A shape whose media contradict what lies around it.
struct MediaContradiction {
  uint32_t shape = 0;
  bool outside = true;          // the side at which they do
  MediumId found = kVacuum;     // the medium that the other shapes say is there
  MediumId declared = kVacuum;  // the medium that the shape says is there
};

/// Sends rays through every shape that separates media and follows the media along them, from the world's medium
/// outside the scene: a nested shape that forgets the medium around it and media that overlap in part are found. A few
/// rays in a hundred may err at edges and are forgiven. Of several shapes that err the last is told.
std::optional<MediaContradiction> find_media_contradiction(const Scene& scene);

}  // namespace vpm
