// Adding to cells.
#include "vpm/photon/field_recorder.h"

#include <cmath>
#include <cstdlib>

#include "vpm/base/error.h"
#include "vpm/medium/distance/mixture.h"

namespace vpm {

void CellSums::add(size_t cell, const Rgbd& value) {
  constexpr double kMost = 0x1p53;
  constexpr int64_t kFull = int64_t{1} << 62;
  for (size_t c = 0; c < 3; ++c) {
    const double units = std::nearbyint(value[static_cast<int>(c)] / unit_);
    if (!(std::abs(units) <= kMost))
      throw InputError("a photon carries millions of times the mean power, too much for the sums of its cell");
    if (std::abs(sums_[3 * cell + c].fetch_add(static_cast<int64_t>(units), std::memory_order_relaxed)) > kFull)
      throw InputError("the sums of a cell are full: make more passes of fewer photons");
  }
}

Rgbd CellSums::operator[](size_t cell) const {
  Rgbd sum;
  for (size_t c = 0; c < 3; ++c)
    sum[static_cast<int>(c)] = unit_ * static_cast<double>(sums_[3 * cell + c].load(std::memory_order_relaxed));
  return sum;
}

void CellSums::clear() {
  for (std::atomic<int64_t>& sum : sums_) sum.store(0, std::memory_order_relaxed);
}

namespace {

constexpr double kFine = 0x1p-30;  // of a photon's power

}  // namespace

FieldRecorder::FieldRecorder(const Scene& scene, const CellLattice& lattice, double photon_power, bool flux)
    : scene_(scene), lattice_(lattice), absorbed_(std::make_shared<CellSums>(lattice.size(), kFine * photon_power)) {
  const Vec3d edges = lattice.edges();
  const double unit = kFine * photon_power * std::max({edges.x, edges.y, edges.z});
  lengths_ = std::make_shared<CellSums>(lattice.size(), unit);
  if (!flux) return;
  for (std::shared_ptr<CellSums>& axis : along_) axis = std::make_shared<CellSums>(lattice.size(), unit);
}

void FieldRecorder::flew(const Track& track, const ArrivingPhoton&, Rng& rng) {
  const Medium& medium = scene_.media[track.medium];
  const bool grey = is_grey(medium.sigma_t);
  lattice_.visit_along(track.ray, track.interval, [&](size_t cell, double t0, double t1) {
    Rgb power = track.throughput;
    if (!grey) {
      const auto t = static_cast<float>(t0 + rng.uniform_double() * (t1 - t0));
      const double integral = density_integral(medium, track.ray, {0.0f, t}).value;
      power *= analog_weight(medium, channel_shares(track.throughput), integral, false);
    }
    const Rgbd length = Rgbd(power) * (t1 - t0);
    lengths_->add(cell, length);
    for (size_t a = 0; a < 3 && along_[a]; ++a)
      along_[a]->add(cell, static_cast<double>(track.ray.direction[static_cast<int>(a)]) * length);
  });
}

void FieldRecorder::collided(const ArrivingPhoton& photon) {
  const Vec3& place = photon.state.ray.origin;
  const std::optional<size_t> cell = lattice_.cell_at(place);
  if (!cell) return;
  const Rgb albedo = scene_.media[photon.state.medium].properties(place).albedo();
  absorbed_->add(*cell, Rgbd(photon.state.throughput * (Rgb(1.0f) - albedo)));
}

void FieldRecorder::clear() {
  lengths_->clear();
  absorbed_->clear();
  for (const std::shared_ptr<CellSums>& axis : along_)
    if (axis) axis->clear();
}

}  // namespace vpm
