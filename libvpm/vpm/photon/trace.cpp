// The photon pass: photons in fixed chunks, joined in their order.
#include "vpm/photon/trace.h"

#include <fmt/format.h>
#include <algorithm>

#include "vpm/base/count.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/path/path_weight.h"
#include "vpm/photon/emission.h"
#include "vpm/photon/guided_scatter.h"

namespace vpm {
namespace {

constexpr size_t kChunk = 4096;          // photons traced one after another
constexpr size_t kFirstWave = 4;         // chunks traced before the first look at how many are stored
constexpr size_t kLargestWave = 64;      // chunks whose records wait to be joined
constexpr double kWorthSplitting = 2.0;  // photons: what a path is worth at least that is followed by several
constexpr int kMostBranches = 64;        // that one event makes of a path
constexpr uint64_t kHopeless = 1 << 22;  // photons emitted without storing one

/// One photon on its way, with the branches it is followed by, and where it leaves its traces.
class PhotonPath {
 public:
  PhotonPath(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings, TracedPhotons& out)
      : scene_(scene), strategy_(strategy), settings_(settings), out_(out) {
    if (settings.guide && settings.guide->directions) directions_ = &*settings.guide->directions;
  }

  /// Emits and follows photon number `index`.
  void trace(uint64_t index) {
    Rng rng(settings_.seed, rng_stream(RngUse::photon, settings_.pass), index);
    for_sites_ = settings_.keep_sites && index % kSiteStep == kSiteStep - 1;
    emit(rng);
    if (alive_) fly(rng);
    for (; !waiting_.empty(); fly(rng)) {
      at_ = waiting_.back();
      waiting_.pop_back();
      go_on(rng);
    }
    out_.ledger.imbalance.add(balance_);
    weight_.add_to(out_.ledger.weights);
  }

 private:
  /// A path at an event that it has yet to go on from.
  struct Branch {
    PathState state;
    Event event;
    int events = 0;
    bool direct = true;
    bool specular = true;     // nothing but mirrors and glass has scattered it
    bool from_rough = false;  // the last scattering, but for mirrors and glass, was at a rough surface
  };

  void emit(Rng& rng) {
    EmissionGuide::Sample drawn{{}, 1.0f};
    if (settings_.guide)
      drawn = settings_.guide->emission.sample(rng);
    else
      drawn.point = draw_emission_point(rng);
    at_ = {.state = emit_photon(scene_, drawn.point), .event = {}};
    at_.state.power /= drawn.density;
    emitted_power_ = sum_channels(at_.state.power);
    balance_ = -static_cast<double>(emitted_power_);
    weight_ = {};
    alive_ = emitted_power_ > 0.0f;
    ++out_.ledger.emitted_count;
    if (!for_sites_) ++out_.surface_emitted;
    out_.ledger.emitted += Rgbd(at_.state.power);
  }

  /// Flies from event to event, to the path's end.
  void fly(Rng& rng) {
    while (alive_) {
      if (at_.events == settings_.max_events) return cut();
      ++at_.events;
      at_.event = next_event(scene_, strategy_, at_.state, rng, out_.ledger.walk, limit());
      if (!is_finite(at_.state.power)) {
        ++out_.ledger.non_finite;
        return;
      }
      weight_.meet(sum_channels(at_.state.power) / emitted_power_, at_.event);
      arrive(rng);
      if (!alive_) return;
      split(rng);
      go_on(rng);
    }
  }

  /// Leaves traces at an event.
  void arrive(Rng& rng) {
    if (at_.event.kind == EventKind::escape) escape();
    if (at_.event.kind == EventKind::collision) collide(rng);
    if (at_.event.kind == EventKind::surface) meet_surface();
  }

  /// What happens at the event.
  void go_on(Rng& rng) {
    alive_ = true;
    if (at_.event.kind == EventKind::collision) scatter_in(scene_.media[at_.state.medium], rng);
    if (at_.event.kind == EventKind::surface) scatter_at(at_.event.hit, rng);
  }

  void deposit(Rgbd& account, const Rgbd& power) {
    account += power;
    balance_ += power.r + power.g + power.b;
  }
  void escape() {
    deposit(out_.ledger.escaped, Rgbd(at_.state.power));
    alive_ = false;
  }
  void cut() {
    deposit(out_.ledger.cut, Rgbd(at_.state.power));
    ++out_.ledger.cut_count;
  }

