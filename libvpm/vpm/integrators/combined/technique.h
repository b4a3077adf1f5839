// The techniques of the combined estimator: the ways in which it finds one and the same path of light.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace vpm {

/// A path from a light to the eye is found by a sub-path from the light and one from the eye. These are connected; or
/// the light's is connected to the camera itself; or they are merged at a vertex, within a kernel: at a surface, or in
/// a medium where both have collided, or only the light's, or neither, where a flight crosses the ray of the eye. Those
/// whose eye's sub-path has not collided are looked for along rays that only mirrors and glass have turned since they
/// left the camera.
enum class Technique : uint32_t { connections, light_tracing, surface_merging, points_3d, points_2d, short_beams };

struct TechniqueInfo {
  Technique technique;
  std::string_view name;
  std::string_view summary;
};
/// All, in the order of Technique.
inline constexpr std::array<TechniqueInfo, 6> kTechniques{
    {{Technique::connections, "connections", "sub-paths connected by a line, lights sampled, and lights run into"},
     {Technique::light_tracing, "light-tracing", "vertices of light sub-paths connected to the camera"},
     {Technique::surface_merging, "surface-merging", "photons on surfaces around where an eye sub-path meets these"},
     {Technique::points_3d, "points-3d", "photons in media around where an eye sub-path collides"},
     {Technique::points_2d, "points-2d", "photons in media around whole rays from the camera"},
     {Technique::short_beams, "short-beams", "flights of photons that cross whole rays from the camera"}}};

/// A set of techniques, by default all.
class TechniqueSet {
 public:
  constexpr TechniqueSet() = default;
  constexpr bool has(Technique technique) const { return (bits_ & bit(technique)) != 0; }
  constexpr void set(Technique technique, bool in) { bits_ = in ? bits_ | bit(technique) : bits_ & ~bit(technique); }
  /// Do any merge sub-paths in media, within kernels?
  constexpr bool merge_in_media() const {
    return has(Technique::points_3d) || has(Technique::points_2d) || has(Technique::short_beams);
  }
  bool operator==(const TechniqueSet&) const = default;

 private:
  static constexpr uint32_t bit(Technique technique) { return 1u << static_cast<uint32_t>(technique); }

  uint32_t bits_ = (1u << kTechniques.size()) - 1;
};

/// How techniques that find the same path share it: in proportion to their densities, or to the squares of these
/// [Veach1997, sec. 9.2]; or to densities, but of sub-paths from the eye that end at their first vertex which is not
/// specular, where merges there find all light: merges beyond it share its noise. The problem is that of
/// [Grittmann2021], the rule is not theirs.
enum class Heuristic { balance, power, correlation_aware };

}  // namespace vpm
