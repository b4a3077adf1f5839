// What is asked of a scene once it is put together: do its shapes agree with each other? And what a user should know of
// it: possible, but more than single precision resolves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vpm/scene/scene.h"

namespace vpm {

/// A shape whose media contradict what lies around it.
struct MediaContradiction {
  uint32_t shape = 0;
  bool outside = true;          // the side at which they do
  MediumId found = kVacuum;     // the medium that the other shapes say is there
  MediumId declared = kVacuum;  // the medium that the shape says is there
};

/// Sends rays through every shape that separates media, and follows the media along them, from the world's medium
/// outside the scene. This finds nested shapes that do not name the medium around them, and media that overlap in part.
/// A few rays in a hundred may err at edges; that is tolerated. Of several shapes that err, the last is returned.
std::optional<MediaContradiction> find_media_contradiction(const Scene& scene);

/// Two shapes with a face in common.
struct CommonFace {
  uint32_t shape = 0;
  uint32_t other = 0;  // of a smaller number
};

/// Sends rays through every shape that light passes, and looks for faces of two shapes that coincide as far as rays
/// resolve. Light would meet only one of the two, where both count: two dielectrics, or a boundary and a dielectric
/// that does not name its media. A common face of a tenth of a box's surface is overlooked with a probability of about
/// 1e-6.
std::optional<CommonFace> find_common_face(const Scene& scene);

/// What is to be said of the temperatures by which a medium emits, where they reach less than 700 K or more than 20,000
/// K; "" elsewhere.
std::string doubt_of_temperatures(const Medium& medium);

/// Sentences about a finished scene: such doubts, that it stands so far from the origin that the spacing of floats
/// there shows in its shapes, and which media have free paths shorter than floats resolve positions.
std::vector<std::string> notes_of(const Scene& scene);

}  // namespace vpm
