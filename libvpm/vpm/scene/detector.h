// Detectors: surfaces that light is counted through without meeting them, and media that it is counted in.
#pragma once

#include <array>
#include <string>
#include <variant>

#include "vpm/base/vec.h"

namespace vpm {

// Light that passes towards the side that the normal points to goes forward; of a sphere that is outwards.
struct PlaneDetector {
  Vec3 point{0.0f};               // m
  Vec3 normal{0.0f, 1.0f, 0.0f};  // unit
};
struct DiscDetector {
  Vec3 center{0.0f};              // m
  Vec3 normal{0.0f, 1.0f, 0.0f};  // unit
  float radius = 1.0f;            // m
};
/// A parallelogram of the normal cross(edge_u, edge_v), in cells[0] times cells[1] equal parts along its edges.
struct QuadDetector {
  Vec3 corner{0.0f}, edge_u{1.0f, 0.0f, 0.0f}, edge_v{0.0f, 0.0f, 1.0f};  // m; need not be orthogonal
  std::array<int, 2> cells{1, 1};
};
struct SphereDetector {
  Vec3 center{0.0f};    // m
  float radius = 1.0f;  // m
};
/// What a medium absorbs.
struct MediumDetector {
  int medium = 0;  // in Scene::media
};

struct Detector {
  std::string name;
  std::variant<PlaneDetector, DiscDetector, QuadDetector, SphereDetector, MediumDetector> kind;
  int angles = 1;  // parts of equal solid angle that each hemisphere is counted in; 1 for media

  bool of_medium() const { return std::holds_alternative<MediumDetector>(kind); }
  std::array<int, 2> cells() const {
    const auto* const quad = std::get_if<QuadDetector>(&kind);
    return quad ? quad->cells : std::array<int, 2>{1, 1};
  }
  /// Sides times cells times angles.
  size_t bins() const {
    if (of_medium()) return 1;
    const auto [u, v] = cells();
    return 2 * static_cast<size_t>(u) * static_cast<size_t>(v) * static_cast<size_t>(angles);
  }
  /// Cell (i, j) of a quad along its edges; `angle` counts from the normal, or from its opposite.
  size_t bin_of(bool forward, const std::array<int, 2>& cell, int angle) const {
    const auto [u, v] = cells();
    return ((forward ? 0 : static_cast<size_t>(u)) + static_cast<size_t>(cell[0])) * static_cast<size_t>(v * angles) +
           static_cast<size_t>(cell[1] * angles + angle);
  }
};

/// The box around a surface that is bounded, m; an empty one for planes and media.
Box bounds_of(const Detector& detector);

/// A straight flight.
struct StraightWay {
  Vec3d from{0.0}, to{0.0};  // m
  Vec3d direction{0.0};      // unit
  bool endless = false;      // it ends nowhere, and `to` means nothing
};

/// A flight passes a surface.
struct Detection {
  double distance = 0.0;  // m from where the flight begins
  size_t bin = 0;         // Detector::bin_of()
};
/// Where a flight passes a detector, in no order: at two places of a sphere at most.
struct Detections {
  std::array<Detection, 2> at;
  int count = 0;

  void add(const Detection& detection) { at[static_cast<size_t>(count++)] = detection; }
  const Detection* begin() const { return at.data(); }
  const Detection* end() const { return at.data() + count; }
};
/// Flights that begin where others end are counted once at that place. Those along the surface pass nothing.
Detections detections_of(const Detector& detector, const StraightWay& way);

}  // namespace vpm
