// What photon tracing tells of, event by event. Whoever needs photons says what to keep of them by a recorder of its
// own; tracing knows none of its readers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vpm/path/walk.h"

namespace vpm {

/// A photon as it arrives at an event.
struct ArrivingPhoton {
  uint64_t number;         // among those emitted in the pass
  const PathState& state;  // stands at the event, with the direction and the power that it arrives with
  const Event& event;
  bool direct;    // nothing has scattered, reflected or refracted it; crossing a boundary between media is none of that
  bool specular;  // nothing but mirrors and glass has
  bool from_rough;  // mirrors and glass apart, a rough surface scattered it last
};

/// Which events a recorder is told of.
struct RecordNeeds {
  bool flights = true, collisions = true, hits = true;
};

/// Keeps what it wants of the photons of one pass. Photons are traced in chunks, each of which has a recorder of its
/// own; these are joined in the photons' order, so that what is kept does not depend on the number of threads. One
/// virtual call costs some nanoseconds, the event that it tells of a microsecond.
class PhotonRecorder {
 public:
  virtual ~PhotonRecorder() = default;
  /// An empty recorder of the same kind, for one chunk of photons.
  virtual std::unique_ptr<PhotonRecorder> part() const = 0;
  /// Takes over what a part has kept: of the photons that come next.
  virtual void join(PhotonRecorder& part) = 0;
  /// How many photons it has, of those that TraceSettings::stored counts.
  virtual size_t stored() const { return 0; }
  /// Which of flew(), collided() and hit() are called; the same as long as photons are traced.
  virtual RecordNeeds needs() const { return {}; }
  /// Does it read Event::density? Strategies that know it for free only need not be asked (FlightUse::density).
  virtual bool reads_density() const { return false; }

  /// A photon was emitted.
  virtual void emitted(uint64_t /*number*/) {}
  /// A photon has flown to an event, whatever that is, in a straight line; `from` is how it started: with the power
  /// that its flight has not weighed yet.
  virtual void flew(const PathState& /*from*/, const ArrivingPhoton&) {}
  /// A photon collides in a medium; whether it is absorbed or scattered is not drawn yet.
  virtual void collided(const ArrivingPhoton&) {}
  /// A photon meets a surface that is no mere boundary between media, before it scatters there.
  virtual void hit(const ArrivingPhoton&) {}
};

using Recorders = std::vector<PhotonRecorder*>;

}  // namespace vpm
