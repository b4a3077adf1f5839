// The photon pass: photons in fixed chunks, joined in their order.
#include "vpm/photon/trace.h"

#include <fmt/format.h>
#include <algorithm>

#include "vpm/base/counters.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/path/path_weight.h"
#include "vpm/photon/emission.h"
#include "vpm/photon/guide/guided_scatter.h"

namespace vpm {
namespace {

constexpr size_t kPhotonChunk = 4096;    // photons traced one after another
constexpr size_t kFirstWave = 4;         // chunks traced before the first look at how many are stored
constexpr size_t kLargestWave = 64;      // chunks whose records wait to be joined
constexpr double kWorthSplitting = 2.0;  // photons: what a path is worth at least that is followed by several
constexpr int kMostBranches = 64;        // that one event makes of a path
constexpr uint64_t kHopeless = 1 << 22;  // photons emitted without storing one

/// A chunk of photons, traced.
struct Part {
  Ledger ledger;
  std::vector<std::unique_ptr<PhotonRecorder>> recorders;
};

/// One photon on its way, with the branches it is followed by, and where it leaves its traces.
class PhotonPath {
 public:
  PhotonPath(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings,
             const PhotonNumbers& numbers, Part& out)
      : scene_(scene), strategy_(strategy), settings_(settings), numbers_(numbers), out_(out) {
    if (settings.guide && settings.guide->directions) directions_ = &*settings.guide->directions;
    for (const auto& recorder : out.recorders) {
      const RecordNeeds needs = recorder->needs();
      if (needs.flights) of_flights_.push_back(recorder.get());
      if (needs.collisions) of_collisions_.push_back(recorder.get());
      if (needs.hits) of_hits_.push_back(recorder.get());
      if (needs.escapes) of_escapes_.push_back(recorder.get());
      if (needs.ways) of_ways_.push_back(recorder.get());
    }
  }

  /// Emits and follows photon number `index`.
  void trace(uint64_t index) {
    Rng rng = numbers_.of(index, lead_);
    number_ = index;
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
    Vec3 departed{0.0f};  // where its flight began, m
    int events = 0;
    uint32_t scatterings = 0, reflections = 0;
    bool from_rough = false;  // the last non-specular scattering was at a surface
    Turn turn;
  };

  void emit(Rng& rng) {
    EmissionGuide::Sample drawn{{}, 1.0f};
    if (settings_.guide)
      drawn = settings_.guide->emission.sample(rng);
    else
      drawn.point = draw_emission_point(rng);
    at_ = {};
    at_.state = emit_photon(scene_, drawn.point);
    at_.state.throughput /= drawn.density;
    at_.departed = at_.state.ray.origin;
    emitted_power_ = sum_channels(at_.state.throughput);
    balance_ = -Rgbd(at_.state.throughput);
    weight_ = {};
    alive_ = emitted_power_ > 0.0f;
    ++out_.ledger.emitted_count;
    out_.ledger.emitted += Rgbd(at_.state.throughput);
    for (const auto& recorder : out_.recorders) recorder->emitted(number_);
  }

