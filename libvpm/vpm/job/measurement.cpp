// Passes into readings, and their text.
#include "vpm/job/measurement.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "vpm/base/error.h"

namespace vpm {
namespace {

using Json = nlohmann::ordered_json;

/// Of a pass of so many photons.
void add_pass(DetectorReading& reading, const std::vector<Counted>& bins, double photons) {
  Rgbd sides[2] = {Rgbd(0.0), Rgbd(0.0)};
  uint64_t* const counts[2] = {&reading.forward_count, &reading.backward_count};
  const size_t of_side = reading.detector.of_medium() ? 1 : bins.size() / 2;
  for (size_t bin = 0; bin < bins.size(); ++bin) {
    const Rgbd power = bins[bin].power / photons;
    reading.power[bin].add(power);
    reading.counts[bin] += bins[bin].count;
    sides[bin / of_side] += power;
    *counts[bin / of_side] += bins[bin].count;
  }
  reading.forward.add(sides[0]);
  reading.backward.add(sides[1]);
}

Json channels(const Rgbd& value) {
  Json list = Json::array();
  for (int c = 0; c < 3; ++c) list.push_back(std::isnan(value[c]) ? Json() : Json(value[c]));  // NaN is no JSON
  return list;
}

Json flux(const ChannelMoments& power) {
  return {{"power_W", channels(power.mean())}, {"standard_error_W", channels(power.standard_error())}};
}

Json side(const ChannelMoments& power, uint64_t count) {
  Json value = flux(power);
  value["count"] = count;
  return value;
}

/// Cells and angles of one side: lists of lists.
Json parts_of(const DetectorReading& reading, bool forward) {
  const auto [u, v] = reading.detector.cells();
  Json rows = Json::array();
  for (int i = 0; i < u; ++i)
    for (int j = 0; j < v; ++j)
      for (int angle = 0; angle < reading.detector.angles; ++angle) {
        const size_t bin = reading.detector.bin_of(forward, {i, j}, angle);
        Json row = {{"cell", {i, j}},
                    {"cosines",
                     {1.0 - (angle + 1.0) / reading.detector.angles,
                      1.0 - static_cast<double>(angle) / reading.detector.angles}}};
        row.update(side(reading.power[bin], reading.counts[bin]));
        rows.push_back(row);
      }
  return rows;
}

Json detector_json(const DetectorReading& reading, const Scene& scene) {
  Json value = {{"name", reading.detector.name}};
  if (const auto* medium = std::get_if<MediumDetector>(&reading.detector.kind)) {
    value["medium"] = scene.media[static_cast<size_t>(medium->medium)].name;
    value["absorbed"] = side(reading.forward, reading.forward_count);
    return value;
  }
  value["forward"] = side(reading.forward, reading.forward_count);
  value["backward"] = side(reading.backward, reading.backward_count);
  if (reading.detector.bins() == 2) return value;
  value["forward"]["parts"] = parts_of(reading, true);
  value["backward"]["parts"] = parts_of(reading, false);
  return value;
}

}  // namespace

Measurement measure(const Scene& scene, const RenderSettings& settings, const std::vector<Detector>& detectors,
                    const PhotonRun& run) {
  check_photon_passes(settings);
  if (detectors.empty())
    throw InputError("the scene has no detector: add [[detectors]], as scenes/README.md describes them");
  Measurement measured;
  for (const Detector& detector : detectors)
    measured.detectors.push_back({.detector = detector,
                                  .power = std::vector<ChannelMoments>(detector.bins()),
                                  .counts = std::vector<uint64_t>(detector.bins())});
  DetectorRecorder recorder(scene, detectors);
  measured.run = run_photon_passes(scene, settings, run, recorder, [&](const Ledger& ledger, int) {
    const auto photons = static_cast<double>(ledger.emitted_count);
    for (size_t i = 0; i < detectors.size(); ++i) add_pass(measured.detectors[i], recorder.counted()[i], photons);
    measured.emitted.add(ledger.emitted / photons);
    measured.absorbed_in_media.add(ledger.absorbed_in_media / photons);
    measured.absorbed_on_surfaces.add(ledger.absorbed_on_surfaces / photons);
    measured.escaped.add(ledger.escaped / photons);
    measured.cut.add(ledger.cut / photons);
    recorder.clear();
  });
  return measured;
}

std::string json_of(const Measurement& measured, const Scene& scene) {
  Json value = {{"passes", measured.run.passes},
                {"photons", measured.run.ledger.emitted_count},
                {"emitted", flux(measured.emitted)},
                {"absorbed_in_media", flux(measured.absorbed_in_media)},
                {"absorbed_on_surfaces", flux(measured.absorbed_on_surfaces)},
                {"escaped", flux(measured.escaped)},
                {"cut_at_max_events", flux(measured.cut)},
                {"detectors", Json::array()}};
  for (size_t i = 0; i < scene.detectors.size(); ++i)
    value["detectors"].push_back(detector_json(measured.detectors[i], scene));
  return value.dump(2) + "\n";
}

}  // namespace vpm
