// What a render tells of itself.
#include "report.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <nlohmann/json.hpp>
#include <numeric>

#include "stage_lines.h"
#include "vpm/base/parallel.h"
#include "vpm/base/version.h"
#include "vpm/estimate/pass_map.h"
#include "vpm/render/plan.h"
#include "vpm/render/setting.h"

namespace vpm::tools {
namespace {

using Json = nlohmann::ordered_json;

Json rgb(const Rgbd& c) { return Json::array({c.r, c.g, c.b}); }

double per_second(uint64_t count, double seconds) { return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0; }

Json times(const RenderResult& result) {
  const RenderStatistics& s = result.statistics;
  return {{"unit", "s, wall clock"},       {"total", result.seconds},         {"photon_tracing", s.trace_seconds},
          {"importance", s.guide_seconds}, {"map_building", s.build_seconds}, {"eye_pass", s.eye_seconds}};
}

/// Numbers of single precision as they are written, not as double precision has them.
Json json_of(const SettingValue& value) {
  if (std::holds_alternative<float>(value)) return Json::parse(text_of(value));
  return std::visit([](const auto& held) { return Json(held); }, value);
}

/// By key; those that no other setting makes useless.
Json settings(const RenderSettings& s) {
  Json all = Json::object();
  for (const Field& field : estimate_fields(s)) all[field.key] = json_of(field.value);
  return all;
}

/// All records that maps hold.
uint64_t stored_photons(const RenderStatistics& s) {
  return s.volume_photons + s.surface_photons + s.caustic_photons + s.guiding_photons + s.irradiance_points;
}

Json photons(const RenderStatistics& s) {
  return {{"emitted", s.ledger.emitted_count},
          {"stored_volume", s.volume_photons},
          {"stored_surface", s.surface_photons},
          {"stored_caustic", s.caustic_photons},
          {"stored_to_guide_gathering", s.guiding_photons},
          {"irradiance_points", s.irradiance_points},
          {"merged", s.merged_photons},
          {"collisions", s.ledger.collisions},
          {"surface_hits", s.ledger.surface_hits},
          {"emitted_per_second", per_second(s.ledger.emitted_count, s.trace_seconds)},
          {"emitted_per_second_and_thread", per_second(s.ledger.emitted_count, s.trace_seconds) / thread_count()},
          {"stored_per_second", per_second(stored_photons(s), s.trace_seconds)},
          {"density_lookups", s.ledger.walk.lookups},
          {"bricks_crossed", s.ledger.walk.bricks},
          {"null_collisions", s.ledger.walk.null_collisions},
          {"majorant_violations", s.ledger.walk.majorant_violations},
          {"largest_weight", s.ledger.weights.largest},
          {"effective_sample_size", s.ledger.weights.effective_sample_size()},
          {"below_density_floor", s.ledger.floored},
          {"paths_cut_at_max_events", s.ledger.cut_count},
          {"dropped_non_finite", s.ledger.non_finite}};
}

/// What each light sends into the scene, exactly; `share`: of the power of all, and of the photons.
Json lights(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  Json all = Json::array();
  for (size_t i = 0; i < scene.lights.size(); ++i)
    all.push_back({{"number", i},
                   {"name", loaded.light_names[i]},
                   {"kind", light_kind(scene.lights[i])},
                   {"power_W", rgb(Rgbd(light_power(scene.lights[i], scene.bounds)))},
                   {"share", scene.light_probability[i]}});
  return all;
}

/// Flows of energy per second, each summed where it happens; `imbalance` is their difference from what was emitted, in
/// standard errors.
Json ledger(const Ledger& l) {
  const double n = static_cast<double>(std::max<uint64_t>(1, l.emitted_count));
  const double error = std::sqrt(l.imbalance.variance_of_mean());
  return {{"unit", "W"},
          {"emitted", rgb(l.emitted / n)},
          {"absorbed_in_media", rgb(l.absorbed_in_media / n)},
          {"absorbed_on_surfaces", rgb(l.absorbed_on_surfaces / n)},
          {"escaped", rgb(l.escaped / n)},
          {"cut_at_max_events", rgb(l.cut / n)},
          {"imbalance", l.imbalance.mean()},
          {"imbalance_standard_error", error},
          {"imbalance_in_standard_errors", error > 0.0 ? l.imbalance.mean() / error : 0.0}};
}

Json eye(const RenderStatistics& s) {
  return {{"camera_rays", s.eye.rays},
          {"marching_steps", s.eye.steps},
          {"volume_queries", s.eye.volume_queries},
          {"surface_queries", s.eye.surface_queries},
          {"shadow_rays", s.eye.shadow_rays},
          {"gather_rays", s.eye.gather_rays},
          {"irradiance_lookups", s.eye.irradiance_lookups},
          {"irradiance_misses", s.eye.irradiance_misses},
          {"map_searches", s.eye.gather.searches},
          {"photons_visited", s.eye.gather.visited},
          {"photons_used", s.eye.gather.used},
          {"boundary_corrections", s.eye.gather.corrected},
          {"boundary_least_shares", s.eye.gather.least_shares},
          {"density_lookups", s.eye.walk.lookups},
          {"bricks_crossed", s.eye.walk.bricks},
          {"null_collisions", s.eye.walk.null_collisions},
          {"majorant_violations", s.eye.walk.majorant_violations},
          {"largest_weight", s.eye.weights.largest},
          {"effective_sample_size", s.eye.weights.effective_sample_size()},
          {"paths_cut_at_max_events", s.eye.cut_paths},
          {"dropped_non_finite", s.eye.non_finite},
          {"last_volume_radius_m", s.last_volume_radius},
          {"last_surface_radius_m", s.last_surface_radius}};
}

/// What a light map has in the place of eye paths.
Json points_of_texels(const RenderStatistics& s) {
  return {{"points", s.eye.rays},
          {"surface_queries", s.eye.surface_queries},
          {"shadow_rays", s.eye.shadow_rays},
          {"gather_rays", s.eye.gather_rays},
          {"irradiance_lookups", s.eye.irradiance_lookups},
          {"irradiance_misses", s.eye.irradiance_misses},
          {"map_searches", s.eye.gather.searches},
          {"photons_visited", s.eye.gather.visited},
          {"photons_used", s.eye.gather.used},
          {"boundary_corrections", s.eye.gather.corrected},
          {"boundary_least_shares", s.eye.gather.least_shares},
          {"density_lookups", s.eye.walk.lookups},
          {"paths_cut_at_max_events", s.eye.cut_paths},
          {"dropped_non_finite", s.eye.non_finite},
          {"last_surface_radius_m", s.last_surface_radius}};
}

/// How far the image is estimated to be from the truth.
Json errors(const LoadedScene& loaded, const Film& film) {
  if (film.passes() < kLeastPasses) return nullptr;
  const FilmErrors e = film.errors();
  return {{"quantity", "relative MSE: mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2)"},
          {"estimated", estimated_error(film)},
          {"variance", e.variance_part},
          {"squared_bias", film.shows_bias() ? Json(e.bias_part) : Json()},
          {"bias_not_seen_of", maps_of_unseen_bias(loaded.scene, loaded.settings)}};
}

/// Of the discs of pixels, for the next pass; null where pixels have none.
Json disc_radii(const LoadedScene& loaded, const PixelDiscs& discs) {
  if (discs.empty()) return nullptr;
  const float first = first_radius(loaded.settings.surface, loaded.scene);
  Moments radii;
  float smallest = first, largest = 0.0f;
  for (const PixelDisc& disc : discs) {
    const float radius = disc_radius(disc, first);
    radii.add(radius);
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  return {{"unit", "m"}, {"smallest", smallest}, {"mean", radii.mean()}, {"largest", largest}};
}

Json memory(const Scene& scene, const RenderResult& result) {
  const RenderStatistics& s = result.statistics;
  size_t grids = 0;
  for (const Medium& m : scene.media) grids += m.grid ? m.grid->memory_bytes() : 0;
  size_t textures = 0;
  for (const auto& texture : scene.textures) textures += texture ? texture->memory_bytes() : 0;
  size_t lights = 0;
  for (const Light& light : scene.lights) lights += light_memory_bytes(light);
  const double stored = static_cast<double>(stored_photons(s)) / std::max(1, s.passes);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {{"unit", "bytes"},
          {"grids", grids},
          {"geometry", scene.geometry.memory_bytes()},
          {"textures", textures},
          {"lights", lights},
          {"largest_photon_maps", s.photon_map_bytes},
          {"importance", s.guide_bytes},
          {"radii_of_pixels", result.discs.size() * sizeof(PixelDisc)},
          {"per_stored_photon_of_mean_pass", stored > 0.0 ? static_cast<double>(s.photon_map_bytes) / stored : 0.0},
          {"peak_of_process", static_cast<uint64_t>(usage.ru_maxrss) * 1024}};
}

/// What the report of a render and of a light map have in common.
Json report_of(const std::string& scene_path, const std::string& image, const std::string& quantity,
               const LoadedScene& loaded, const Scattering& shown, const RenderResult& result) {
  const RenderStatistics& s = result.statistics;
  return {{"program", fmt::format("vpm {}", version())},
          {"scene", scene_path},
          {"scene_hash", loaded.hash},
          {"image", image},
          {"quantity", quantity},
          {"width", result.film.width()},
          {"height", result.film.height()},
          {"seed", loaded.settings.seed},
          {"threads", thread_count()},
          {"passes", s.passes},
          {"settings", settings(loaded.settings)},
          {"stages", stage_lines(loaded.scene, loaded.settings, shown)},
          {"notes", loaded.notes},
          {"clamped_density_values", loaded.clamped_density_values},
          {"times", times(result)},
          {"lights", lights(loaded)},
          {"photons", photons(s)},
          {"energy", ledger(s.ledger)},
          {"boundaries",
           {{"crossings", s.ledger.walk.crossings + s.eye.walk.crossings},
            {"met_in_another_medium", s.ledger.walk.medium_mismatches + s.eye.walk.medium_mismatches}}},
          {"memory", memory(loaded.scene, result)}};
}

}  // namespace

std::string render_report(const std::string& scene_path, const std::string& image, const LoadedScene& loaded,
                          const RenderResult& result) {
  Json report = report_of(scene_path, image, "radiance, W/(m^2 sr)", loaded, scattering_of(loaded.scene), result);
  report["error"] = errors(loaded, result.film);
  report["eye"] = eye(result.statistics);
  report["radii_of_pixels"] = disc_radii(loaded, result.discs);
  return report.dump(2) + "\n";
}

std::string light_map_report(const std::string& scene_path, const std::string& image, const std::string& mesh,
                             const LoadedScene& loaded, const UvLayout& layout, const RenderResult& result) {
  Json report = report_of(scene_path, image, "irradiance, W/m^2", loaded, {.surfaces = true}, result);
  report["texels"] = points_of_texels(result.statistics);
  report["light_map"] = {{"mesh", mesh},
                         {"covered_texels", layout.covered_texels()},
                         {"area_m2", std::accumulate(layout.areas.begin(), layout.areas.end(), 0.0)},
                         {"area_of_mesh_m2", loaded.scene.geometry.area(layout.shape)},
                         {"triangles_without_texels", layout.flat_triangles},
                         {"power_received_W", rgb(received_power(layout, result.film.mean()))}};
  return report.dump(2) + "\n";
}

}  // namespace vpm::tools
