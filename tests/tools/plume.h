// A small scene of a plume, which tests render with the binary.
#pragma once

#include <cstring>

#include "tools/vpm_binary.h"
#include "vpm/image/image.h"

namespace vpm {

/// A small plume over a floor, for several chunks of photons and several tiles of pixels a pass.
inline constexpr const char* kScene = R"(
[camera]
position = [0.0, 1.0, 2.5]
target = [0.0, 0.5, 0.0]
[film]
width = 40
height = 24
[media.smoke]
type = "grid"
path = "smoke.vdb"
sigma_t = 30
albedo = [0.9, 0.8, 0.7]
[materials.floor]
type = "lambertian"
reflectance = 0.5
[[shapes]]
type = "quad"
material = "floor"
corner = [-1, 0, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
[[lights]]
name = "lamp"
type = "spot"
position = [1, 2, 1]
target = [0, 0.5, 0]
outer_angle = 15
power = 10
[render]
passes = 2
[integrator.photons]
emitted = 10_000
[integrator.volume]
radius = 0.1
[integrator.surface]
radius = 0.1
)";

class VpmRender : public VpmBinary {
 protected:
  VpmRender() {
    write("scene.toml", kScene);
    made_once({"smoke.vdb"}, [&] { vpm_succeeds({"media", "smoke", "--resolution", "16", "-o", "smoke.vdb"}); });
  }
};

/// A report without what may differ between two runs: times, memory in use, threads, the image's name.
inline nlohmann::json without_circumstances(nlohmann::json report) {
  for (const char* key : {"times", "threads", "image"}) report.erase(key);
  for (const char* key : {"emitted_per_second", "emitted_per_second_and_thread", "stored_per_second"})
    report["photons"].erase(key);
  report["memory"].erase("peak_of_process");
  return report;
}

inline bool same_pixels(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

inline double sum(const Image& image) {
  double total = 0.0;
  for (const Rgb& c : image.pixels) total += sum_channels(c);
  return total;
}

inline void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "expected: " << word << "\n" << text;
}

}  // namespace vpm
