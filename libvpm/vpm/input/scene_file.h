// A scene file in TOML becomes a job: a scene, and how it is to be rendered. The format is described in
// scenes/README.md.
#pragma once

#include <string>
#include <vector>

#include "vpm/input/given_parts.h"
#include "vpm/job/render_job.h"

namespace vpm {

/// Reads a scene file and the files it names. `overrides` are `key.path=value` options that change keys of the file
/// before it is read; an element of an array of tables is addressed by its number (from 0) or its name:
/// shapes.0.radius=2, shapes.ball.radius=2. An option that names another component
/// (integrator.type=path) drops what the file and the options before it say of the one in its place and the new one
/// does not have; the job's notes list that. Paths in the file are relative to its folder, paths in an option to the
/// current one. `load` is called for each grid; empty: load_grid(). Throws InputError for anything that is not right,
/// with file:line:column, or the option.
RenderJob load_scene(const std::string& path, const std::vector<std::string>& overrides = {},
                     LeftOut left_out = LeftOut::defaults, const GridLoader& load = {});

/// The same options, those that name components first, and the integrator's before others': so the order in which a
/// user writes them does not matter.
std::vector<std::string> components_first(std::vector<std::string> overrides);

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
                     LeftOut left_out = LeftOut::defaults, const GridLoader& load = {});

}  // namespace vpm
