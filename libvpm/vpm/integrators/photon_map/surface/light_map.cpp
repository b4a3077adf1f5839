// Points of texels, and the light that arrives there.
#include "vpm/integrators/photon_map/surface/light_map.h"

#include <cassert>

#include "vpm/base/clock.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/integrators/photon_map/photon_pass.h"

namespace vpm {
namespace {

constexpr size_t kTexelChunk = 256;  // texels, of parallel work

/// The medium on the side of the outward normal.
MediumId medium_outside(const Scene& scene, const Hit& point) {
  if (scene.media.empty()) return kVacuum;
  return medium_of_ray(scene, kSeveralMedia, {leave_surface(point, point.normal), point.normal});
}

/// What the texels of a pass read.
struct TexelContext {
  const Scene& scene;
  const RenderSettings& settings;
  const UvLayout& layout;
  const SurfaceEstimator& estimator;
  int pass;
};

/// Irradiance, W/m^2, on the side of the outward normal: pi times the radiance of a white Lambertian surface in the
/// place of the real one.
KernelEstimate irradiance(const TexelContext& context, const Hit& point, EyeWork& work) {
  Hit flat = point;
  flat.shading_normal = flat.normal;
  const Material white = Lambertian{Rgb(1.0f)};
  const SurfaceView view{flat, white, -flat.normal, medium_outside(context.scene, flat)};
  return context.estimator.sent(view, work) * Rgb(kPi);
}

/// What a chunk of texels works with.
struct TexelWork {
  EyeCounters& counters;
  EyeScratch scratch;
  std::vector<UvPiece> pieces;
};

KernelEstimate bake_texel(const TexelContext& context, size_t texel, TexelWork& chunk) {
  if (!context.layout.covers(texel)) return {};
  find_pieces(context.layout, texel, chunk.pieces);
  const int samples = context.settings.samples_per_pixel;
  return mean_of_samples(samples, chunk.counters, [&](int s) {
    Rng rng(context.settings.seed, rng_stream(RngUse::texel, static_cast<uint64_t>(context.pass)),
            static_cast<uint64_t>(texel) * samples + s);
    EyeWork work{rng, chunk.counters, chunk.scratch};
    return irradiance(context, sample_pieces(context.scene.geometry, context.layout, chunk.pieces, rng), work);
  });
}

/// Traces and gathers the photons of a block.
Pass bake_block(const Scene& scene, const RenderSettings& settings, const UvLayout& layout, const PassRun& run) {
  Pass result(layout.resolution, layout.resolution);
  const Estimators estimators = plan_surface_estimators(scene, settings, run.pass);
  prepare_pass(scene, settings, estimators, run, result.statistics);
  const TexelContext context{scene, settings, layout, *estimators.surface, run.pass};
  const Stopwatch baking;
  const size_t chunks = chunk_count(layout.texels(), kTexelChunk);
  std::vector<EyeCounters> counters(chunks);
  Progress bar("texels", chunks, run.progress.stages);
  parallel_for_chunks(layout.texels(), kTexelChunk, [&](size_t begin, size_t end, size_t chunk) {
    TexelWork work{counters[chunk], {}, {}};
    for (size_t texel = begin; texel < end; ++texel) {
      const auto column = static_cast<int>(texel % layout.resolution),
                 row = static_cast<int>(texel / layout.resolution);
      result.set(column, row, bake_texel(context, texel, work));
    }
    bar.advance();
    if (run.progress.tiles) run.progress.tiles->advance();
  });
  bar.finish();
  for (const EyeCounters& c : counters) result.statistics.eye.merge(c);
  result.statistics.eye_seconds = baking.seconds();
  return result;
}

}  // namespace

UvLayout lay_out_light_map(const Scene& scene, uint32_t shape, int resolution) {
  if (!is_rough(scene.materials[scene.shapes[shape].material]))
    throw InputError(
        "its material stores no photons: light maps are of shapes whose material is lambertian, phong, rough-conductor "
        "or rough-dielectric, and not black");
  return lay_out(scene.geometry, shape, resolution);
}

Pass light_map_pass(const Scene& scene, const RenderSettings& settings, const UvLayout& layout, int pass,
                    const PassProgress& progress) {
  assert(settings.integrator == Integrator::photon && settings.radii != RadiusSchedule::per_pixel);
  return mean_of_blocks(settings, [&](const PhotonBlock& block) {
    return bake_block(scene, settings, layout, {pass, progress, block});
  });
}

uint64_t light_map_work(const UvLayout& layout) { return chunk_count(layout.texels(), kTexelChunk); }

}  // namespace vpm
