// Planes at borders, and lines beside the ray by which the part of the tube around it that is there is estimated.
#include "vpm/estimate/segment_region.h"

#include <array>
#include <cmath>

#include "vpm/base/counters.h"
#include "vpm/estimate/region_share.h"

namespace vpm {
namespace {

constexpr int kLines = 16;            // by which a share is found
constexpr int kMostHits = 64;         // along one line; what is left of it then counts as being what it is there
constexpr float kProbes = 0.8f;       // how far from the ray, in radii, lines look whether there is anything to correct
constexpr float kLess = 0.85f;        // the part of a radius by which the change of shares with the radius is estimated
constexpr float kCorrected = 0.125f;  // of the shares have a correction, as it costs as much as a share
constexpr float kResolved = 1e-3f;    // of the radius: what borders are off by does not count

/// Places in the unit disc or ball, each of which stands for a part of a kernel: pairs on both sides of the middle, so
/// that what a plane through it parts is a half exactly.
struct Offset {
  Vec3 place;
  double part;
};
using Offsets = std::array<Offset, kLines>;

/// The distance within which a part of the kernel lies, between two within which less and more of it lies.
double distance_within(KernelKind kernel, int dimension, double part, double less, double more) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (less + more);
    (kernel_within(kernel, dimension, middle).value < part ? less : more) = middle;
  }
  return more;
}

/// `dimension` of the kernel; `everywhere`: in all directions, not just across the ray.
Offsets make_offsets(KernelKind kernel, int dimension, bool everywhere) {
  constexpr int kPairs = kLines / 2;
  constexpr int kApart = 3;      // the distances of neighbours in direction are as many steps apart
  constexpr float kTurn = 0.5f;  // rad: no line lies straight beside or above the ray
  const float golden = kPi * (3.0f - std::sqrt(5.0f));  // rad, from one direction to the next
  // Where the kernel becomes negative; one pair stands for its rim, if it has one.
  const double crest = kernel_order(kernel) == 4 ? std::sqrt((dimension + 2.0) / (dimension + 6.0)) : 1.0;
  const double before = kernel_within(kernel, dimension, crest).value;
  const int positive = crest < 1.0 ? kPairs - 1 : kPairs;
  Offsets offsets;
  for (int i = 0; i < kPairs; ++i) {
    const float along = everywhere ? (static_cast<float>(i) + 0.5f) / kPairs : 0.0f;
    const float across = std::sqrt(1.0f - along * along), turn = golden * static_cast<float>(i) + kTurn;
    const int ring = everywhere ? i * kApart % kPairs : i;
    const double distance = ring < positive
                                ? distance_within(kernel, dimension, before * (ring + 0.5) / positive, 0.0, crest)
                                : distance_within(kernel, dimension, 0.5 * (before + 1.0), 1.0, crest);
    const double part = ring < positive ? before / (2.0 * positive) : 0.5 * (1.0 - before);
    const Vec3 place = static_cast<float>(distance) * Vec3(across * std::cos(turn), across * std::sin(turn), along);
    offsets[2 * i] = {place, part};
    offsets[2 * i + 1] = {-place, part};
  }
  return offsets;
}

constexpr std::array kSpreads{Spread::discs, Spread::balls_as_discs, Spread::balls, Spread::lines,
                              Spread::turned_discs};

Offsets offsets_of(KernelKind kernel, Spread spread) {
  switch (spread) {
    case Spread::lines:  // they lie all around a ray
      return make_offsets(kernel, 1, false);
    case Spread::discs:
      return make_offsets(kernel, 2, false);
    case Spread::turned_discs:
      return make_offsets(kernel, 2, true);
    case Spread::balls_as_discs:
    case Spread::balls:
      break;
  }
  return make_offsets(kernel, 3, true);
}

/// Of all kernels and spreads.
const auto kOffsets = [] {
  std::array<std::array<Offsets, kSpreads.size()>, kKernels.size()> all;
  for (const KernelInfo& info : kKernels)
    for (const Spread spread : kSpreads)
      all[static_cast<size_t>(info.kind)][static_cast<size_t>(spread)] = offsets_of(info.kind, spread);
  return all;
}();

