// A slice of a grid as a drawing: its values as colours, a scale of them, and where it lies.
#pragma once

#include <optional>
#include <string>

#include "vpm/medium/grid/density_grid.h"

namespace vpm::tools {

/// Across an axis, 0 to 2, at a coordinate, m; without one in the middle of the grid.
struct SliceWish {
  int axis = 1;
  std::optional<double> at;
};
/// "y" or "y=0.25". Throws std::invalid_argument for other texts.
SliceWish slice_wish(const std::string& text);

/// An SVG drawing that holds all it needs. Colours go from black (0) to white (the largest value of the slice), as
/// bright as values are large [Green2011, eq. 2]. `title` and `unit` are shown. Throws InputError where the slice
/// misses the grid.
std::string slice_drawing(const DensityGrid& grid, const SliceWish& wish, const std::string& title,
                          const std::string& unit);

/// What the values of a grid of that name are in, as `vpm fluence` writes them: "W/m^2"; "" for other names.
std::string unit_of_grid(const std::string& name);

}  // namespace vpm::tools