  void collide(Rng& rng) {
    const double weight = sum_channels(at_.state.power) / emitted_power_;
    count(out_.ledger.collisions);
    alive_ = weight > 0.0 && survive_roulette(worth(), at_.state, rng);
    if (!alive_) return;
    const Medium& medium = scene_.media[at_.state.medium];
    const Rgb& power = at_.state.power;
    if (settings_.keep_volume && medium.scatters() && (settings_.keep_direct_volume || !at_.direct)) {
      const bool at_query = settings_.volume_form == VolumeForm::density_at_query;
      const float divided = at_query ? divisor(medium, at_.event.density) : 1.0f;
      out_.volume[at_.state.medium].push_back(
          {at_.state.ray.origin, PackedDirection(at_.state.ray.direction), power / divided});
    }
    deposit(out_.ledger.absorbed_in_media, Rgbd(power * (Rgb(1.0f) - medium.albedo())));
    at_.direct = at_.specular = at_.from_rough = false;
  }

  /// What a photon's power is divided by: its density over the medium's largest, or the floor. Counts the floor's use.
  float divisor(const Medium& medium, float density) {
    const float relative = density / medium.max_density();
    if (relative >= settings_.density_floor) return relative;
    count(out_.ledger.floored);
    return settings_.density_floor;
  }

  void meet_surface() {
    count(out_.ledger.surface_hits);
    alive_ = max_channel(at_.state.power) > 0.0f;
    if (!alive_) return;
    const bool rough = is_rough(scene_.material_of(at_.event.hit));
    if (rough) store(at_.event.hit);
    at_.direct = false;
    at_.from_rough |= rough;
    at_.specular &= !rough;
  }

  void store(const Hit& hit) {
    const Photon photon{hit.position, PackedDirection(at_.state.ray.direction), at_.state.power};
    if (for_sites_)
      store_site(hit);
    else if (settings_.keep_surface && (settings_.keep_direct_surface || !at_.direct))
      out_.surface.push_back(photon);
    if (settings_.keep_from_rough && at_.from_rough) out_.from_rough.push_back(photon);
    if (settings_.keep_caustics && !at_.from_rough && is_kept_caustic()) out_.caustics.push_back(photon);
  }

  void store_site(const Hit& hit) {
    if (!is_diffuse(scene_.material_of(hit))) return;
    const float side = glm::dot(hit.normal, at_.state.ray.direction) < 0.0f ? 1.0f : -1.0f;
    out_.sites.push_back(
        {hit.position, PackedDirection(side * hit.normal), PackedDirection(side * hit.shading_normal)});
  }

  bool is_kept_caustic() const {
    if (at_.direct) return settings_.keep_direct_caustics;
    return !at_.specular || settings_.keep_specular_caustics;
  }

  void scatter_in(const Medium& medium, Rng& rng) {
    alive_ = directions_ ? scatter_in_medium(*directions_, medium, at_.state, rng)
                         : scatter_in_medium(medium, at_.state, rng);
  }

  void scatter_at(const Hit& hit, Rng& rng) {
    const Rgb before = at_.state.power;
    Scatter scatter;
    alive_ = directions_ ? scatter_at_surface(*directions_, scene_, hit, at_.state, rng, scatter)
                         : scatter_at_surface(scene_, hit, at_.state, rng, scatter);
    at_.state.power *= scatter.flux_scale;
    deposit(out_.ledger.absorbed_on_surfaces, Rgbd(before * (Rgb(1.0f) - scatter.weight * scatter.flux_scale)));
  }

  /// What the path is worth next to others: its importance, or without any its power.
  double worth() const {
    const double power = sum_channels(at_.state.power);
    return settings_.split ? settings_.guide->worth(power, at_.state.ray.origin) : power / emitted_power_;
  }

  /// How far the path may fly before it is worth a split.
  float limit() const {
    if (!settings_.split) return kInfinity;
    return settings_.guide->rise(sum_channels(at_.state.power), at_.state.ray, kWorthSplitting);
  }

  /// Follows a path that is worth several by as many, each of them worth one [Booth1984].
  void split(Rng& rng) {
    if (!settings_.split) return;
    const double paths = worth();
    if (!(paths > kWorthSplitting)) return;
    const bool many = paths > kMostBranches;
    const int count = many ? kMostBranches : static_cast<int>(paths + rng.uniform());
    at_.state.power /= static_cast<float>(many ? kMostBranches : paths);
    waiting_.insert(waiting_.end(), static_cast<size_t>(count - 1), at_);
  }

