// What the hard cases share: renders and traces that must be clean, and a medium between a light and the eye.
#pragma once

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/photon/records.h"

namespace vpm {

/// Fixed radii for both maps.
inline RenderSettings settings_of(uint64_t photons, float radius) {
  RenderSettings settings;
  settings.photons.emitted = photons;
  settings.volume.radius = radius;
  settings.surface.radius = radius;
  settings.radii = RadiusSchedule::constant;
  return settings;
}

/// The path tracer's pass over the same scene: every pixel is finite, and no path was dropped.
inline void expect_finite_paths(const Scene& scene, const RenderSettings& settings, int pass) {
  const Pass done = render_path_pass(scene, settings, pass);
  EXPECT_EQ(done.statistics.eye.non_finite, 0u);
  for (const Rgb& p : done.image.pixels) EXPECT_TRUE(is_finite(p));
}

/// Renders pass number `pass`: every pixel is finite, and no sample, photon or path was dropped or cut.
inline Image clean_image(const Scene& scene, const RenderSettings& settings, int pass = 0) {
  expect_finite_paths(scene, settings, pass);
  const Pass done = render_photon_pass(scene, settings, pass);
  int bad = 0;
  for (const Rgb& p : done.image.pixels) bad += !is_finite(p);
  EXPECT_EQ(bad, 0);
  EXPECT_EQ(done.statistics.eye.non_finite, 0u);
  EXPECT_EQ(done.statistics.eye.cut_paths, 0u);
  EXPECT_EQ(done.statistics.ledger.non_finite, 0u);
  EXPECT_EQ(done.statistics.ledger.cut_count, 0u);
  return done.image;
}

inline double mean_of(const Image& image) {
  double sum = 0.0;
  for (const Rgb& p : image.pixels) sum += sum_channels(p) / 3.0;
  return sum / static_cast<double>(image.pixels.size());
}

/// The mean of a clean image, pass by pass.
inline Moments clean_means(const Scene& scene, const RenderSettings& settings, int passes) {
  Moments means;
  for (int pass = 0; pass < passes; ++pass) means.add(mean_of(clean_image(scene, settings, pass)));
  return means;
}

inline PhotonLists trace_with(const Scene& scene, const std::string& strategy, const ListSettings& settings) {
  return list_photons(scene, *make_distance_strategy({.strategy = strategy}), settings);
}

/// The ledger of `emitted` photons. Of a grey scene whose strategy gives no weights, every photon's energy is accounted
/// for in full but for albedos' expectations, so that only statistics are left of the imbalance.
inline Ledger clean_ledger(const Scene& scene, const std::string& strategy, uint64_t emitted) {
  ListSettings settings;
  settings.emitted = emitted;
  const Ledger ledger = trace_with(scene, strategy, settings).ledger;
  EXPECT_EQ(ledger.non_finite, 0u);
  EXPECT_EQ(ledger.cut_count, 0u);
  EXPECT_EQ(ledger.emitted_count, emitted);
  const Rgbd lost = ledger.imbalance.mean(), error = ledger.imbalance.standard_error();
  for (int c = 0; c < 3; ++c)
    EXPECT_LE(std::abs(lost[c]),
              normal_quantile(kFalseAlarms) * error[c] + 1e-6 * ledger.emitted[c] / static_cast<double>(emitted));
  return ledger;
}

/// The largest deviation of a test, told at its end: the figures of papers/hard-cases.md.
class Worst {
 public:
  explicit Worst(std::string what) : what_(std::move(what)) {}
  ~Worst() { std::printf("%s: %.2g\n", what_.c_str(), deviation_); }
  Worst(const Worst&) = delete;
  Worst& operator=(const Worst&) = delete;
  void see(double deviation) { deviation_ = std::max(deviation_, std::abs(deviation)); }

 private:
  std::string what_;
  double deviation_ = 0.0;
};

/// z-test of a share of `count` independent photons.
inline void expect_share(double share, double exact, uint64_t count, const std::string& what = "") {
  const double error = std::sqrt(exact * (1.0 - exact) / static_cast<double>(count));
  EXPECT_LE(std::abs(share - exact), normal_quantile(kFalseAlarms) * error + 1e-6)
      << what << ": " << share << ", exact " << exact;
}

}  // namespace vpm
