// The photon pass: photons in fixed chunks, joined in their order.
#include "photon/trace.h"

#include <fmt/format.h>
#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "path/direct_light.h"
#include "path/walk.h"

namespace vpm {
namespace {

constexpr size_t kChunk = 4096;          // photons traced one after another
constexpr size_t kFirstWave = 4;         // chunks traced before the first look at how many are stored
constexpr size_t kLargestWave = 64;      // chunks whose records wait to be joined
constexpr uint64_t kHopeless = 1 << 22;  // photons emitted without storing one

/// One photon on its way, and where it leaves its traces.
class PhotonPath {
 public:
  PhotonPath(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings, TracedPhotons& out)
      : scene_(scene), strategy_(strategy), settings_(settings), out_(out) {}

  /// Emits and follows photon number `index`.
  void trace(uint64_t index) {
    Rng rng(settings_.seed, rng_stream(RngUse::photon, settings_.pass), index);
    emit(rng);
    for (int events = 0; alive_; ++events) {
      if (events == settings_.max_events) {
        cut();
        break;
      }
      const Event event = next_event(scene_, strategy_, state_, rng, out_.ledger.walk);
      if (!is_finite(state_.power)) {
        ++out_.ledger.non_finite;
        break;
      }
      if (event.kind == EventKind::escape) escape();
      if (event.kind == EventKind::collision) collide(event, rng);
      if (event.kind == EventKind::surface) meet_surface(event.hit, rng);
    }
    out_.ledger.imbalance.add(balance_);
  }

 private:
  void emit(Rng& rng) {
    const int light = pick_light(scene_, rng.uniform());
    Emission emission = vpm::emit(scene_.lights[light], scene_.bounds, rng);
    emission.power /= scene_.light_probability[light];
    state_ = {emission.ray, medium_of_ray(scene_, scene_.light_medium[light], emission.ray), emission.power};
    emitted_power_ = sum_channels(emission.power);
    balance_ = -static_cast<double>(emitted_power_);
    direct_ = true;
    from_rough_ = false;
    alive_ = emitted_power_ > 0.0f;
    ++out_.ledger.emitted_count;
    out_.ledger.emitted += Rgbd(emission.power);
  }

  void deposit(Rgbd& account, const Rgbd& power) {
    account += power;
    balance_ += power.r + power.g + power.b;
  }
  void escape() {
    deposit(out_.ledger.escaped, Rgbd(state_.power));
    alive_ = false;
  }
  void cut() {
    deposit(out_.ledger.cut, Rgbd(state_.power));
    ++out_.ledger.cut_count;
  }

  void collide(const Event& event, Rng& rng) {
    const double weight = sum_channels(state_.power) / emitted_power_;
    ++out_.ledger.collisions;
    out_.ledger.weight_sum += weight;
    out_.ledger.weight_squares += weight * weight;
    out_.ledger.largest_weight = std::max(out_.ledger.largest_weight, weight);
    alive_ = weight > 0.0 && survive_roulette(weight, state_, rng);
    if (!alive_) return;
    const Medium& medium = scene_.media[state_.medium];
    if (settings_.keep_volume && medium.scatters() && (settings_.keep_direct_volume || !direct_)) {
      const Rgb power = state_.power /
                        (settings_.volume_form == VolumeForm::density_at_query ? divisor(medium, event.density) : 1.0f);
      out_.volume[state_.medium].push_back({state_.ray.origin, PackedDirection(state_.ray.direction), power});
    }
    deposit(out_.ledger.absorbed_in_media, Rgbd(state_.power * (Rgb(1.0f) - medium.albedo())));
    direct_ = from_rough_ = false;
    alive_ = scatter_in_medium(medium, state_, rng);
  }

  /// What a photon's power is divided by: its density over the medium's largest, or the floor. Counts the floor's use.
  float divisor(const Medium& medium, float density) {
    const float relative = density / medium.max_density();
    if (relative >= settings_.density_floor) return relative;
    ++out_.ledger.floored;
    return settings_.density_floor;
  }