/// Places on discs across beams of all directions, each of which counts with the phase function from its direction to
/// the ray's. Beams along the ray have discs across it: if they count for more, the places lie nearer to the plane
/// across the ray than those in a ball do. Returns how much nearer they are, in the root of the mean square.
float thickness_of(Spread spread, const Phase& phase) {
  if (spread != Spread::turned_discs) return 1.0f;
  const float along = std::visit([](const auto& p) { return p.mean_square_cosine(); }, phase);
  return std::sqrt(std::min(1.0f, 1.5f * (1.0f - along)));
}

/// The place at the same distance from the middle, nearer to the plane.
Vec3 flattened(const Vec3& place, float thickness) {
  const float z = thickness * place.z, distance2 = glm::dot(place, place);
  const float wider = std::sqrt((distance2 - z * z) / (distance2 - place.z * place.z));
  return {wider * place.x, wider * place.y, z};
}

float tangent(float cosine) { return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)) / cosine; }

/// The normal on the side that the ray comes from.
Vec3 near_side(const Hit& hit, const Vec3& direction) {
  return glm::dot(hit.normal, direction) > 0.0f ? -hit.normal : hit.normal;
}

/// Random numbers that are unrelated to those that are drawn next.
Rng aside(Rng next) {
  const uint64_t seed = next.bits(), stream = next.bits();
  return {seed, stream, 0};
}

}  // namespace

SeenAlong::SeenAlong(const Rgb& sigma_t, const Interval& interval, const DensityIntegralsAlong* integrals)
    : sigma_t_(sigma_t), t0_(interval.t0), t1_(interval.t1), integrals_(integrals), whole_(within(interval.t1)) {}

Rgbd SeenAlong::within(double t) const {
  const double integral = !integrals_ ? t - t0_ : std::isinf(t) ? integrals_->integral() : integrals_->at(t).integral;
  Rgbd seen;
  for (int c = 0; c < 3; ++c) seen[c] = attenuated_integral(sigma_t_[c], integral);
  return seen;
}

Rgbd SeenAlong::to(double t) const {
  if (t < t0_) return -to(2.0 * t0_ - t);
  if (t > t1_) return 2.0 * whole_ - to(2.0 * t1_ - t);
  return within(t);
}

SegmentRegion::SegmentRegion(const EyeSegment& segment, const GatherSettings& gather, Spread spread)
    : segment_(segment),
      kernel_(gather.kernel),
      spread_(spread),
      radius_(gather.radius),
      reach_(segment.interval),
      anchor_(segment.interval.t0),
      thickness_(thickness_of(spread, segment.around()->phase)) {
  if (gather.boundary == BoundaryRule::none) return;
  const auto [t0, t1] = segment.interval;
  const Vec3 w = segment.ray.direction;
  const auto& [start, end] = segment.borders;
  reach_.t0 -= reach_past(start);
  reach_.t1 += reach_past(end);
  if (start != Vec3(0.0f)) within_.add(start, t0 * glm::dot(start, w));
  if (end != Vec3(0.0f)) within_.add(end, t1 * glm::dot(end, w));
  by_plane_ = start != Vec3(0.0f) && t0 - reach_.t0 < segment.interval.length();
  anchor_ = std::isinf(t1) ? t0 + radius_ : 0.5f * (t0 + t1);
  whole_ = is_plain();
}

PlaneDistances SegmentRegion::distances() const {
  const Vec3 w = segment_.ray.direction;
  if (!by_plane_) return {w};
  const Vec3 slope = segment_.borders.start / glm::dot(segment_.borders.start, w);
  return {slope, segment_.interval.t0 * (1.0f - glm::dot(slope, w))};
}

/// How far past an end kernels may have photons in the region. Not farther than the segment is long: the mirrored
/// place lies in it.
float SegmentRegion::reach_past(const Vec3& normal) const {
  if (normal == Vec3(0.0f)) return 0.0f;
  const float cosine = std::abs(glm::dot(normal, segment_.ray.direction));
  const float needed = spread_ == Spread::balls ? radius_ / cosine : radius_ * tangent(cosine);
  return std::min(needed, segment_.interval.length());
}

