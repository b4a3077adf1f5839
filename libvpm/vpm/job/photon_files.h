// Photons and their flights as files: .ply, which viewers of points open, and .csv.
#pragma once

#include <filesystem>

#include "vpm/integrators/photon_map/stored_photons.h"

namespace vpm {

/// Throws InputError where a file of these photons could not be written: an extension other than .ply and .csv, a
/// folder that is missing, a disk with too little space.
void check_photon_file(const std::filesystem::path& path);

/// Writes a row for each photon. In .ply it is a vertex: x, y, z (m), nx, ny, nz (direction of travel), power_r, _g, _b
/// (W), density, number, place, scatterings, reflections, map, event, and a colour of the power's hue; comments say
/// what the numbers of places, maps and events stand for. In .csv these are words. Throws InputError where that fails.
void write_photons(const StoredPhotons& photons, const std::filesystem::path& path);
/// The same of flights. In .ply vertices are where paths begin, and the ends of flights; edges are the flights. In .csv
/// a row is a flight. Photons with numbers of 2^32 or more have no place in a .ply.
void write_flights(const PhotonFlights& flights, const std::filesystem::path& path);

}  // namespace vpm
