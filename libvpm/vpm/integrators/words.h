// The words of the enumerations that settings hold.
#pragma once

#include "vpm/estimate/words.h"
#include "vpm/integrators/settings.h"

namespace vpm {

template <>
struct WordsOf<Integrator> {
  static constexpr std::array<std::string_view, 3> words{"photon-map", "path", "combined"};
};
template <>
struct WordsOf<Heuristic> {
  static constexpr std::array<std::string_view, 3> words{"balance", "power", "correlation-aware"};
};
template <>
struct WordsOf<PhotonSequence> {
  static constexpr std::array<std::string_view, 2> words{"sobol", "random"};
};
template <>
struct WordsOf<RadiusSchedule> {
  static constexpr std::array<std::string_view, 3> words{"constant", "per-pass", "per-pixel"};
};
template <>
struct WordsOf<DirectLight> {
  static constexpr std::array<std::string_view, 3> words{"photons", "shadow-rays", "equiangular"};
};
template <>
struct WordsOf<IndirectLight> {
  static constexpr std::array<std::string_view, 2> words{"photons", "final-gather"};
};
template <>
struct WordsOf<GatherBy> {
  static constexpr std::array<std::string_view, 2> words{"material", "photons"};
};
template <>
struct WordsOf<EndIrradiance> {
  static constexpr std::array<std::string_view, 2> words{"estimate", "precomputed"};
};

template <>
struct WordsOf<VolumeForm> {
  static constexpr std::array<std::string_view, 2> words{"density-at-query", "density-at-photon"};
};
template <>
struct WordsOf<BeamLength> {
  static constexpr std::array<std::string_view, 2> words{"short", "long"};
};
template <>
struct WordsOf<PlaneUse> {
  static constexpr std::array<std::string_view, 2> words{"combined", "alone"};
};

}  // namespace vpm