/// Do the planes alone bound the region, evenly on both sides of the ray? Also finds walls.
bool SegmentRegion::is_plain() {
  const auto [t0, t1] = segment_.interval;
  const bool cut = (segment_.borders.start != Vec3(0.0f) && t0 - reach_.t0 >= segment_.interval.length()) ||
                   (segment_.borders.end != Vec3(0.0f) && reach_.t1 - t1 >= segment_.interval.length());
  const Vec3 middle = segment_.ray.at(anchor_), w = segment_.ray.direction;
  near_ = segment_.scene.geometry.is_near(middle, radius_);
  bool plain = !cut && !near_;
  Vec3 s, t;
  make_frame(w, s, t);
  for (const Vec3& side : {s, -s, t, -t}) {
    if (near_)
      if (const std::optional<Hit> wall = segment_.scene.geometry.intersect({middle, side}, radius_))
        add_wall(*wall, side);
    const Ray line{segment_.ray.origin + kProbes * radius_ * side, w};
    const std::optional<Hit> hit = first_met(line, part_of(line, kResolved * radius_));
    if (!hit) continue;
    plain = false;
    add_wall(*hit, w);
  }
  return plain;
}

/// The first that the part of a line meets.
std::optional<Hit> SegmentRegion::first_met(const Ray& line, const Interval& part) const {
  if (part.empty()) return std::nullopt;
  return segment_.scene.geometry.intersect({line.at(part.t0), line.direction}, part.length());
}

/// The part of a line beside the ray in which photons of the region may lie, without `slack` (m) at borders.
Interval SegmentRegion::part_of(const Ray& line, float slack) const {
  const float more = spread_ == Spread::balls ? radius_ : 0.0f;
  const Ray from_origin{line.origin - segment_.ray.origin, line.direction};
  const Interval part = within_.clip(from_origin, {reach_.t0 - more, reach_.t1 + more});
  return {part.t0 + slack, part.t1 - slack};
}

/// Does a plane, of which light comes to the side of `normal`, leave the whole segment on that side?
bool SegmentRegion::stands_beside(const Vec3& normal, const Vec3& position) const {
  const auto [t0, t1] = segment_.interval;
  const float slack = -kResolved * radius_;
  const auto depth = [&](float t) { return glm::dot(normal, segment_.ray.at(t) - position); };
  return depth(t0) >= slack && (std::isinf(t1) ? glm::dot(normal, segment_.ray.direction) >= 0.0f : depth(t1) >= slack);
}

void SegmentRegion::add_wall(const Hit& wall, const Vec3& direction) {
  const Vec3 normal = near_side(wall, direction);
  if (is_boundary(segment_.scene.material_of(wall)) || !stands_beside(normal, wall.position)) return;
  within_.add(normal, glm::dot(normal, wall.position - segment_.ray.origin));
}

/// Follows a line through all that it meets, and calls visit(t0, t1), in m from its origin, for its parts in the
/// segment's medium. `in` is what its origin lies in, and in the end what its end lies in. False where it ends at a
/// wall beside the segment.
template <class Visit>
bool SegmentRegion::walk(Ray ray, float length, Inside& in, Visit&& visit) const {
  const Scene& scene = segment_.scene;
  float begun = 0.0f;
  for (int i = 0; i <= kMostHits && length > begun; ++i) {
    const std::optional<Hit> hit = i < kMostHits ? scene.geometry.intersect(ray, length - begun) : std::optional<Hit>();
    const float end = hit ? begun + hit->t : length;
    if (in.medium == segment_.medium && in.solid < 0) visit(begun, end);
    if (!hit) break;
    const Shape& shape = scene.shapes[hit->shape];
    const bool opaque = !is_boundary(scene.material_of(*hit)) && !is_dielectric(scene.material_of(*hit));
    if (opaque && stands_beside(near_side(*hit, ray.direction), hit->position)) return false;
    const bool enters = glm::dot(hit->normal, ray.direction) < 0.0f;
    const Ray beyond{leave_surface(*hit, ray.direction), ray.direction};
    if (in.solid == static_cast<int>(hit->shape) && !enters) in.solid = -1;
    if (opaque && !shape.separates_media && enters && in.solid < 0) {
      // A closed body is left again; behind a sheet the medium goes on.
      const std::optional<Hit> next = scene.geometry.intersect(beyond);
      if (next && next->shape == hit->shape && glm::dot(next->normal, ray.direction) > 0.0f)
        in.solid = static_cast<int>(hit->shape);
    }
    in.medium = medium_beyond(shape, hit->normal, ray.direction, in.medium);
    ray = beyond;
    begun = end;
  }
  return true;
}

