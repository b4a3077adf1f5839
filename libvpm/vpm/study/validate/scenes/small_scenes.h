// The small scenes on which ways to the same picture are compared.
#pragma once

#include <string>

#include "vpm/scene/build.h"

namespace vpm {

/// A chromatic, forward scattering fog everywhere, in it a glowing ball and, out of sight, a weaker light of another
/// colour; seen from inside.
Scene foggy_light();

/// Where the cloud is seen from.
enum class Viewpoint { outside, border, inside };
/// A grid whose density falls smoothly to 0 at the faces of [-1, 1]^3, lit by a spot light from outside.
/// `thickness`: the largest optical thickness across it.
Scene small_cloud(Viewpoint viewpoint, const Rgb& thickness);

/// The box [-1, 1]^3 of one density, as a homogeneous medium or as a constant grid, under a light.
Scene filled_box(bool grid);

/// A floor and a coloured wall under a light, in vacuum. The camera sees the floor, which a second light lights from
/// below. With a ball of glass of that index of refraction above it where `ior` > 0.
Scene lit_corner(float ior = 0.0f);

/// A floor that gets its light from a wall alone, at which a spot light points, in vacuum; seen is the floor. Both are
/// shaded as if they leaned towards each other.
Scene leaning_wall();

/// A sheet of rough glass next to a wall of rough metal and under a light, in vacuum. The camera sees the sheet,
/// through which a second light shines from below.
Scene rough_corner();

/// A floor in a fog, under a light; seen is the floor.
Scene foggy_floor();

/// A grey floor alone with a point light near it: on some pixels bright, on others dark. Photons meet it once.
Scene bare_floor();

/// A wall of a closed cube about a light: most of what is seen was reflected before.
Scene hollow_cube();

}  // namespace vpm
