// Photons with their histories, and flights, out of one tracing of a pass.
#include "vpm/integrators/photon_map/stored_photons.h"

#include <algorithm>

#include "vpm/base/settings/setting_error.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/photon/records.h"

namespace vpm {
namespace {

void check_single_photons(const RenderSettings& settings) {
  refuse_if(settings.integrator != Integrator::photon, "integrator.type", "it stores no photons in maps",
            "write type = \"photon-map\"");
  refuse_if(settings.photons.in_cube > 0, "integrator.photons.in_cube", "maps would store sums of photons",
            "leave out 'in_cube'");
  refuse_if(settings.gathers_finally() && settings.caustics.emitted > 0, "integrator.caustics.emitted",
            "of photons that are aimed no histories are kept", "leave out 'emitted'");
}

std::vector<std::string> names_of_places(const Scene& scene) {
  std::vector<std::string> names;
  for (const Medium& medium : scene.media) names.push_back(medium.name);
  for (const Shape& shape : scene.shapes) names.push_back(shape.name);
  return names;
}

uint16_t narrow(uint32_t count) { return static_cast<uint16_t>(std::min<uint32_t>(count, 0xffff)); }

/// Appends photons of a map, the places of which are numbered from `first` on.
void append(const std::vector<Photon>& photons, const std::vector<PhotonHistory>& histories, PhotonEvent event,
            size_t first, uint64_t emitted, StoredPhotons& stored) {
  if (photons.empty()) return;
  const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
  for (size_t i = 0; i < photons.size(); ++i) {
    const PhotonHistory& history = histories[i];
    StoredPhoton& row = stored.photons.emplace_back();
    row.position = photons[i].position;
    row.direction = photons[i].travel.unpack();
    row.power = photons[i].power * history.density * scale;
    row.density = history.density;
    row.number = history.number;
    row.place = static_cast<uint32_t>(first + history.place);
    row.scatterings = narrow(history.scatterings);
    row.reflections = narrow(history.reflections);
    row.map = static_cast<uint8_t>(stored.maps.size() - 1);
    row.event = history.along_flight ? PhotonEvent::flight : event;
  }
}

/// Records every flight up to its end.
class FlightRecorder final : public PhotonRecorder {
 public:
  explicit FlightRecorder(const Scene& scene) : scene_(scene) {}

  std::unique_ptr<PhotonRecorder> part() const override { return std::make_unique<FlightRecorder>(scene_); }
  void join(PhotonRecorder& part) override { join_lists(flights, static_cast<FlightRecorder&>(part).flights); }
  RecordNeeds needs() const override { return {.flights = false, .escapes = true}; }
  void collided(const ArrivingPhoton& photon) override {
    add(photon, photon.state.ray.origin, static_cast<uint32_t>(photon.state.medium), PhotonEvent::collision);
  }
  void hit(const ArrivingPhoton& photon) override {
    const Hit& hit = photon.event.hit;
    add(photon, photon.state.ray.origin, static_cast<uint32_t>(scene_.media.size()) + hit.shape,
        is_rough(scene_.material_of(hit)) ? PhotonEvent::hit : PhotonEvent::specular);
  }
  void escaped(const ArrivingPhoton& photon) override {
    const float wide = glm::length(scene_.bounds.extent());
    add(photon, photon.departed + wide * photon.state.ray.direction, kNoPlace, PhotonEvent::escape);
  }

  std::vector<PhotonFlight> flights;  // powers not yet divided by the photons emitted

 private:
  void add(const ArrivingPhoton& photon, const Vec3& to, uint32_t place, PhotonEvent event) {
    flights.push_back({photon.departed, to, photon.state.throughput, place, photon.number, narrow(photon.scatterings),
                       narrow(photon.reflections), event});
  }

  const Scene& scene_;
};

}  // namespace

std::vector<std::string> names_of_photon_events() {
  return {"collision", "flight", "hit", "escape", "specular", "departure"};
}

StoredPhotons stored_photons(const Scene& scene, const RenderSettings& settings, int pass,
                             const PassProgress& progress) {
  check_single_photons(settings);
  const Estimators estimators = plan_estimators(scene, settings, pass);
  for (PhotonRecorder* recorder : estimators.recorders()) recorder->keep_histories();
  RenderStatistics statistics;
  trace_pass(scene, settings, estimators, {pass, progress}, statistics);
  StoredPhotons stored;
  stored.places = names_of_places(scene);
  stored.ledger = statistics.ledger;
  stored.emitted = statistics.ledger.emitted_count;
  for (const MapInfo& map : estimators.maps()) {
    if (!map.media_histories && !map.surface_histories) continue;  // flights alone
    const uint64_t emitted = map.emitted > 0 ? map.emitted : stored.emitted;
    stored.maps.emplace_back(map.section);
    for (size_t m = 0; map.media_histories && m < map.media->size(); ++m)
      append((*map.media)[m], (*map.media_histories)[m], PhotonEvent::collision, 0, emitted, stored);
    if (map.surface_histories)
      append(*map.surfaces, *map.surface_histories, PhotonEvent::hit, scene.media.size(), emitted, stored);
  }
  return stored;
}

PhotonFlights photon_flights(const Scene& scene, const RenderSettings& settings, int pass,
                             const PassProgress& progress) {
  check_single_photons(settings);
  FlightRecorder recorder(scene);
  RenderStatistics statistics;
  trace_pass(scene, settings, plan_estimators(scene, settings, pass), {pass, progress}, statistics, {&recorder});
  PhotonFlights all{std::move(recorder.flights), names_of_places(scene), statistics.ledger.emitted_count,
                    statistics.ledger};
  if (all.flights.empty()) return all;
  const auto scale = static_cast<float>(1.0 / static_cast<double>(all.emitted));
  for (PhotonFlight& flight : all.flights) flight.power *= scale;
  return all;
}

}  // namespace vpm
