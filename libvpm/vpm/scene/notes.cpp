// The spacing of floats where the scene stands, against its size and its media's free paths.
#include "vpm/scene/notes.h"

#include <fmt/format.h>

#include <algorithm>

namespace vpm {
namespace {

/// Tells of a scene so far from the origin that the spacing of floats there shows in its shapes.
void note_unresolved_place(const Box& bounds, std::vector<std::string>& notes) {
  if (bounds.empty()) return;
  constexpr double kVisible = 1e-4;  // of the scene's size
  const Vec3 apart = glm::abs(bounds.centre());
  const float far = std::max({apart.x, apart.y, apart.z});
  const double spacing = double(std::nextafter(far, kInfinity)) - far;
  if (spacing > kVisible * bounds.diagonal())
    notes.push_back(fmt::format(
        "the scene, {:.2g} m across, is {:.2g} m from the origin, where positions are {:.2g} m apart: its shapes are "
        "rounded to that; move it to the origin",
        bounds.diagonal(), glm::length(bounds.centre()), spacing));
}

/// Tells of media whose free paths are shorter than floats resolve positions: what enters these does not come out
/// again.
void note_unresolved_media(const Scene& scene, std::vector<std::string>& notes) {
  constexpr double kSparse = 0.1;  // of a grid's diagonal
  const Box& bounds = scene.bounds;
  const double resolved =
      0x1p-20 * (glm::length(bounds.centre()) + 0.5 * bounds.diagonal());  // m: a few units in the last place
  for (const Medium& medium : scene.media) {
    const double extinction = double(max_channel(medium.sigma_t)) * medium.max_density();  // 1/m
    if (!medium.scatters() || !(extinction * resolved > 1.0)) continue;
    const bool sparse = medium.grid && medium.grid->extent() < kSparse * medium.grid->bounds().diagonal();
    notes.push_back(fmt::format(
        "medium '{}': its free paths, down to {:.2g} m, are shorter than positions of this scene resolve, {:.2g} m: "
        "light that enters it stays there{}",
        medium.name, 1.0 / extinction, resolved,
        sparse ? "; its grid is far wider than what it holds: bound that by a shape, near the origin" : ""));
  }
}

}  // namespace

std::vector<std::string> notes_of(const Scene& scene) {
  std::vector<std::string> notes;
  note_unresolved_place(scene.bounds, notes);
  note_unresolved_media(scene, notes);
  return notes;
}

}  // namespace vpm
