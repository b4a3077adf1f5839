// One light sub-path after another, event by event.
#include "vpm/integrators/combined/light_sub_paths.h"

#include <optional>

#include "vpm/base/counters.h"
#include "vpm/path/emission_along.h"
#include "vpm/photon/emission.h"
#include "vpm/photon/recorder.h"
#include "vpm/photon/thin_places.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

class LightSubPath {
 public:
  LightSubPath(const LightTracing& tracing, uint64_t number, LightSubPaths& paths, std::vector<Track>& tracks, Rng& rng)
      : c_(tracing),
        connectable_(tracing.counts.connections > 0.0 && number < tracing.connectable),
        out_(paths),
        tracks_(tracks),
        rng_(rng) {}

  void trace() {
    if (connectable_) ++out_.connectable;
    emit();
    if (!is_black(state_.throughput)) follow();
    out_.ledger.imbalance.add(balance_);
  }

 private:
  void follow() {
    for (int events = 0; events < c_.max_events; ++events) {
      const std::optional<PathVertex> at = fly();
      if (!at || !go_on(*at)) return;
    }
    ++out_.ledger.cut_count;
    lose(state_.throughput, out_.ledger.cut);
  }

  /// Enters where power has gone, W.
  void lose(const Rgb& power, Rgbd& where) {
    where += Rgbd(power);
    balance_ += Rgbd(power);
  }

  void emit() {
    const PickedLight picked = pick_light(c_.scene, rng_.uniform_double());
    const Light& light = c_.scene.lights[picked.number];
    if (const auto* volume = std::get_if<VolumeLight>(&light))
      emit_from(*volume, picked);
    else
      emit_from(light, picked);
    ++out_.ledger.emitted_count;
    out_.ledger.emitted += Rgbd(state_.throughput);
    balance_ -= Rgbd(state_.throughput);
  }

  void emit_from(const Light& light, const PickedLight& picked) {
    const Emission emission = vpm::emit(light, c_.scene.bounds, rng_);
    state_ = {emission.ray, medium_of_ray(c_.scene, c_.scene.light_medium[picked.number], emission.ray),
              emission.power / picked.probability};
    const EmissionDensity density = emission_density(light, c_.scene.bounds, emission.normal, emission.ray.direction);
    from_ = depart_from_light(c_.counts, light, picked.probability, density, emission.ray, emission.normal);
  }

  void emit_from(const VolumeLight& volume, const PickedLight& picked) {
    state_ = emit_from_medium(c_.scene, picked, draw_emission_numbers(rng_));
    emitting_ = volume.medium;
    from_ = depart_from_medium(c_.counts, c_.scene.lights[picked.number], picked.probability, Rgb(0.0f), state_.ray);
  }

  /// On the first flight from a medium that emits, the density of coming to a place is by the line that led there.
  void come_to(const Receiver& place) {
    if (!from_.from_medium) return;
    const Ray back{place.point, -from_.direction};
    const Rgb arriving = emission_of(emitting_, c_.scene, back, place.medium, out_.ledger.walk);
    from_.forward = emission_density(c_.scene.lights[c_.scene.medium_light[emitting_]], arriving).flight;
  }

  /// Flies to the next vertex.
  std::optional<PathVertex> fly() {
    tracks_.clear();
    const Event event = next_event(c_.scene, c_.strategy, state_, rng_, out_.ledger.walk, kInfinity, &tracks_);
    Rgb passed(1.0f);
    for (const Track& track : tracks_) {
      const Medium& medium = c_.scene.media[track.medium];
      if (c_.counts.short_beams > 0.0 && medium.scatters() && track.interval.t1 > 0.0f && !from_.from_medium)
        keep(track, passed);
      keep_thin_photons(track, medium, passed);
      passed *= transmittance(medium, integral_along(medium, track, out_.ledger.walk));
    }
    if (!is_finite(state_.throughput)) {
      ++out_.ledger.non_finite;
      return std::nullopt;
    }
    if (event.kind == EventKind::escape) lose(state_.throughput, out_.ledger.escaped);
    if (event.kind != EventKind::collision && event.kind != EventKind::surface) return std::nullopt;
    ++(event.kind == EventKind::collision ? out_.ledger.collisions : out_.ledger.surface_hits);
    come_to(event.kind == EventKind::collision ? Receiver{state_.ray.origin, state_.medium}
                                               : near_side(event.hit, state_.ray.direction, state_.medium));
    return arrive(c_.counts, c_.scene, from_, event, state_, passed);
  }

  /// Keeps a part of a flight as a beam.
  void keep(const Track& track, const Rgb& before) {
    const auto& [origin, direction] = track.ray;
    out_.flights.beams[track.medium].push_back({origin, track.interval.t1, direction, track.throughput});
    out_.flights.flights[track.medium].push_back(flight_terms(c_.counts, from_, before, origin));
  }

