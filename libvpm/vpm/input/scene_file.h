// A scene file in TOML becomes a job: a scene, and how it is to be rendered. The format is described in
// scenes/README.md.
#pragma once

#include <string>
#include <vector>

#include "vpm/job/render_job.h"

namespace vpm {

/// What a value stands for that may be "auto" and that the file and the options leave out: its default, or "auto".
enum class LeftOut { usual, automatic };

/// Reads a scene file and the files it names. `overrides` are `key.path=value` options that change keys of the file
/// before it is read; an element of an array of tables is addressed by its number (from 0) or its name:
/// shapes.0.radius=2, shapes.ball.radius=2. Paths in the file are relative to its folder, paths in an option to the
/// current one. Throws InputError for anything that is not right, telling file:line:column, or the option.
RenderJob load_scene(const std::string& path, const std::vector<std::string>& overrides = {},
                     LeftOut left_out = LeftOut::usual);
/// Reads a text as the scene file of that name, whether or not there is such a file: its folder is where relative paths
/// start from.
RenderJob load_scene_text(const std::string& text, const std::string& name,
                          const std::vector<std::string>& overrides = {}, LeftOut left_out = LeftOut::usual);

}  // namespace vpm
