// What distinguishes one render from another: passes of different renders do not add up.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vpm/job/render_job.h"

namespace vpm {

/// Names and values, without line feeds: the program, what the scene holds, key by key, the seed, every setting that
/// decides what passes estimate, and, where the job leaves settings to be chosen, which ones, and which of them were.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// The identity of a job after choose(). Two scenes made in code differ by RenderJob::hash alone.
Identity identity_of(const RenderJob& job);

/// The settings that were chosen when the render of this identity began.
std::vector<Choice> choices_of(const Identity& identity);

/// A title with the number of fields, and a line "name=value" for each: any bytes but line feeds come back as they
/// were.
std::string lines_of(std::string_view title, const Identity& identity);
/// Takes such lines off the front of a text; nothing where they are not that.
std::optional<Identity> take_lines(std::string_view& text, std::string_view title);

/// A line for each field in which two differ, which are called so: "render.seed: 1 in the checkpoint, 9 asked for".
std::string differences(const Identity& a, const Identity& b, const std::string& of_a, const std::string& of_b);

}  // namespace vpm
