// What declarations of settings are written with: members of RenderSettings, and the words of enumerators.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <limits>
#include <span>
#include <type_traits>

#include "vpm/job/setting.h"

namespace vpm {

/// No limit to an integer. Scene files have smaller ones, by TOML.
inline constexpr uint64_t kAnyInteger = std::numeric_limits<uint64_t>::max();

/// The words of an enumeration, in the order of its enumerators.
template <class Enum>
struct WordsOf;
template <>
struct WordsOf<Integrator> {
  static constexpr std::array<std::string_view, 3> words{"photon", "path", "combined"};
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
struct WordsOf<GatherMode> {
  static constexpr std::array<std::string_view, 6> words{"radius",       "nearest",       "beam",
                                                         "photon-beams", "photon-planes", "beams-points"};
};
template <>
struct WordsOf<BeamLength> {
  static constexpr std::array<std::string_view, 2> words{"short", "long"};
};
template <>
struct WordsOf<PlaneUse> {
  static constexpr std::array<std::string_view, 2> words{"combined", "alone"};
};
template <>
struct WordsOf<KernelKind> {
  static constexpr auto words = [] {
    std::array<std::string_view, kKernels.size()> names;
    for (size_t i = 0; i < names.size(); ++i) names[i] = kKernels[i].name;
    return names;
  }();
};
template <>
struct WordsOf<BoundaryRule> {
  static constexpr std::array<std::string_view, 3> words{"none", "corrected", "ends"};
};
template <>
struct WordsOf<VolumeForm> {
  static constexpr std::array<std::string_view, 2> words{"density-at-query", "density-at-photon"};
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

template <class Enum>
std::string word_of(Enum value) {
  return std::string(WordsOf<Enum>::words[static_cast<size_t>(value)]);
}

/// All words of an enumeration, or the first few.
template <class Enum>
Words words_of(size_t count = WordsOf<Enum>::words.size()) {
  return {{WordsOf<Enum>::words.begin(), WordsOf<Enum>::words.begin() + count}};
}

/// The names of a list of strategies or estimators.
template <class Info>
Words names_of(std::span<const Info> infos) {
  Words names;
  for (const Info& info : infos) names.words.emplace_back(info.name);
  return names;
}

/// The value at the end of a path of pointers to members: &RenderSettings::volume, &AskedGather::radius.
template <auto... Path>
SettingValue get_member(const RenderSettings& settings) {
  const auto& member = (settings.*....*Path);
  using Value = std::remove_cvref_t<decltype(member)>;
  if constexpr (std::is_enum_v<Value>)
    return word_of(member);
  else if constexpr (std::integral<Value> && !std::same_as<Value, bool>)
    return static_cast<uint64_t>(member);
  else if constexpr (std::same_as<Value, AskedRadius>)
    return member.metres();
  else
    return member;
}

template <auto... Path>
void set_member(RenderSettings& settings, const SettingValue& value) {
  auto& member = (settings.*....*Path);
  using Value = std::remove_cvref_t<decltype(member)>;
  if constexpr (std::is_enum_v<Value>) {
    const auto& words = WordsOf<Value>::words;
    const auto found = std::find(words.begin(), words.end(), std::get<std::string>(value));
    assert(found != words.end());
    member = static_cast<Value>(found - words.begin());
  } else if constexpr (std::floating_point<Value> || std::same_as<Value, AskedRadius>) {
    using Number = std::conditional_t<std::same_as<Value, AskedRadius>, float, Value>;
    const auto* single = std::get_if<float>(&value);
    member = static_cast<Number>(single ? *single : std::get<double>(value));
  } else if constexpr (std::integral<Value> && !std::same_as<Value, bool>) {
    member = static_cast<Value>(std::get<uint64_t>(value));
  } else {
    member = std::get<Value>(value);
  }
}

template <auto... Path>
Member at() {
  return {get_member<Path...>, set_member<Path...>};
}

/// The declarations of the sections [render], [photons], [importance]; [distance], [transmittance]; [volume],
/// [surface], [caustics]; [combined].
std::vector<Setting> pass_settings();
std::vector<Setting> flight_settings();
std::vector<Setting> gather_settings();
std::vector<Setting> combined_settings();

}  // namespace vpm
