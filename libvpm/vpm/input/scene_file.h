// A scene file in TOML becomes a job: a scene, and how it is to be rendered. The format is described in
// scenes/README.md.
#pragma once

#include <string>
#include <vector>

#include "vpm/input/given_parts.h"
#include "vpm/job/render_job.h"

namespace vpm {

/// What a value stands for that may be "auto" and that the file and the options leave out: its default, or "auto".
enum class LeftOut { usual, automatic };

/// Reads a scene file and the files it names. `overrides` are `key.path=value` options that change keys of the file
/// before it is read; an element of an array of tables is addressed by its number (from 0) or its name:
/// shapes.0.radius=2, shapes.ball.radius=2. Paths in the file are relative to its folder, paths in an option to the
/// current one. `load` is called for each grid; empty: load_grid(). Throws InputError for anything that is not right,
/// telling file:line:column, or the option.
RenderJob load_scene(const std::string& path, const std::vector<std::string>& overrides = {},
                     LeftOut left_out = LeftOut::usual, const GridLoader& load = {});

/// A scene file that is in memory, and parts of it that no text holds.
struct SceneText {
  std::string name;  // what errors call it; paths in the text are relative to the folder that it names
  std::string text;  // TOML
  /// A grid of these stands in the text as `grid = "..."` of its medium, in the place of `path`, a mesh as
  /// `mesh = "..."` of its shape; what is between the quotes describes it in errors.
  GivenParts given{};
};
/// The same of a scene in memory. The given parts must live until then, and no longer.
RenderJob load_scene(const SceneText& scene, const std::vector<std::string>& overrides = {},
                     LeftOut left_out = LeftOut::usual, const GridLoader& load = {});

}  // namespace vpm
