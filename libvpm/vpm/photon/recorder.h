// The interface through which photon tracing reports events, one by one. Code that needs photons passes a recorder,
// which keeps what that code needs. Tracing does not know who uses the photons.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vpm/path/walk.h"

namespace vpm {

/// The collision that a photon's flight began at. False where it began at a light or at a surface instead.
struct Turn {
  Vec3 from{0.0f};  // direction of travel before it, unit
  MediumId medium = kVacuum;
  float density = 0.0f;  // at the collision: Event::density

  explicit operator bool() const { return medium != kVacuum; }
};

/// A photon as it arrives at an event.
struct ArrivingPhoton {
  uint64_t number;         // of the photon among those emitted in the pass
  const PathState& state;  // at the event, with the direction and power with which the photon arrives
  const Event& event;
  const Vec3& departed;  // where the flight began that ends at the event, m
  uint32_t scatterings;  // so far, in media and at non-specular surfaces
  uint32_t reflections;  // so far, and refractions, by mirrors and smooth glass
  bool from_rough;       // its last non-specular scattering was at a surface, not in a medium
  const Turn& turn;

  /// Not yet scattered, reflected or refracted; crossing a boundary between media does not count.
  bool direct() const { return scatterings == 0 && reflections == 0; }
  /// Nothing except mirrors and smooth glass has scattered it.
  bool specular() const { return scatterings == 0; }
};

/// Which kinds of events are reported to a recorder.
struct RecordNeeds {
  bool flights = true, collisions = true, hits = true, escapes = false, ways = false;
};

/// Keeps what its owner needs of the photons of one pass. Photons are traced in chunks, and each chunk has its own
/// recorder. These are joined in the order of the photons, so that the result does not depend on the number of threads.
/// A virtual call costs some nanoseconds, the event that it reports about a microsecond.
class PhotonRecorder {
 public:
  virtual ~PhotonRecorder() = default;
  /// An empty recorder of the same kind, for one chunk of photons.
  virtual std::unique_ptr<PhotonRecorder> part() const = 0;
  /// Takes over what a part has kept. Parts are joined in the order of their photons.
  virtual void join(PhotonRecorder& part) = 0;
  /// The number of kept photons that count towards TraceSettings::stored.
  virtual size_t stored() const { return 0; }
  /// Which of flew(), collided(), hit(), escaped() and travelled() are called. It must not change while photons are
  /// traced.
  virtual RecordNeeds needs() const { return {}; }
  /// From now on also keeps where each photon comes from, if it can.
  virtual void keep_histories() {}
  /// Does the recorder read Event::density? If not, distance strategies may leave it inexact (FlightUse::density).
  virtual bool reads_density() const { return false; }

  /// A photon was emitted.
  virtual void emitted(uint64_t /*number*/) {}
  /// A photon has flown through a medium on its way to an event of any kind, or up to it. Called for each medium on the
  /// way, before collided() and hit(), with the random numbers of the photon.
  virtual void flew(const Track&, const ArrivingPhoton&, Rng&) {}
  /// A photon has come straight from `departed` to an event, or leaves the scene that way: flew() for all of the way at
  /// once. `tracks` are its parts in media, if any recorder needs flights.
  virtual void travelled(const ArrivingPhoton&, const std::vector<Track>& /*tracks*/) {}
  /// A photon collides in a medium. Called before absorption or scattering is drawn.
  virtual void collided(const ArrivingPhoton&) {}
  /// A photon meets a surface that is not just a boundary between media. Called before it scatters there.
  virtual void hit(const ArrivingPhoton&) {}
  /// A photon leaves the scene.
  virtual void escaped(const ArrivingPhoton&) {}
};

using Recorders = std::vector<PhotonRecorder*>;

/// Appends to a list what a part of it has, and leaves that empty.
template <class T>
void join_lists(std::vector<T>& all, std::vector<T>& part) {
  all.insert(all.end(), part.begin(), part.end());
  part = {};
}

}  // namespace vpm
