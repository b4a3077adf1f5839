// Fluence and absorbed power in cells: sums over photons as they fly and collide.
//
// Sums are of whole numbers, which all threads add to the same cells: their order does not matter, so that the bits are
// the same on any number of threads.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "vpm/photon/cell_lattice.h"
#include "vpm/photon/recorder.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Sums of one quantity in cells and channels, each a whole multiple of `unit`.
class CellSums {
 public:
  CellSums(size_t cells, double unit) : sums_(3 * cells), unit_(unit) {}

  /// Any thread may call it at any time. Throws InputError where the sum is about to leave its range: for what is over
  /// 2^53 times the unit, and where there is 2^62 times that already.
  void add(size_t cell, const Rgbd& value);
  Rgbd operator[](size_t cell) const;
  void clear();

 private:
  std::vector<std::atomic<int64_t>> sums_;
  double unit_;
};

/// Records the lengths of flights in media times their power, W m [Spanier1969], the power that collisions absorb, W,
/// and where it is asked for the lengths times power along each axis, of all photons in the cells of a lattice. Flights
/// must be drawn from the media's own transmittance. Where a medium is chromatic the power at a place on a flight is
/// that which the flight would have there: one place in each cell is drawn.
class FieldRecorder final : public PhotonRecorder {
 public:
  /// `photon_power`, W, > 0, is what a photon carries: sums are as exact as 2^-30 of it.
  FieldRecorder(const Scene& scene, const CellLattice& lattice, double photon_power, bool flux);

  std::unique_ptr<PhotonRecorder> part() const override { return std::make_unique<FieldRecorder>(*this); }
  void join(PhotonRecorder&) override {}
  RecordNeeds needs() const override { return {.hits = false}; }
  void flew(const Track& track, const ArrivingPhoton& photon, Rng& rng) override;
  void collided(const ArrivingPhoton& photon) override;

  const CellSums& lengths() const { return *lengths_; }
  const CellSums& absorbed() const { return *absorbed_; }
  /// Of x, y and z; null where flux is not recorded.
  const std::array<std::shared_ptr<CellSums>, 3>& along() const { return along_; }
  void clear();

 private:
  const Scene& scene_;
  CellLattice lattice_;
  // Of all parts:
  std::shared_ptr<CellSums> lengths_, absorbed_;
  std::array<std::shared_ptr<CellSums>, 3> along_;
};

}  // namespace vpm
