// What the subcommands that run passes have in common: they can be interrupted, and print what was suspicious.
#pragma once

#include <atomic>
#include <filesystem>

#include "input/scene_file.h"
#include "render/photon_pass.h"

namespace vpm::tools {

inline constexpr int kInterrupted = 130;  // as shells report a process ended by SIGINT

/// From now on a first SIGINT or SIGTERM sets what is returned, so that what is finished can be written; a second one
/// kills.
const std::atomic<bool>& stop_on_signals();

/// What went wrong without stopping the run; on stderr, so that it is seen.
void print_warnings(const LoadedScene& loaded, const Stages& stages, const RenderStatistics& statistics);

/// The image's path: `output`, which must end in .exr; where it is empty the scene's name in the current folder.
std::filesystem::path exr_path(const std::string& output, const std::string& scene);

}  // namespace vpm::tools
