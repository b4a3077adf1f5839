// The groups of experiments that the levels are made of.
#pragma once

#include "study/validate/ladder.h"

namespace vpm {

// Level 0.
std::vector<Experiment> flight_experiments();
std::vector<Experiment> transmittance_experiments();
std::vector<Experiment> phase_experiments();
std::vector<Experiment> emission_experiments();
std::vector<Experiment> irradiance_experiments();
std::vector<Experiment> photon_map_experiments();

// Level 1.
std::vector<Experiment> furnace_experiments();
std::vector<Experiment> convex_body_experiments();
std::vector<Experiment> infinite_medium_experiments();
std::vector<Experiment> balance_experiments();
std::vector<Experiment> symmetry_experiments();

}  // namespace vpm
