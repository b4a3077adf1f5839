// Where flights pass surfaces. A place on a surface is before it; so no flight that goes on elsewhere passes twice.
#include "vpm/scene/detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vpm/base/overloads.h"

namespace vpm {
namespace {

/// The bin of a flight along a direction, at a place in that cell.
size_t bin_at(const Detector& detector, const std::array<int, 2>& cell, double cosine) {
  const int angle = static_cast<int>((1.0 - std::abs(cosine)) * detector.angles);
  return detector.bin_of(cosine > 0.0, cell, std::clamp(angle, 0, detector.angles - 1));
}

/// Where a flight passes a plane.
struct PlanePassage {
  double distance = 0.0;  // m
  double cosine = 0.0;    // to the normal, of the sign that the flight's ends say
};
std::optional<PlanePassage> to_plane(const Vec3d& point, const Vec3d& normal, const StraightWay& way) {
  const double before = glm::dot(way.from - point, normal), rise = glm::dot(way.direction, normal);
  const double far = rise == 0.0 ? before : rise;  // of an endless flight, which stays on its side along the plane
  const double after = way.endless ? far : glm::dot(way.to - point, normal);
  if ((before >= 0.0) == (after >= 0.0)) return std::nullopt;
  const double steep = std::max(std::abs(rise), std::numeric_limits<double>::min());
  const double distance = std::abs(before) / steep, whole = way.endless ? distance : glm::distance(way.from, way.to);
  return PlanePassage{std::min(distance, whole), before < 0.0 ? steep : -steep};
}

Detections at_plane(const Detector& detector, const PlaneDetector& plane, const StraightWay& way) {
  Detections found;
  const Vec3d normal(plane.normal);
  if (const auto passage = to_plane(Vec3d(plane.point), normal, way))
    found.add({passage->distance, bin_at(detector, {0, 0}, passage->cosine)});
  return found;
}

Detections at_disc(const Detector& detector, const DiscDetector& disc, const StraightWay& way) {
  Detections found;
  const Vec3d normal(disc.normal), center(disc.center);
  const auto passage = to_plane(center, normal, way);
  if (passage && glm::distance(way.from + passage->distance * way.direction, center) <= double{disc.radius})
    found.add({passage->distance, bin_at(detector, {0, 0}, passage->cosine)});
  return found;
}

Detections at_quad(const Detector& detector, const QuadDetector& quad, const StraightWay& way) {
  Detections found;
  const Vec3d corner(quad.corner), u(quad.edge_u), v(quad.edge_v), across = glm::cross(u, v);
  const double area = glm::length(across);
  const Vec3d normal = across / area;
  const auto passage = to_plane(corner, normal, way);
  if (!passage) return found;
  const Vec3d place = way.from + passage->distance * way.direction - corner;
  const std::array<double, 2> share{glm::dot(glm::cross(place, v), normal) / area,
                                    glm::dot(glm::cross(u, place), normal) / area};
  std::array<int, 2> cell;
  for (size_t a = 0; a < 2; ++a) {
    if (!(share[a] >= 0.0 && share[a] < 1.0)) return found;
    cell[a] = std::min(quad.cells[a] - 1, static_cast<int>(share[a] * quad.cells[a]));
  }
  found.add({passage->distance, bin_at(detector, cell, passage->cosine)});
  return found;
}

Detections at_sphere(const Detector& detector, const SphereDetector& sphere, const StraightWay& way) {
  Detections found;
  const Vec3d center(sphere.center), from = way.from - center;
  const double radius = double{sphere.radius}, closest = -glm::dot(from, way.direction);
  const double off = glm::length(from + closest * way.direction);
  const bool begins_inside = glm::length(from) < radius;
  const bool ends_inside = !way.endless && glm::distance(way.to, center) < radius;
  if (off >= radius) return found;
  const double half = std::sqrt((radius - off) * (radius + off));
  const double end = way.endless ? double{kInfinity} : glm::distance(way.from, way.to);
  const auto add = [&](double distance) {
    const Vec3d normal = (from + distance * way.direction) / radius;
    found.add({std::clamp(distance, 0.0, end), bin_at(detector, {0, 0}, glm::dot(way.direction, normal))});
  };
  // One that is neither inside at its beginning nor at its end either passes twice or comes not so far.
  if (!begins_inside && (ends_inside || (closest > 0.0 && closest < end))) add(closest - half);
  if (!ends_inside && (begins_inside || (closest > 0.0 && closest < end))) add(closest + half);
  return found;
}

}  // namespace

Box bounds_of(const Detector& detector) {
  Box box;
  const auto around = [&](const Vec3& center, const Vec3& half) {
    box.add(center - half);
    box.add(center + half);
  };
  std::visit(
      Overloads{[&](const DiscDetector& disc) {
                  around(disc.center, disc.radius * glm::sqrt(glm::max(Vec3(0.0f), 1.0f - disc.normal * disc.normal)));
                },
                [&](const QuadDetector& quad) {
                  for (const int corner : {0, 1, 2, 3})
                    box.add(quad.corner + static_cast<float>(corner & 1) * quad.edge_u +
                            static_cast<float>(corner >> 1) * quad.edge_v);
                },
                [&](const SphereDetector& sphere) { around(sphere.center, Vec3(sphere.radius)); }, [](const auto&) {}},
      detector.kind);
  return box;
}

Detections detections_of(const Detector& detector, const StraightWay& way) {
  return std::visit(Overloads{[&](const PlaneDetector& plane) { return at_plane(detector, plane, way); },
                              [&](const DiscDetector& disc) { return at_disc(detector, disc, way); },
                              [&](const QuadDetector& quad) { return at_quad(detector, quad, way); },
                              [&](const SphereDetector& sphere) { return at_sphere(detector, sphere, way); },
                              [](const MediumDetector&) { return Detections{}; }},
                    detector.kind);
}

}  // namespace vpm
