// Convex bodies of one medium in a vacuum, and scenes of white surfaces in a medium, under light of the same radiance
// from everywhere.
#pragma once

#include <string>

#include "vpm/medium/distance/strategy.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Light of radiance 1 W/(m^2 sr) comes from all directions; of a body of albedo 1 none gets lost, and everywhere the
/// radiance stays 1 (behind glass: the square of its index).
struct LitBody {
  std::string name;
  Scene scene;
  double volume = 0.0;        // m^3
  double area = 0.0;          // m^2
  double mean_density = 1.0;  // over the volume
  double radiance = 1.0;      // inside, W/(m^2 sr)
};

/// A sphere of radius 1 m.
LitBody lit_sphere(std::string name, const Medium& medium);
/// The same in a skin of glass of that index of refraction. Inside the radiance is its square.
LitBody lit_glass(std::string name, const Medium& medium, float ior);
/// The box of the test fields.
LitBody lit_box(std::string name, const Medium& medium);

/// White surfaces in the box: a sphere that scatters, one that mirrors, one of glass.
Scene furnished_box(const Medium& medium);
/// A large white ball in the box, and a bubble in it whose wall is glass.
Scene box_around_balls(const Medium& medium);
/// A room whose walls glow evenly, six lights of three sizes, and reflect half of what they get; in it a white ball.
/// Shadow rays and paths that run into walls share what they find, by the lights' densities and probabilities.
Scene glowing_room(const Medium& medium);
/// A room and a box in it, both glowing, as one mesh: points of it stand in each other's light.
Scene glowing_mesh(const Medium& medium);

/// The extinction coefficient (1/m) under which a strategy is tested in a grid. Weights without bound, up to the ratio
/// of the largest density to the mean, multiply from event to event: that ratio and the events must not both be large,
/// or their variance is infinite. Signed weights multiply within flights, too, and need a thinner medium still.
Rgb tested_extinction(const StrategyInfo& info, const DensityGrid& grid);

/// A medium that absorbs nothing.
Medium white_medium(std::shared_ptr<const DensityGrid> grid, const Rgb& sigma_t, const Phase& phase);

}  // namespace vpm