KernelEstimate SegmentRegion::share(float radius, const SeenAlong& seen, const Rng& rng) const {
  if (whole_) return Rgb(1.0f);
  const Rgb share = share_by_lines(radius, seen, 0.0f);
  Rng beside = aside(rng);
  if (!(beside.uniform() < kCorrected)) return share;
  const float turn = 2.0f * kPi * beside.uniform();
  const Rgb rise = share_by_lines(kLess * radius, seen, turn) - share_by_lines(radius, seen, turn);
  return {share, rise * (0.5f / (1.0f - kLess) / kCorrected)};
}

/// The light that is seen of a line beside the ray. `aside` is its distance from the ray, and `ahead` how far places on
/// it lie before the centers of their balls, m.
Rgbd SegmentRegion::seen_of_line(const Vec3& aside, float ahead, float radius, const SeenAlong& seen) const {
  Rgbd sum(0.0);
  const Vec3 w = segment_.ray.direction;
  const Ray line{segment_.ray.origin + aside, w};
  const Interval part = part_of(line, 0.0f);
  const Interval beside{std::max(part.t0, segment_.interval.t0), std::min(part.t1, segment_.interval.t1)};
  if (beside.empty()) return sum;
  const bool at_anchor = anchor_ > beside.t0 && anchor_ < beside.t1;
  const float middle = std::isinf(beside.t1) ? beside.t0 + radius : 0.5f * (beside.t0 + beside.t1);
  const float from = at_anchor ? anchor_ : middle;  // not on a border
  Inside there{segment_.medium};                    // at the line's place beside the ray's
  const float distance = glm::length(aside);
  if ((near_ || !at_anchor) && !walk({segment_.ray.at(from), aside / distance}, distance, there, [](float, float) {}))
    return sum;
  const PlaneDistances distances = this->distances();
  const auto seen_to = [&](float y) {
    if (std::isinf(y)) return seen.whole();
    return seen.to(spread_ == Spread::balls ? std::clamp(y - ahead, reach_.t0, reach_.t1)
                                            : distances.of(aside + y * w));
  };
  const auto add = [&](float begin, float end) { sum += seen_to(end) - seen_to(begin); };
  if (!near_ && at_anchor && !first_met(line, part_of(line, kResolved * radius))) {
    add(part.t0, part.t1);
    return sum;
  }
  Inside behind = there, before = there;
  walk({line.at(from), w}, part.t1 - from, behind, [&](float a, float b) { add(from + a, from + b); });
  walk({line.at(from), -w}, from - part.t0, before, [&](float a, float b) { add(from - b, from - a); });
  return sum;
}

Rgb SegmentRegion::share_by_lines(float radius, const SeenAlong& seen, float turn) const {
  Vec3 s, t;
  make_frame(segment_.ray.direction, s, t);
  const Vec3 right = std::cos(turn) * s + std::sin(turn) * t, up = std::cos(turn) * t - std::sin(turn) * s;
  Rgbd found(0.0);
  for (const Offset& offset : kOffsets[static_cast<size_t>(kernel_)][static_cast<size_t>(spread_)]) {
    const Vec3 place = radius * (thickness_ < 1.0f ? flattened(offset.place, thickness_) : offset.place);
    found += offset.part * seen_of_line(place.x * right + place.y * up, place.z, radius, seen);
  }
  Rgb share(1.0f);
  for (int c = 0; c < 3; ++c)
    if (seen.whole()[c] > 0.0 && !std::isinf(seen.whole()[c]))
      share[c] = static_cast<float>(found[c] / seen.whole()[c]);
  return share;
}

KernelEstimate over_share(const KernelEstimate& light, const KernelEstimate& share, GatherCounters& counters) {
  const Rgb least(static_cast<float>(kLeastShare));
  count(counters.corrected);
  if (glm::any(glm::lessThan(share.value, least))) ++counters.least_shares;
  const Rgb divisor = glm::max(share.value, least), value = light.value / divisor;
  return {value, (light.correction - value * share.correction) / divisor};
}

}  // namespace vpm