  /// Flies from event to event, to the path's end.
  void fly(Rng& rng) {
    while (alive_) {
      if (at_.events == settings_.max_events) return cut();
      ++at_.events;
      tracks_.clear();
      at_.event = next_event(scene_, strategy_, at_.state, rng, out_.ledger.walk, limit(),
                             of_flights_.empty() ? nullptr : &tracks_);
      if (!is_finite(at_.state.throughput)) {
        ++out_.ledger.non_finite;
        return;
      }
      weight_.meet(sum_channels(at_.state.throughput) / emitted_power_, at_.event);
      for (const Track& track : tracks_)
        for (PhotonRecorder* const recorder : of_flights_) recorder->flew(track, arriving(), rng);
      if (ends_way())
        for (PhotonRecorder* const recorder : of_ways_) recorder->travelled(arriving(), tracks_);
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
    if (at_.event.kind == EventKind::limit && scene_.period) cross_period();
    if (ends_way()) at_.departed = at_.state.ray.origin;
    if (at_.event.kind == EventKind::collision) {
      at_.turn = {at_.state.ray.direction, at_.state.medium, at_.event.density};
      scatter_in(scene_.media[at_.state.medium], rng);
    }
    if (at_.event.kind == EventKind::surface) {
      at_.turn = {};
      scatter_at(at_.event.hit, rng);
    }
  }

  void deposit(Rgbd& account, const Rgbd& power) {
    account += power;
    balance_ += power;
  }
  void escape() {
    deposit(out_.ledger.escaped, Rgbd(at_.state.throughput));
    for (PhotonRecorder* const recorder : of_escapes_) recorder->escaped(arriving());
    alive_ = false;
  }
  void cut() {
    deposit(out_.ledger.cut, Rgbd(at_.state.throughput));
    ++out_.ledger.cut_count;
  }

  void collide(Rng& rng) {
    const double weight = sum_channels(at_.state.throughput) / emitted_power_;
    count(out_.ledger.collisions);
    alive_ = weight > 0.0 && survive_roulette(worth(), at_.state, rng);
    if (!alive_) return;
    for (PhotonRecorder* const recorder : of_collisions_) recorder->collided(arriving());
    const MediumProperties here = scene_.media[at_.state.medium].properties(at_.state.ray.origin);
    deposit(out_.ledger.absorbed_in_media, Rgbd(at_.state.throughput * (Rgb(1.0f) - here.albedo())));
    ++at_.scatterings;
    at_.from_rough = false;
  }

  void meet_surface() {
    count(out_.ledger.surface_hits);
    alive_ = max_channel(at_.state.throughput) > 0.0f;
    if (!alive_) return;
    const bool rough = is_rough(scene_.material_of(at_.event.hit));
    for (PhotonRecorder* const recorder : of_hits_) recorder->hit(arriving());
    ++(rough ? at_.scatterings : at_.reflections);
    at_.from_rough |= rough;
  }

  void scatter_in(const Medium& medium, Rng& rng) {
    const MediumProperties here = medium.properties(at_.state.ray.origin);
    alive_ =
        directions_ ? scatter_in_medium(*directions_, here, at_.state, rng) : scatter_in_medium(here, at_.state, rng);
  }

  void scatter_at(const Hit& hit, Rng& rng) {
    const Rgb before = at_.state.throughput;
    Scatter scatter;
    alive_ = directions_ ? scatter_at_surface(*directions_, scene_, hit, at_.state, rng, scatter)
                         : scatter_at_surface(scene_, hit, at_.state, rng, scatter);
    at_.state.throughput *= scatter.flux_scale;
    deposit(out_.ledger.absorbed_on_surfaces, Rgbd(before * (Rgb(1.0f) - scatter.weight * scatter.flux_scale)));
  }

  ArrivingPhoton arriving() const {
    return {number_, at_.state, at_.event, at_.departed, at_.scatterings, at_.reflections, at_.from_rough, at_.turn};
  }

  /// What the path is worth next to others: its importance, or without any its power.
  double worth() const {
    const double power = sum_channels(at_.state.throughput);
    return settings_.split ? settings_.guide->worth(power, at_.state.ray.origin) : power / emitted_power_;
  }

  /// Does the straight way of the path end at the event? It goes on behind a limit, unless that is a side of the
  /// period.
  bool ends_way() const { return at_.event.kind != EventKind::limit || scene_.period; }

  /// From a side of the period to the opposite one, where another medium may be.
  void cross_period() {
    scene_.period->cross(at_.state.ray);
    at_.state.medium = medium_of_ray(scene_, kSeveralMedia, at_.state.ray);
  }

  /// How far the path may fly: to a side of the period, or before it is worth a split.
  float limit() const {
    if (scene_.period) return scene_.period->to_side(at_.state.ray);
    if (!settings_.split) return kInfinity;
    return settings_.guide->rise(sum_channels(at_.state.throughput), at_.state.ray, kWorthSplitting);
  }

  /// Follows a path that is worth several by as many, each of them worth one [Booth1984].
  void split(Rng& rng) {
    if (!settings_.split) return;
    const double paths = worth();
    if (!(paths > kWorthSplitting)) return;
    const bool many = paths > kMostBranches;
    const int count = many ? kMostBranches : static_cast<int>(paths + rng.uniform());
    at_.state.throughput /= static_cast<float>(many ? kMostBranches : paths);
    waiting_.insert(waiting_.end(), static_cast<size_t>(count - 1), at_);
  }

  const Scene& scene_;
  const DistanceStrategy& strategy_;
  const TraceSettings& settings_;
  const PhotonNumbers& numbers_;
  PhotonNumbers::Lead lead_;
  Part& out_;
  Recorders of_flights_, of_collisions_, of_hits_, of_escapes_, of_ways_;  // those of `out_` that record these
  const DirectionGuide* directions_ = nullptr;                             // null: scattering is not guided
  Branch at_;
  std::vector<Branch> waiting_;
  std::vector<Track> tracks_;  // of the last flight, if a recorder wants them
  float emitted_power_ = 0.0f;
  Rgbd balance_{0.0};  // gone minus emitted, W
  PathWeight weight_;  // of all branches
  bool alive_ = true;
  uint64_t number_ = 0;  // of the photon
};

/// How many photons there are by now.
struct Tally {
  uint64_t emitted = 0;
  std::vector<size_t> by_recorder;

