// The groups of experiments that levels are made of, and what their files share.
#pragma once

#include <array>
#include <iterator>

#include "vpm/study/validate/ladder.h"

namespace vpm {

/// Ends of checks' names.
inline constexpr std::array<const char*, 3> kOfChannel{", red channel", ", green channel", ", blue channel"};

inline void append(std::vector<Check>& all, std::vector<Check> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// Level 0.
std::vector<Experiment> flight_experiments();
std::vector<Experiment> transmittance_experiments();
std::vector<Experiment> phase_experiments();
std::vector<Experiment> outcome_experiments();
std::vector<Experiment> material_experiments();
std::vector<Experiment> filter_experiments();
std::vector<Experiment> emission_experiments();
std::vector<Experiment> irradiance_experiments();
std::vector<Experiment> photon_map_experiments();
std::vector<Experiment> border_experiments();
std::vector<Experiment> guide_experiments();
std::vector<Experiment> pane_experiments();
std::vector<Experiment> technique_experiments();

// Level 1.
std::vector<Experiment> furnace_experiments();
std::vector<Experiment> slanted_slab_experiments();
std::vector<Experiment> convex_body_experiments();
std::vector<Experiment> infinite_medium_experiments();
std::vector<Experiment> track_length_experiments();
std::vector<Experiment> balance_experiments();
std::vector<Experiment> symmetry_experiments();
std::vector<Experiment> medium_experiments();
std::vector<Experiment> picture_experiments();

// Level 2.
std::vector<Experiment> slab_experiments();
std::vector<Experiment> slab_radiance_experiments();
std::vector<Experiment> source_experiments();

// Level 3.
std::vector<Experiment> light_map_experiments();

// Level 4.
std::vector<Experiment> pass_experiments();
std::vector<Experiment> march_experiments();

}  // namespace vpm
