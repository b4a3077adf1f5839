// A scene file in TOML becomes a Scene and RenderSettings. The format is described in scenes/README.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vpm/render/automatic.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

struct LoadedScene {
  Scene scene;  // finished
  RenderSettings settings;
  AutomaticSettings automatic;           // those of the settings that are to be chosen: "auto"; they hold defaults
  std::vector<std::string> light_names;  // of Scene::lights: those of the shapes that emit; empty where none is given
  std::vector<std::string> notes;        // what a user should know of, e.g. clamped densities
  std::vector<std::string> files;        // that the scene names: grids, meshes, textures, environments
  std::string hash;                      // 16 hex digits, of the scene file, the options, and the bytes of those files
  uint64_t clamped_density_values = 0;   // negative densities set to 0 on the scene's request, over all grids
};

/// What a value stands for that may be "auto" and that the file and the options leave out: its default, or "auto".
enum class LeftOut { usual, automatic };

/// Reads a scene file and the files it names. `overrides` are `key.path=value` options that change keys of the file
/// before it is read; an element of an array of tables is addressed by its number (from 0) or its name:
/// shapes.0.radius=2, shapes.ball.radius=2. Paths in the file are relative to its folder, paths in an option to the
/// current one. Throws InputError for anything that is not right, telling file:line:column, or the option.
LoadedScene load_scene(const std::string& path, const std::vector<std::string>& overrides = {},
                       LeftOut left_out = LeftOut::usual);

}  // namespace vpm
