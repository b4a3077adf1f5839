// A scene around a grid of which nothing is known but its file: what `vpm view` shows.
#pragma once

#include <string>
#include <vector>

#include "vpm/input/grid/grid_file.h"

namespace vpm {

/// The axis of the world that is up in a grid's file.
enum class UpAxis { y, z };

/// What a user says of the view.
struct ViewWishes {
  std::string grid{};          // its name; empty: the one that can be meant
  double optical_depth = 5.0;  // across the medium, > 0
  UpAxis up = UpAxis::y;
  double aspect = 1.0;  // width over height of the picture
};

/// A scene file's text, what a user should know of how it came about, and the grid, which the scene asks for so.
struct ViewScene {
  std::string text;
  std::vector<std::string> notes{};
  GridRequest request{};
  LoadedGrid grid{};
};

/// The name of the grid that is to be shown: that of `wish`; or of the grids of numbers the only one, or the one named
/// "density". Throws InputError, listing the grids, where none or several could be meant.
std::string grid_to_show(const std::string& path, const std::vector<GridSummary>& grids, const std::string& wish);

/// Makes a commented scene file that shows a grid of `path`, which is written into it as `path_in_scene`: seen from a
/// little above, over a round floor, lit by a spot and a dim sky, all sized by the part of the grid where densities are
/// not small, with an extinction such that nine tenths of the columns across have no more than the wished optical
/// depth. A level set becomes a fog; negative densities are read as 0, and counted. A grid of temperatures or flames
/// beside the density makes it glow: values up to 700 to 20,000 are kelvin, flames up to 1 are 1500 to 3000 K, others
/// are scaled such that the largest is 2000 K. Throws InputError as grid_to_show() and load_grid(), and for a grid that
/// is 0 everywhere.
ViewScene make_view_scene(const std::string& path, const std::string& path_in_scene, const ViewWishes& wishes);

}  // namespace vpm