  explicit Tally(size_t recorders) : by_recorder(recorders) {}
  size_t stored() const { return by_recorder.empty() ? 0 : *std::max_element(by_recorder.begin(), by_recorder.end()); }
  void add(const Part& part) {
    emitted += part.ledger.emitted_count;
    for (size_t i = 0; i < by_recorder.size(); ++i) by_recorder[i] += part.recorders[i]->stored();
  }
};

bool is_full(const Tally& tally, const TraceSettings& settings) {
  return (settings.emitted > 0 && tally.emitted >= settings.emitted) ||
         (settings.stored > 0 && tally.stored() >= settings.stored);
}

/// What is joined so far.
struct Joined {
  const Recorders& recorders;
  Ledger ledger{};
  Tally tally{recorders.size()};

  /// Joins the parts of a wave in their order, up to the one that fills the recorders.
  void add(std::vector<Part>& parts, const TraceSettings& settings) {
    for (Part& part : parts) {
      if (!is_full(tally, settings)) {
        tally.add(part);
        ledger.merge(part.ledger);
        for (size_t i = 0; i < recorders.size(); ++i) recorders[i]->join(*part.recorders[i]);
      }
      part = {};  // two copies of a part at a time, not of a wave
    }
  }
};

/// How many photons to trace before looking again. Any answer gives the same result: what lies beyond a full recorder
/// is dropped.
uint64_t next_wave(const Tally& tally, const TraceSettings& settings) {
  const uint64_t most = settings.emitted > 0 ? settings.emitted - tally.emitted : kPhotonChunk * kLargestWave;
  if (settings.stored == 0) return std::min<uint64_t>(most, kPhotonChunk * kLargestWave);
  const size_t stored = tally.stored();
  if (stored == 0) return std::min<uint64_t>(most, kPhotonChunk * (tally.emitted == 0 ? kFirstWave : kLargestWave));
  const double missing =
      static_cast<double>(settings.stored - stored) * static_cast<double>(tally.emitted) / static_cast<double>(stored);
  return std::min<uint64_t>(
      most, kPhotonChunk * std::clamp<uint64_t>(static_cast<uint64_t>(missing / kPhotonChunk) + 1, 1, kLargestWave));
}

Part empty_part(const Recorders& recorders) {
  Part part;
  for (const PhotonRecorder* recorder : recorders) part.recorders.push_back(recorder->part());
  return part;
}

}  // namespace

Ledger trace_photons(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings,
                     const Recorders& recorders, Progress& progress) {
  const PhotonNumbers numbers(settings.sequence, settings.seed, settings.pass);
  Joined joined{recorders};
  Tally traced(recorders.size());
  std::vector<Part> parts;
  while (!is_full(traced, settings)) {
    const uint64_t first = settings.first + traced.emitted, last = first + next_wave(traced, settings);
    std::vector<Part> next(chunk_count(last - first, kPhotonChunk));
    // One thread joins the wave before, while the others trace this one.
    parallel_for_chunks(next.size() + 1, 1, [&](size_t task, size_t, size_t) {
      if (task == 0) return joined.add(parts, settings);
      Part& part = next[task - 1] = empty_part(recorders);
      PhotonPath path(scene, strategy, settings, numbers, part);
      const uint64_t begin = first + (task - 1) * kPhotonChunk, end = std::min(begin + kPhotonChunk, last);
      for (uint64_t i = begin; i < end; ++i) path.trace(i);
      progress.advance(end - begin);
    });
    parts = std::move(next);
    for (const Part& part : parts) traced.add(part);
    if (settings.emitted == 0 && traced.emitted >= kHopeless && traced.stored() == 0)
      throw InputError(fmt::format(
          "no photon map can be filled: none of the first {} photons met a medium or a surface that stores photons",
          traced.emitted));
  }
  joined.add(parts, settings);
  return joined.ledger;
}

}  // namespace vpm
