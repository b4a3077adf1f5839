// The walk of a sub-path from the eye.
#include "vpm/integrators/combined/eye_sub_path.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "vpm/base/counters.h"
#include "vpm/integrators/combined/ray_merges.h"
#include "vpm/surface/shading.h"

namespace vpm {

EyeSubPath::EyeSubPath(const CombinedContext& context, const Ray& ray, EyeWork& work, TechniqueParts* parts,
                       std::vector<MergeSegment>* deferred, size_t number)
    : c_(context), work_(work), parts_(parts), deferred_(deferred), number_(number) {
  at_.state = {ray, medium_of_ray(context.scene, context.scene.camera_medium, ray), Rgb(1.0f)};
  at_.from = depart_from_camera(context.counts, ray, density_of(ray));
}

KernelEstimate EyeSubPath::follow() {
  follow_branch();
  while (waiting_ > 0) {
    at_ = branches_[--waiting_];
    follow_branch();
  }
  return radiance_;
}

void EyeSubPath::follow_branch() {
  for (; at_.events < c_.max_events; ++at_.events) {
    see_media();
    const std::optional<PathVertex> at = at_.only_specular ? pass_through() : fly();
    if (!at || !visit(*at)) return;
  }
  ++work_.counters.cut_paths;
}

double EyeSubPath::density_of(const Ray& ray) const {
  const Camera& camera = c_.scene.camera;
  const std::optional<Vec2> film = camera.film_of(ray.direction);
  if (!film) return 0.0;
  const auto width = static_cast<size_t>(camera.width);
  const Vec2 pixel(static_cast<float>(work_.pixel % width) + 0.5f, static_cast<float>(work_.pixel / width) + 0.5f);
  // Rounding may put the place of the film a hair outside of the filter.
  const float r = camera.filter.radius;
  const Vec2 offset = glm::clamp(*film - pixel, Vec2(-r), Vec2(r));
  return filter_value(camera.filter, offset) * camera.film_per_angle(ray.direction);
}

// --- Flights

bool EyeSubPath::Along::pass(float length, const Encounter&) {
  if (medium == kVacuum) return true;
  const Medium& around = path.c_.scene.media[medium];
  const Interval interval{0.0f, length};
  DensityIntegralsAlong& integrals = path.work_.scratch.integrals;
  count(path.work_.counters.walk.lookups, integrals.walk(&around, ray, interval));
  if (around.scatters() && path.at_.asks > 0.0f) {
    through_scattering = true;
    path.merge_along_ray(*this, interval);
  }
  passed *= transmittance(around, integrals.integral());
  return !is_black(passed);
}

std::optional<PathVertex> EyeSubPath::pass_through() {
  Along along{*this, at_.state.ray, at_.state.medium};
  const std::optional<Hit> hit = each_segment(c_.scene, along.ray, along.medium, kInfinity, work_.counters.walk, along);
  if (along.through_scattering) branch_off();
  at_.state.throughput *= along.passed;
  if (is_black(at_.state.throughput)) return std::nullopt;
  const float kept = max_channel(glm::abs(at_.state.throughput)) / at_.part;  // sides of glass are weak as they are
  if (!survive_roulette(kept, at_.state, work_.rng)) return std::nullopt;
  at_.state.ray = along.ray;
  at_.state.medium = along.medium;
  if (!hit) {
    see_environment(along.passed);
    return std::nullopt;
  }
  at_.state.ray.origin = hit->position;
  return arrive_at({.kind = EventKind::surface, .hit = *hit}, along.passed);
}

void EyeSubPath::branch_off() {
  const Branch start = at_;
  at_.state.throughput = asked();
  at_.asks = 1.0f;
  Rgb passed(1.0f);
  const Event event = fly_to_event(passed);
  if (event.kind == EventKind::collision && visit(arrive_at(event, passed))) {
    ++at_.events;
    follow_branch();
  }
  at_ = start;
}

std::optional<PathVertex> EyeSubPath::fly() {
  Rgb passed(1.0f);
  const Event event = fly_to_event(passed);
  if (event.kind == EventKind::escape) see_environment(passed);
  if (event.kind != EventKind::collision && event.kind != EventKind::surface) return std::nullopt;
  return arrive_at(event, passed);
}

Event EyeSubPath::fly_to_event(Rgb& passed) {
  std::vector<Track>& tracks = work_.scratch.tracks;
  tracks.clear();
  const Event event = next_event(c_.scene, c_.strategy, at_.state, work_.rng, work_.counters.walk, kInfinity, &tracks);
  for (const Track& track : tracks) {
    const Medium& medium = c_.scene.media[track.medium];
    passed *= transmittance(medium, integral_along(medium, track, work_.counters.walk));
  }
  return event;
}

// --- Vertices

PathVertex EyeSubPath::arrive_at(const Event& event, const Rgb& passed) {
  const PathVertex at = arrive(c_.counts, c_.scene, at_.from, event, at_.state, passed);
  if (at.on_surface) see_emitter(at);
  return at;
}

bool EyeSubPath::visit(const PathVertex& at) {
  if (!is_finite(at_.state.throughput)) {  // the sample is counted, and dropped
    radiance_ += KernelEstimate(at_.state.throughput);
    return false;
  }
  if (is_black(at_.state.throughput)) return false;
  if (!at.specular) {
    if (!at_.only_specular && !c_.counts.deep) return false;
    if (at_.asks == 0.0f) return false;
    at_.state.throughput = asked();
    at_.asks = 1.0f;
    sample_light(at);
    connect(at);
    at.on_surface ? merge_surface(at) : merge_points_3d(at);
    if (!c_.counts.deep && !c_.counts.run_into) return false;
  }
  if (!go_on(at)) return false;
  at_.only_specular &= at.specular;
  return true;
}

bool EyeSubPath::go_on(const PathVertex& at) {
  if (at.specular && at_.only_specular)
    if (const auto sides = both_sides(at.material, at.hit, at_.state.ray.direction, at_.part)) {
      follow_both_sides(at, *sides);
      return true;
    }
  const std::optional<Densities> densities = scatter(c_.scene, at, SubPath::eye, at_.state, work_.rng);
  if (densities) at_.from = depart_into(at, at_.state.ray.direction, *densities);
  return densities.has_value();
}

void EyeSubPath::follow_both_sides(const PathVertex& at, const BothSides& sides) {
  Branch back = side(at, sides.back, sides.reflected);
  Branch beyond = side(at, sides.beyond, 1.0f - sides.reflected);
  Branch& stronger = sides.mostly_beyond() ? beyond : back;
  ++stronger.events;  // of this vertex: the loop counts that of the branch that it follows now
  assert(waiting_ < kMostWaiting);
  branches_[waiting_++] = stronger;
  at_ = sides.mostly_beyond() ? back : beyond;
}

EyeSubPath::Branch EyeSubPath::side(const PathVertex& at, const Scatter& scatter, float fraction) const {
  Branch branch = at_;
  branch.state.throughput *= scatter.weight * (fraction * scatter.radiance_scale);
  branch.part *= fraction;
  branch.asks *= asks_with(fraction, work_.rng);
  leave_along(c_.scene, at.hit, scatter, branch.state);
  branch.from = depart_into(at, branch.state.ray.direction, {1.0, scatter.radiance_scale});
  return branch;
}

// --- Sums

void EyeSubPath::add(Technique technique, const KernelEstimate& found, double share) {
  radiance_ += found * Rgb(static_cast<float>(share));
  if (parts_) parts_->add(technique, found.value, share);
}

void EyeSubPath::add_merged(Technique technique, const Rgb& found, const KernelPair<float>& kernel, double share) {
  add(technique, {found * kernel.value, found * kernel.correction}, share);
  count(work_.counters.gather.used);
}

void EyeSubPath::merge_along_ray(const Along& along, const Interval& interval) {
  const Departure& from = at_.from;
  assert(from.behind == 0.0);  // nothing but the camera can be connected to, and not over mirrors or glass
  const MergeSegment segment{{along.ray, interval, along.medium, asked()},
                             along.passed,
                             glm::distance(from.point, along.ray.origin),
                             from.adjacent > 0.0 ? from.adjacent / from.forward : 0.0,
                             number_};
  if (deferred_ && from.camera && c_.scene.media[along.medium].homogeneous()) return deferred_->push_back(segment);
  for (const Technique technique : kRayTechniques) {
    const Merged merged = merge_along(c_, technique, segment, work_);
    radiance_ += merged.light;
    if (parts_) parts_->add_both(technique, merged.light.value, merged.unweighted);
  }
}

Merged merge_along(const CombinedContext& context, Technique technique, const MergeSegment& segment, EyeWork& work) {
  return technique == Technique::points_2d ? merge_points(context, segment, work) : merge_beams(context, segment, work);
}

void merge_along(const CombinedContext& context, Technique technique, const Vec3& apex,
                 std::span<const MergeSegment> bundle, EyeWork& work, std::span<Merged> merged) {
  if (technique == Technique::points_2d)
    merge_points(context, apex, bundle, work, merged);
  else
    merge_beams(context, apex, bundle, work, merged);
}

namespace {

/// Merges along segments that are in one medium.
void merge_segments(const CombinedContext& context, std::span<const MergeSegment> segments, std::span<EyeRay> rays,
                    TechniqueParts* parts) {
  for (const Technique technique : kRayTechniques) {
    std::array<Merged, kEyeRays> merged{};
    merge_along(context, technique, rays.front().ray.origin, segments, rays.front().work, merged);
    for (size_t i = 0; i < segments.size(); ++i) {
      const size_t number = segments[i].number;
      rays[number].radiance += merged[i].light;
      if (parts) parts[number].add_both(technique, merged[i].light.value, merged[i].unweighted);
    }
  }
}

}  // namespace

KernelEstimate combined_radiance(const CombinedContext& context, const Ray& camera_ray, EyeWork& work,
                                 TechniqueParts* parts) {
  return EyeSubPath(context, camera_ray, work, parts).follow();
}

void combined_radiance(const CombinedContext& context, std::span<EyeRay> rays, TechniqueParts* parts) {
  thread_local std::vector<MergeSegment> deferred;  // so that rays allocate nothing
  deferred.clear();
  for (size_t i = 0; i < rays.size(); ++i)
    rays[i].radiance =
        EyeSubPath(context, rays[i].ray, rays[i].work, parts ? &parts[i] : nullptr, &deferred, i).follow();
  std::sort(deferred.begin(), deferred.end(), [](const MergeSegment& a, const MergeSegment& b) {
    return std::tie(a.medium, a.number, a.before) < std::tie(b.medium, b.number, b.before);
  });
  const std::span<const MergeSegment> all(deferred);
  for (size_t first = 0, next = 0; first < all.size(); first = next) {
    while (next < all.size() && next - first < kEyeRays && all[next].medium == all[first].medium) ++next;
    merge_segments(context, all.subspan(first, next - first), rays, parts);
  }
}

}  // namespace vpm
