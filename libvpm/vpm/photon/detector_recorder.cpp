// Counting photons through surfaces and in media.
#include "vpm/photon/detector_recorder.h"

#include <algorithm>

#include "vpm/medium/distance/mixture.h"

namespace vpm {
namespace {

/// The power at a distance from where a flight began, of which these parts led through media.
Rgb power_at(const Scene& scene, const ArrivingPhoton& photon, const std::vector<Track>& tracks, double distance) {
  Rgb power = tracks.empty() ? photon.state.throughput : tracks.front().throughput;
  for (const Track& track : tracks) {
    const double begins = glm::distance(Vec3d(track.ray.origin), Vec3d(photon.departed));
    if (distance < begins) break;
    const auto flown = std::min(static_cast<float>(distance - begins), track.interval.t1);
    const Medium& medium = scene.media[track.medium];
    const double integral = density_integral(medium, track.ray, {0.0f, flown}).value;
    power = track.throughput * analog_weight(medium, channel_shares(track.throughput), integral, false);
  }
  return power;
}

bool has_chromatic_media(const Scene& scene) {
  return std::any_of(scene.media.begin(), scene.media.end(),
                     [](const Medium& medium) { return !is_grey(medium.sigma_t); });
}

}  // namespace

DetectorRecorder::DetectorRecorder(const Scene& scene, const std::vector<Detector>& detectors)
    : scene_(scene), detectors_(detectors), chromatic_(has_chromatic_media(scene)) {
  for (const Detector& detector : detectors) {
    counted_.emplace_back(detector.bins());
    (detector.of_medium() ? media_ : surfaces_) = true;
  }
}

std::unique_ptr<PhotonRecorder> DetectorRecorder::part() const {
  return std::make_unique<DetectorRecorder>(scene_, detectors_);
}

void DetectorRecorder::join(PhotonRecorder& part) {
  const auto& other = static_cast<DetectorRecorder&>(part).counted_;
  for (size_t i = 0; i < counted_.size(); ++i)
    for (size_t bin = 0; bin < counted_[i].size(); ++bin) {
      counted_[i][bin].power += other[i][bin].power;
      counted_[i][bin].count += other[i][bin].count;
    }
}

RecordNeeds DetectorRecorder::needs() const {
  return {.flights = surfaces_ && chromatic_, .collisions = media_, .hits = false, .ways = surfaces_};
}

void DetectorRecorder::travelled(const ArrivingPhoton& photon, const std::vector<Track>& tracks) {
  const StraightWay way{Vec3d(photon.departed), Vec3d(photon.state.ray.origin), Vec3d(photon.state.ray.direction),
                        photon.event.kind == EventKind::escape};
  for (size_t i = 0; i < detectors_.size(); ++i)
    for (const Detection& detection : detections_of(detectors_[i], way)) {
      Counted& counted = counted_[i][detection.bin];
      counted.power +=
          Rgbd(chromatic_ ? power_at(scene_, photon, tracks, detection.distance) : photon.state.throughput);
      ++counted.count;
    }
}

void DetectorRecorder::collided(const ArrivingPhoton& photon) {
  for (size_t i = 0; i < detectors_.size(); ++i) {
    const auto* const of = std::get_if<MediumDetector>(&detectors_[i].kind);
    if (!of || of->medium != photon.state.medium) continue;
    const Rgb albedo = scene_.media[photon.state.medium].properties(photon.state.ray.origin).albedo();
    counted_[i][0].power += Rgbd(photon.state.throughput * (Rgb(1.0f) - albedo));
    ++counted_[i][0].count;
  }
}

void DetectorRecorder::clear() {
  for (std::vector<Counted>& bins : counted_) std::fill(bins.begin(), bins.end(), Counted{});
}

}  // namespace vpm
