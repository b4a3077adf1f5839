// Scenes written by tests: what every file needs, and the rest in the test.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "support/test_file.h"
#include "vpm/input/scene_file.h"

namespace vpm {

inline const std::string kCamera = "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n";
inline const std::string kLight = "[[lights]]\ntype = \"point\"\nposition = [0, 2, 0]\npower = 1\n";
inline const std::string kGrey = "[materials.grey]\ntype = \"lambertian\"\nreflectance = 0.5\n";

inline std::string write_scene(const std::string& text) {
  const std::string path = test_file("scene.toml");
  std::ofstream(path) << text;
  return path;
}

/// Loads a camera, a point light and `text`.
inline RenderJob load_with(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_scene(write_scene(kCamera + kLight + text), overrides);
}

inline float relative_difference(const Rgb& a, const Rgb& b) { return glm::length(a - b) / glm::length(b); }

/// The normal that a downward ray at (x, z) meets first.
inline Vec3 normal_below(const Scene& scene, float x, float z) {
  const std::optional<Hit> hit = scene.geometry.intersect({Vec3(x, 50, z), Vec3(0, -1, 0)});
  return hit ? hit->normal : Vec3(0);
}

}  // namespace vpm