  void keep_thin_photons(const Track& track, const Medium& medium, const Rgb& before) {
    if (!merges_points()) return;
    const ThinParts thin{c_.counts.density_floor, true};
    visit_thin_places(medium, track, thin, rng_, [&](double t) {
      const DensityIntegral integral = density_integral(medium, track.ray, {0.0f, static_cast<float>(t)});
      count(out_.ledger.walk.lookups, integral.lookups);
      count(out_.ledger.floored);
      const Vec3 point = track.ray.at(static_cast<float>(t));
      come_to({point, track.medium});
      keep_photon(track.medium, point, leg_to(from_, point, before * transmittance(medium, integral.value)),
                  power_along(medium, track, integral.value, thin));
    });
  }

  void keep_on_surface(const PathVertex& at) {
    if (c_.counts.surfaces == 0.0 || at.straight) return;
    out_.on_surfaces.push_back({at.point, at.travel, at.power, at.behind.over(merges_on_surface(c_.counts, true))});
  }

  void keep_collided(const PathVertex& at) {
    if (!merges_points()) return;
    const Medium& medium = c_.scene.media[at.medium];
    const float density = relative_density(medium, at.density);
    const float floor = medium.grid ? floor_in(medium, c_.counts.density_floor) : 0.0f;
    if (density < floor) count(out_.ledger.floored);
    keep_photon(at.medium, at.point, at.leg, stored_power(at.power, VolumeForm::density_at_query, density, floor));
  }

  bool merges_points() const { return c_.counts.points_2d > 0.0 || c_.counts.merges_points_3d(true); }

  /// Of a power as stored_power() says.
  void keep_photon(MediumId medium, const Vec3& point, const Leg& leg, const Rgb& power) {
    const Junction even{Junction::Kind::medium, Vec3(0.0f), c_.scene.media[medium].sigma_t};
    out_.photons[medium].push_back(
        {point, from_.direction, power, arrive(c_.counts, from_, leg, even, point), passing(even.sigma_t, leg)});
  }

  /// Keeps the vertex, and draws how the sub-path goes on.
  bool go_on(const PathVertex& at) {
    if (!at.specular && (at.on_surface || c_.scene.media[at.medium].scatters())) {
      if (connectable_) out_.vertices.push_back(at);
      at.on_surface ? keep_on_surface(at) : keep_collided(at);
      if (c_.counts.splats > 0.0) splat(c_, at, rng_, out_);
    }
    Rgbd& absorbed = at.on_surface ? out_.ledger.absorbed_on_surfaces : out_.ledger.absorbed_in_media;
    const std::optional<Densities> densities = scatter(c_.scene, at, SubPath::light, state_, rng_);
    lose(densities ? at.power - state_.throughput : at.power, absorbed);
    if (densities) from_ = depart(c_.counts, at, state_.ray.direction, *densities, SubPath::light, false);
    return densities.has_value();
  }

  const LightTracing& c_;
  bool connectable_;
  LightSubPaths& out_;
  std::vector<Track>& tracks_;
  Rng& rng_;
  PathState state_;
  Departure from_;
  MediumId emitting_ = kVacuum;  // that the sub-path began in
  Rgbd balance_{0.0};            // gone minus emitted, W
};

}  // namespace

void LightSubPaths::take_over(std::span<LightSubPaths> parts) {
  const auto join = [&](auto&& list) {
    size_t size = 0;
    for (LightSubPaths& part : parts) size += list(part).size();
    list(*this).reserve(size);
    for (LightSubPaths& part : parts) join_lists(list(*this), list(part));
  };
  join([](LightSubPaths & of) -> auto& { return of.vertices; });
  join([](LightSubPaths & of) -> auto& { return of.on_surfaces; });
  join([](LightSubPaths & of) -> auto& { return of.splats; });
  for (size_t m = 0; m < photons.size(); ++m) {
    join([m](LightSubPaths & of) -> auto& { return of.photons[m]; });
    join([m](LightSubPaths & of) -> auto& { return of.flights.beams[m]; });
    join([m](LightSubPaths & of) -> auto& { return of.flights.flights[m]; });
  }
  for (const LightSubPaths& part : parts) {
    connectable += part.connectable;
    ledger.merge(part.ledger);
  }
}

void trace_light_sub_paths(const LightTracing& tracing, uint64_t begin, uint64_t end, LightSubPaths& paths) {
  std::vector<Track> tracks;
  PhotonNumbers::Lead lead;
  for (uint64_t i = begin; i < end; ++i) {
    Rng rng = tracing.numbers.of(i, lead);
    LightSubPath(tracing, i, paths, tracks, rng).trace();
  }
}

}  // namespace vpm
