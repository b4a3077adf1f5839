// Points of texels, and the light that arrives there.
#include "vpm/render/light_map.h"

#include <cassert>
#include <chrono>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/render/surface_light.h"
#include "vpm/render/validate.h"

namespace vpm {
namespace {

constexpr size_t kChunk = 256;  // texels, of parallel work

/// The medium on the side of the outward normal.
MediumId medium_outside(const Scene& scene, const Hit& point) {
  if (scene.media.empty()) return kVacuum;
  return medium_of_ray(scene, kSeveralMedia, {leave_surface(point, point.normal), point.normal});
}

/// Irradiance, W/m^2, on the side of the outward normal: pi times the radiance of a white Lambertian surface in the
/// place of the real one.
Rgb irradiance(const EyeContext& context, const Hit& point, Rng& rng, EyeCounters& counters) {
  Hit flat = point;
  flat.shading_normal = flat.normal;
  const Material white = Lambertian{Rgb(1.0f)};
  const SurfaceView view{flat, white, -flat.normal, medium_outside(context.scene, flat)};
  return kPi * surface_light(context, view, context.settings.gather_rays, rng, counters);
}

Rgb bake_texel(const EyeContext& context, const UvLayout& layout, int pass, size_t texel, std::vector<UvPiece>& pieces,
               EyeCounters& counters) {
  if (!layout.covers(texel)) return Rgb(0.0f);
  find_pieces(layout, texel, pieces);
  const int samples = context.settings.samples_per_pixel;
  return mean_of_samples(samples, counters, [&](int s) {
    Rng rng(context.settings.seed, rng_stream(RngUse::texel, static_cast<uint64_t>(pass)),
            static_cast<uint64_t>(texel) * samples + s);
    const Hit point = sample_pieces(context.scene.geometry, layout, pieces, rng);
    return irradiance(context, point, rng, counters);
  });
}

}  // namespace

Stages light_map_stages(const Scene& scene, const RenderSettings& settings) {
  Stages stages = plan_stages(scene, settings);
  stages.volume_map = stages.volume_shadow_rays = stages.equiangular = false;
  return stages;
}

UvLayout lay_out_light_map(const Scene& scene, uint32_t shape, int resolution) {
  if (!is_rough(scene.materials[scene.shapes[shape].material]))
    throw InputError(
        "its material stores no photons: light maps are of shapes whose material is lambertian, phong, rough-conductor "
        "or rough-dielectric, and not black");
  return lay_out(scene.geometry, shape, resolution);
}

Pass light_map_pass(const Scene& scene, const RenderSettings& settings, const UvLayout& layout, int pass,
                    const std::atomic<bool>& stop, const PassProgress& progress) {
  const Stages stages = light_map_stages(scene, settings);
  assert(settings.integrator == Integrator::photon && !stages.pixel_discs);
  Pass result{.image = Image(layout.resolution, layout.resolution), .found = {}, .statistics = {}};
  result.statistics.passes = 1;
  const EyeContext context = make_eye_context(scene, settings, stages, pass, stop, progress, result.statistics);
  const auto start = std::chrono::steady_clock::now();
  const size_t chunks = chunk_count(layout.texels(), kChunk);
  std::vector<EyeCounters> counters(chunks);
  Progress bar("texels", chunks, progress.stages);
  parallel_for_chunks(layout.texels(), kChunk, [&](size_t begin, size_t end, size_t chunk) {
    if (stop) return;
    std::vector<UvPiece> pieces;
    for (size_t texel = begin; texel < end; ++texel)
      result.image.pixels[texel] = bake_texel(context, layout, pass, texel, pieces, counters[chunk]);
    bar.advance();
    if (progress.tiles) progress.tiles->advance();
  });
  bar.finish();
  for (const EyeCounters& c : counters) result.statistics.eye.merge(c);
  result.statistics.eye_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.relative_square = relative_square(settings, stages, pass);
  return result;
}

RenderResult bake_light_map(const Scene& scene, const RenderSettings& settings, const UvLayout& layout,
                            const std::atomic<bool>& stop, ProgressMode progress) {
  validate(settings, facts_of(scene));
  const auto run = [&](const RenderResult& so_far, const PassProgress& shown) {
    return light_map_pass(scene, settings, layout, so_far.film.passes(), stop, shown);
  };
  return run_passes(settings, run, chunk_count(layout.texels(), kChunk),
                    {Film(layout.resolution, layout.resolution), {}, 0.0, {}}, stop, progress);
}

}  // namespace vpm
