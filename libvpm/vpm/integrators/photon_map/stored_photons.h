// The photons of a pass as data: what its maps store, with where each photon comes from; and how photons flew.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vpm/film/image_pass.h"
#include "vpm/integrators/settings.h"
#include "vpm/photon/ledger.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// What a photon came to.
enum class PhotonEvent : uint8_t {
  collision,  // in a medium, before absorption or scattering is drawn
  flight,     // past a place of a grid so thin that photons collide too seldom: see CollisionRecorder
  hit,        // of a surface that is not specular, before absorption or scattering is drawn
  escape,     // out of the scene
  specular,   // hit of a mirror or of smooth glass
  departure   // from a light: of the first corner of a path in .ply files alone
};
/// Their names, in that order.
std::vector<std::string> names_of_photon_events();

/// A photon of a map. Collisions and hits are what photons did: their powers sum up to what arrived in a region. With
/// those of flights besides, powers over densities are what the map stores.
struct StoredPhoton {
  Vec3 position{0.0f};   // m
  Vec3 direction{0.0f};  // of travel on arrival, unit, as the map stores it
  Rgb power{0.0f};       // W, already divided by the photons emitted
  float density = 1.0f;  // of a grid, relative to its largest: the map stores power / density
  uint64_t number = 0;   // of the photon among those emitted
  uint32_t place = 0;    // StoredPhotons::places
  // Before, in media and on surfaces; by mirrors and smooth glass. 65535 stands for as many or more.
  uint16_t scatterings = 0, reflections = 0;
  uint8_t map = 0;  // StoredPhotons::maps
  PhotonEvent event = PhotonEvent::collision;
  uint8_t unused[6] = {};
};
static_assert(sizeof(StoredPhoton) == 64);

struct StoredPhotons {
  std::vector<StoredPhoton> photons;  // map by map, medium by medium, in the order in which they were emitted
  std::vector<std::string> maps;      // names: "volume", "surface", "caustics"
  std::vector<std::string> places;    // names of media, and then of shapes
  uint64_t emitted = 0;               // photons
  Ledger ledger;                      // of all photons of the pass
};

/// A straight flight of a photon, through any number of media.
struct PhotonFlight {
  Vec3 from{0.0f}, to{0.0f};  // m; out of the scene as far as the scene's box is wide
  Rgb power{0.0f};            // W, with which the photon arrives, already divided by the photons emitted
  uint32_t place = 0;         // where it arrives: StoredPhotons::places; kNoPlace where it escapes
  uint64_t number = 0;        // of the photon: all of its flights follow each other
  uint16_t scatterings = 0, reflections = 0;  // before it arrives
  PhotonEvent event = PhotonEvent::escape;
  uint8_t unused[3] = {};
};
static_assert(sizeof(PhotonFlight) == 56);
inline constexpr uint32_t kNoPlace = ~uint32_t{0};

struct PhotonFlights {
  std::vector<PhotonFlight> flights;
  std::vector<std::string> places;
  uint64_t emitted = 0;
  Ledger ledger;  // of all photons of the pass
};

/// The photons of the maps of pass number `pass`, those that a render gathers. Throws SettingError where the integrator
/// has no photon maps, or where what it stores is not single photons.
StoredPhotons stored_photons(const Scene& scene, const RenderSettings& settings, int pass,
                             const PassProgress& progress = {});
/// All flights of the same photons. Throws as the other.
PhotonFlights photon_flights(const Scene& scene, const RenderSettings& settings, int pass,
                             const PassProgress& progress = {});

}  // namespace vpm
