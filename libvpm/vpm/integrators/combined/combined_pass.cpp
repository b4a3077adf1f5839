// Tracing, sorting, the eye pass, and light tracing on top of it.
#include "vpm/integrators/combined/combined_pass.h"

#include <algorithm>
#include <utility>

#include "vpm/base/clock.h"
#include "vpm/base/parallel.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/scene/scene_facts.h"

namespace vpm {
namespace {

constexpr size_t kPathChunk = 2048;   // light sub-paths traced one after another
constexpr uint64_t kFewPaths = 256;   // by which the number of vertices to connect to is estimated
constexpr size_t kFewLights = 4;      // that are all sampled where an eye sub-path has one vertex for it
constexpr float kBeamRadius = 0.25f;  // of that of points: wider beams cost as much time as they save in noise
constexpr double kConnections = 1.0;  // of each vertex of an eye sub-path, to vertices of light sub-paths
// The first so many light sub-paths of a pass may be connected to: points of a sequence cover lights evenly from the
// first on. Which vertex one of an eye sub-path meets is left to chance either way, so that the noise of a pixel is
// that of all.
constexpr uint64_t kConnectable = 8192;

/// The radii of the pass.
MergeKernels kernels_of_pass(const Scene& scene, const RenderSettings& settings, int pass) {
  const PassOfMaps of{pass, settings.radii != RadiusSchedule::constant, 0};
  AskedGather volume = settings.volume, surface = settings.surface;
  volume.mode = surface.mode = GatherMode::radius;
  volume.beam_count = 0;
  const float first = first_radius_of_merges(volume, scene);
  const auto radius = [&](int dimension) { return gather_in_pass(volume, first, dimension, of).radius; };
  return {surface.kernel,          volume.kernel, gather_in_pass(surface, first_radius(surface, scene), 2, of).radius,
          kBeamRadius * radius(1), radius(2),     radius(3)};
}

/// Does all light reach the first vertex from the eye that is not specular by merges?
bool merges_where_the_eye_looks(const Scene& scene, const TechniqueSet& techniques) {
  const SceneFacts facts = facts_of(scene);
  return (!facts.rough_surfaces || techniques.has(Technique::surface_merging)) &&
         (!facts.scattering_media || techniques.merge_in_media());
}

TechniqueCounts counts_of_pass(const Scene& scene, const RenderSettings& settings, const MergeKernels& kernels) {
  const auto paths = static_cast<double>(settings.photons.emitted);
  const TechniqueSet& techniques = settings.combined.techniques;
  TechniqueCounts counts;
  counts.light = techniques.has(Technique::connections);
  counts.run_into = counts.light && std::any_of(scene.lights.begin(), scene.lights.end(), can_be_hit);
  if (techniques.has(Technique::light_tracing)) counts.splats = paths / settings.samples_per_pixel;
  if (techniques.has(Technique::surface_merging))
    counts.surfaces = paths * kernel_size_2d(kernels.surface_kernel, kernels.surface);
  if (techniques.has(Technique::points_3d))
    counts.points_3d = paths * kernel_size_3d(kernels.volume_kernel, kernels.points_3d);
  if (techniques.has(Technique::points_2d))
    counts.points_2d = paths * kernel_size_2d(kernels.volume_kernel, kernels.points_2d);
  if (techniques.has(Technique::short_beams))
    counts.short_beams = paths * kernel_size_1d(kernels.volume_kernel, kernels.beams);
  counts.density_floor = settings.volume.density_floor;
  counts.heuristic = settings.combined.heuristic;
  counts.deep = counts.heuristic != Heuristic::correlation_aware || !merges_where_the_eye_looks(scene, techniques);
  counts.each_light = !counts.deep && scene.lights.size() <= kFewLights;
  return counts;
}

/// A few sub-paths that are independent of those of the pass.
LightSubPaths few_paths(const LightTracing& tracing, const PhotonNumbers& numbers, uint64_t first, uint64_t number) {
  TechniqueCounts counts;
  counts.connections = 1.0;  // so that vertices are kept
  LightSubPaths few(tracing.scene.media.size());
  trace_light_sub_paths({tracing.scene, tracing.strategy, tracing.transmittance, counts, numbers, tracing.max_events},
                        first, first + number, few);
  return few;
}

/// How many connections there are of a vertex of a light sub-path for each vertex of an eye sub-path, where each of the
/// latter has kConnections, one at the most. A few sub-paths say that, as weights must be known while all are traced.
void count_by_few(const LightTracing& tracing, const RenderSettings& settings, int pass, TechniqueCounts& counts) {
  const uint64_t paths = settings.photons.emitted, number = std::min(paths, kFewPaths);
  if (!counts.light) return;
  // Numbers beyond those of the pass: at random, as points of one scrambling depend on each other.
  const PhotonNumbers numbers(PhotonSequence::random, settings.seed, static_cast<uint64_t>(pass));
  const LightSubPaths few = few_paths(tracing, numbers, paths, number);
  counts.connections =
      std::min(1.0, kConnections * static_cast<double>(number) / std::max<double>(1.0, few.vertices.size()));
}

}  // namespace

CombinedPass::CombinedPass(const Scene& scene, const RenderSettings& settings, int pass)
    : scene_(scene),
      paths_(settings.photons.emitted),
      max_events_(settings.max_events),
      strategy_(make_distance_strategy(settings.distance, {.pass = static_cast<uint64_t>(pass)})),
      transmittance_(make_transmittance_estimator({})),
      kernels_(kernels_of_pass(scene, settings, pass)),
      counts_(counts_of_pass(scene, settings, kernels_)) {
  const PhotonNumbers numbers(settings.photons.sequence, settings.seed, static_cast<uint64_t>(pass));
  const LightTracing tracing{scene, *strategy_, *transmittance_, counts_, numbers, max_events_, kConnectable};
  const Stopwatch clock;
  count_by_few(tracing, settings, pass, counts_);
  LightSubPaths light = trace(tracing);
  statistics_.trace_seconds = clock.seconds();
  statistics_.ledger = light.ledger;
  splats_ = std::exchange(light.splats, {});
  light_.emplace(scene, counts_, kernels_, std::move(light));
  statistics_.build_seconds = clock.seconds() - statistics_.trace_seconds;
  statistics_.surface_photons = light_->on_surfaces().size();
  statistics_.volume_photons = light_->photons_in_media();
  statistics_.beams = statistics_.flights = light_->beam_count();
  statistics_.photon_map_bytes = light_->memory_bytes() + splats_.capacity() * sizeof(Splat);
  statistics_.last_volume_radius = std::max({kernels_.beams, kernels_.points_2d, kernels_.points_3d});
  statistics_.last_surface_radius = kernels_.surface;
}

LightSubPaths CombinedPass::trace(const LightTracing& tracing) {
  std::vector<LightSubPaths> parts(chunk_count(paths_, kPathChunk), LightSubPaths(scene_.media.size()));
  parallel_for_chunks(paths_, kPathChunk, [&](size_t begin, size_t end, size_t chunk) {
    trace_light_sub_paths(tracing, begin, end, parts[chunk]);
  });
  LightSubPaths all(scene_.media.size());
  all.take_over(parts);
  return all;
}

KernelEstimate CombinedPass::radiance(const Ray& ray, EyeWork& work) const {
  return combined_radiance(context(), ray, work);
}

void CombinedPass::radiance(std::span<EyeRay> rays, TechniqueParts* parts) const {
  combined_radiance(context(), rays, parts);
}

void CombinedPass::add_light_tracing(Image& image) const {
  std::vector<Rgbd> sums(image.pixels.size(), Rgbd(0.0));
  for (const Splat& splat : splats_) sums[splat.pixel] += Rgbd(splat.radiance * splat.share);
  for (size_t i = 0; i < sums.size(); ++i) image.pixels[i] += Rgb(sums[i] / static_cast<double>(paths_));
}

void CombinedPass::add_light_tracing(TechniqueLayers& layers) const {
  for (const Splat& splat : splats_) {
    TechniqueParts parts;
    parts.add(Technique::light_tracing, splat.radiance, splat.share);
    layers.add(splat.pixel, parts, static_cast<double>(paths_));
  }
}

float first_radius_of_merges(const AskedGather& volume, const Scene& scene) {
  float first = first_radius(volume, scene);
  for (const Medium& medium : scene.media)
    if (medium.scatters()) first = std::min(first, first_radius(volume, scene, medium));
  return first;
}

RenderSettings with_light_paths(const RenderSettings& settings, uint64_t most) {
  RenderSettings few = settings;
  few.photons.emitted = std::min(most, settings.photons.emitted);
  return few;
}

bool merges(const TechniqueSet& techniques) {
  return techniques.has(Technique::surface_merging) || techniques.merge_in_media();
}

Pass render_combined_pass(const Scene& scene, const RenderSettings& settings, int pass, const PassProgress& progress) {
  const CombinedPass ready(scene, settings, pass);
  std::optional<TechniqueLayers> layers;
  if (settings.combined.layers) layers.emplace(scene.camera.width, scene.camera.height);
  const auto radiance = [&](std::span<EyeRay> rays) {
    if (!layers) return ready.radiance(rays);
    std::array<TechniqueParts, kEyeRays> parts{};
    ready.radiance(rays, parts.data());
    for (size_t i = 0; i < rays.size(); ++i)
      if (is_finite(rays[i].radiance.value) && is_finite(rays[i].radiance.correction))
        layers->add(rays[i].work.pixel, parts[i], settings.samples_per_pixel);
  };
  Pass result = render_image(scene, settings, pass, radiance, progress);
  ready.add_light_tracing(result.image);
  if (layers) {
    ready.add_light_tracing(*layers);
    std::vector<Image> parts = layers->images();
    result.layers.insert(result.layers.begin(), parts.begin(), parts.end());
  }
  result.statistics.merge(ready.statistics());
  return result;
}

}  // namespace vpm