  void meet_surface(const Hit& hit, Rng& rng) {
    ++out_.ledger.surface_hits;
    out_.ledger.largest_weight =
        std::max<double>(out_.ledger.largest_weight, sum_channels(state_.power) / emitted_power_);
    alive_ = max_channel(state_.power) > 0.0f;
    if (!alive_) return;
    const bool rough = is_rough(scene_.material_of(hit));
    if (rough) store(hit);
    const Rgb before = state_.power;
    Scatter scatter;
    direct_ = false;
    from_rough_ |= rough;
    alive_ = scatter_at_surface(scene_, hit, state_, rng, scatter);
    state_.power *= scatter.flux_scale;
    deposit(out_.ledger.absorbed_on_surfaces, Rgbd(before * (Rgb(1.0f) - scatter.weight * scatter.flux_scale)));
  }

  void store(const Hit& hit) {
    const Photon photon{hit.position, PackedDirection(state_.ray.direction), state_.power};
    if (settings_.keep_surface && (settings_.keep_direct_surface || !direct_)) out_.surface.push_back(photon);
    if (settings_.keep_caustics && !from_rough_ && (settings_.keep_direct_caustics || !direct_))
      out_.caustics.push_back(photon);
  }

  const Scene& scene_;
  const DistanceStrategy& strategy_;
  const TraceSettings& settings_;
  TracedPhotons& out_;
  PathState state_;
  float emitted_power_ = 0.0f;
  double balance_ = 0.0;  // gone minus emitted, W
  bool direct_ = true;
  bool from_rough_ = false;  // the last scattering, but for mirrors and glass, was at a rough surface
  bool alive_ = true;
};

void append(TracedPhotons& all, const TracedPhotons& part) {
  for (size_t m = 0; m < all.volume.size(); ++m)
    all.volume[m].insert(all.volume[m].end(), part.volume[m].begin(), part.volume[m].end());
  all.surface.insert(all.surface.end(), part.surface.begin(), part.surface.end());
  all.caustics.insert(all.caustics.end(), part.caustics.begin(), part.caustics.end());
  all.ledger.merge(part.ledger);
}

size_t stored_count(const TracedPhotons& photons) {
  size_t volume = 0;
  for (const auto& map : photons.volume) volume += map.size();
  return std::max(volume, photons.surface.size());
}

bool is_full(const TracedPhotons& photons, const TraceSettings& settings) {
  return (settings.emitted > 0 && photons.ledger.emitted_count >= settings.emitted) ||
         (settings.stored > 0 && stored_count(photons) >= settings.stored);
}

/// How many photons to trace before looking again. Any answer gives the same result: what lies beyond a full map is
/// dropped.
uint64_t next_wave(const TracedPhotons& photons, const TraceSettings& settings, uint64_t traced) {
  const uint64_t most = settings.emitted > 0 ? settings.emitted - traced : kChunk * kLargestWave;
  if (settings.stored == 0) return std::min<uint64_t>(most, kChunk * kLargestWave);
  const size_t stored = stored_count(photons);
  if (stored == 0) return std::min<uint64_t>(most, kChunk * (traced == 0 ? kFirstWave : kLargestWave));
  const double missing =
      static_cast<double>(settings.stored - stored) * static_cast<double>(traced) / static_cast<double>(stored);
  return std::min<uint64_t>(
      most, kChunk * std::clamp<uint64_t>(static_cast<uint64_t>(missing / kChunk) + 1, 1, kLargestWave));
}

bool is_stopped(const TraceSettings& settings) { return settings.stop && *settings.stop; }

}  // namespace

TracedPhotons trace_photons(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings,
                            Progress& progress) {
  TracedPhotons all;
  all.volume.resize(scene.media.size());
  for (uint64_t first = 0; !is_full(all, settings) && !is_stopped(settings);) {
    const uint64_t wave = next_wave(all, settings, first);
    std::vector<TracedPhotons> parts(chunk_count(wave, kChunk));
    parallel_for_chunks(wave, kChunk, [&](size_t begin, size_t end, size_t chunk) {
      parts[chunk].volume.resize(scene.media.size());
      if (is_stopped(settings)) return;
      PhotonPath path(scene, strategy, settings, parts[chunk]);
      for (size_t i = begin; i < end; ++i) path.trace(first + i);
      progress.advance(end - begin);
    });
    for (const TracedPhotons& part : parts)
      if (!is_full(all, settings)) append(all, part);
    first += wave;
    if (settings.emitted == 0 && first >= kHopeless && stored_count(all) == 0)
      throw InputError(fmt::format(
          "no photon map can be filled: none of the first {} photons met a medium or a surface that stores photons",
          first));
  }
  return all;
}

}  // namespace vpm