  const Scene& scene_;
  const DistanceStrategy& strategy_;
  const TraceSettings& settings_;
  TracedPhotons& out_;
  const DirectionGuide* directions_ = nullptr;  // null: scattering is not guided
  Branch at_;
  std::vector<Branch> waiting_;
  float emitted_power_ = 0.0f;
  double balance_ = 0.0;  // gone minus emitted, W
  PathWeight weight_;     // of all branches
  bool alive_ = true;
  bool for_sites_ = false;
};

void append(TracedPhotons& all, const TracedPhotons& part) {
  for (size_t m = 0; m < all.volume.size(); ++m)
    all.volume[m].insert(all.volume[m].end(), part.volume[m].begin(), part.volume[m].end());
  all.surface.insert(all.surface.end(), part.surface.begin(), part.surface.end());
  all.caustics.insert(all.caustics.end(), part.caustics.begin(), part.caustics.end());
  all.from_rough.insert(all.from_rough.end(), part.from_rough.begin(), part.from_rough.end());
  all.sites.insert(all.sites.end(), part.sites.begin(), part.sites.end());
  all.surface_emitted += part.surface_emitted;
  all.ledger.merge(part.ledger);
}

/// How many photons there are by now.
struct Tally {
  uint64_t emitted = 0;
  size_t volume = 0, surface = 0;  // stored

  size_t stored() const { return std::max(volume, surface); }
  void add(const TracedPhotons& part) {
    emitted += part.ledger.emitted_count;
    for (const auto& map : part.volume) volume += map.size();
    surface += part.surface.size();
  }
};

bool is_full(const Tally& tally, const TraceSettings& settings) {
  return (settings.emitted > 0 && tally.emitted >= settings.emitted) ||
         (settings.stored > 0 && tally.stored() >= settings.stored);
}

/// Joins the parts of a wave in their order, up to the one that fills the maps.
void join(TracedPhotons& all, Tally& joined, std::vector<TracedPhotons>& parts, const TraceSettings& settings) {
  for (TracedPhotons& part : parts) {
    if (!is_full(joined, settings)) {
      joined.add(part);
      append(all, part);
    }
    part = {};  // two copies of a part at a time, not of a wave
  }
}

/// How many photons to trace before looking again. Any answer gives the same result: what lies beyond a full map is
/// dropped.
uint64_t next_wave(const Tally& tally, const TraceSettings& settings) {
  const uint64_t most = settings.emitted > 0 ? settings.emitted - tally.emitted : kChunk * kLargestWave;
  if (settings.stored == 0) return std::min<uint64_t>(most, kChunk * kLargestWave);
  const size_t stored = tally.stored();
  if (stored == 0) return std::min<uint64_t>(most, kChunk * (tally.emitted == 0 ? kFirstWave : kLargestWave));
  const double missing =
      static_cast<double>(settings.stored - stored) * static_cast<double>(tally.emitted) / static_cast<double>(stored);
  return std::min<uint64_t>(
      most, kChunk * std::clamp<uint64_t>(static_cast<uint64_t>(missing / kChunk) + 1, 1, kLargestWave));
}

bool is_stopped(const TraceSettings& settings) { return settings.stop && *settings.stop; }

}  // namespace

TracedPhotons trace_photons(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings,
                            Progress& progress) {
  TracedPhotons all;
  all.volume.resize(scene.media.size());
  Tally traced, joined;
  std::vector<TracedPhotons> parts;
  while (!is_full(traced, settings) && !is_stopped(settings)) {
    const uint64_t first = traced.emitted, last = first + next_wave(traced, settings);
    std::vector<TracedPhotons> next(chunk_count(last - first, kChunk));
    // One thread joins the wave before, while the others trace this one.
    parallel_for_chunks(next.size() + 1, 1, [&](size_t task, size_t, size_t) {
      if (task == 0) return join(all, joined, parts, settings);
      TracedPhotons& part = next[task - 1];
      part.volume.resize(scene.media.size());
      if (is_stopped(settings)) return;
      PhotonPath path(scene, strategy, settings, part);
      const uint64_t begin = first + (task - 1) * kChunk, end = std::min(begin + kChunk, last);
      for (uint64_t i = begin; i < end; ++i) path.trace(i);
      progress.advance(end - begin);
    });
    parts = std::move(next);
    for (const TracedPhotons& part : parts) traced.add(part);
    if (settings.emitted == 0 && traced.emitted >= kHopeless && traced.stored() == 0)
      throw InputError(fmt::format(
          "no photon map can be filled: none of the first {} photons met a medium or a surface that stores photons",
          traced.emitted));
  }
  join(all, joined, parts, settings);
  return all;
}

}  // namespace vpm
