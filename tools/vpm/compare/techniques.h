// What the techniques of a method find, as a comparison keeps it and tells it.
#pragma once

#include <vector>

#include "json.h"
#include "vpm/job/found_by_techniques.h"

namespace vpm::tools {

/// An array of objects, as the report of a render has it. What is not a number becomes null in its text.
Json techniques_json(const std::vector<FoundByTechnique>& all);
/// Throws Json::exception for what is no such array.
std::vector<FoundByTechnique> techniques_of(const Json& all);

/// The means over those of the repetitions (at least one) that use the same techniques as the first: it may be for each
/// to choose, and shares sum to 1 only over one choice.
std::vector<FoundByTechnique> mean_of_techniques(const std::vector<std::vector<FoundByTechnique>>& repetitions);

}  // namespace vpm::tools
