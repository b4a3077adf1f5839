// The report of a render.
#include "vpm/job/report.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <nlohmann/json.hpp>
#include <numeric>

#include "vpm/base/parallel.h"
#include "vpm/base/version.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/photon_map/photon_blocks.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/found_by_techniques.h"
#include "vpm/job/messages.h"

namespace vpm {
namespace {

using Json = nlohmann::ordered_json;

Json rgb(const Rgbd& c) { return Json::array({c.r, c.g, c.b}); }

double per_second(uint64_t count, double seconds) { return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0; }

/// How counts stand in reports.
void put(Json& section, const std::string& key, const auto& number, double) { section[key] = number; }
void put(Json& section, const std::string&, const WeightMoments& weights, double) {
  section["largest_weight"] = weights.largest;
  section["effective_sample_size"] = weights.effective_sample_size();
}
/// Flows of energy of so many photons, W.
void put(Json& section, const std::string& key, const Rgbd& flow, double emitted) {
  section[key] = rgb(flow / emitted);
}

/// Kept for energy().
void put(Json&, const std::string&, const ChannelMoments&, double) {}

/// All counts, in the sections that their keys name.
Json counted(const RenderStatistics& s) {
  const double emitted = static_cast<double>(std::max<uint64_t>(1, s.ledger.emitted_count));
  Json sections;
  for_each_counter(s, [&](const std::string& key, const auto& number) {
    const size_t dot = key.find('.');
    if (dot == std::string::npos)
      put(sections, key, number, emitted);
    else
      put(sections[key.substr(0, dot)], key.substr(dot + 1), number, emitted);
  });
  return sections;
}

/// A section that begins with these entries.
Json section(Json begin, const Json& rest) {
  begin.update(rest);
  return begin;
}

/// The energy ledger of photons; null where none were traced. Parts of no emitted power are null, too.
Json energy(const Ledger& ledger, const Json& flows) {
  if (ledger.emitted_count == 0) return nullptr;
  const Rgbd emitted = ledger.emitted / static_cast<double>(ledger.emitted_count);
  return section({{"unit", "W"}},
                 section(flows, {{"imbalance",
                                  {{"quantity", "(absorbed + escaped + cut - emitted) / emitted, of each channel"},
                                   {"value", rgb(ledger.imbalance.mean() / emitted)},
                                   {"standard_error", rgb(ledger.imbalance.standard_error() / emitted)}}}}));
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

/// What the render chose, as --set takes it, and why.
Json chosen(const RenderJob& job) {
  Json all = Json::array();
  for (const Choice& choice : job.choices)
    all.push_back({{"key", choice.key}, {"value", choice.value}, {"reason", choice.reason}});
  return all;
}

uint64_t stored_photons(const RenderStatistics& s) {
  return s.volume_photons + s.surface_photons + s.caustic_photons + s.guiding_photons + s.irradiance_points;
}

/// All that maps hold.
uint64_t stored_records(const RenderStatistics& s) { return stored_photons(s) + s.beams + s.planes; }

/// How fast photons are, which may be traced more than once.
Json rates(const RenderStatistics& s, int tracings) {
  const double trace_seconds = s.trace_seconds / tracings;
  const double emitted = per_second(s.ledger.emitted_count, trace_seconds);
  return {{"emitted_per_second", emitted},
          {"emitted_per_second_and_thread", emitted / thread_count()},
          {"stored_per_second", per_second(stored_photons(s), trace_seconds + s.caustic_seconds)}};
}

/// What each light sends into the scene: exactly, but for media that emit. `share`: of the power of all, and of the
/// photons.
Json lights(const RenderJob& job) {
  const Scene& scene = job.scene;
  Json all = Json::array();
  for (size_t i = 0; i < scene.lights.size(); ++i)
    all.push_back({{"number", i},
                   {"name", i < job.light_names.size() ? job.light_names[i] : ""},
                   {"kind", light_kind(scene.lights[i])},
                   {"power_W", rgb(Rgbd(light_power(scene.lights[i], entrance_of(scene, scene.lights[i]))))},
                   {"share", scene.light_probability[i]}});
  return all;
}

/// What a light map has in the place of eye paths.
Json texels(Json eye) {
  Json texels{{"points", eye["camera_rays"]}};
  eye.erase("camera_rays");
  return section(std::move(texels), eye);
}

Json json_of(const Estimated& estimated) {
  return {{"value", estimated.value}, {"standard_error", estimated.standard_error}};
}

/// How far the image is estimated to be from the truth.
Json errors(const RenderJob& job, const RenderResult& result) {
  const std::optional<StatedError> stated = stated_error_of(result);
  if (!stated) return nullptr;
  Json all = json_of(stated->total);
  all["quantity"] = "relative MSE: mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2)";
  all["below_with_confidence_of_80_percent"] = stated->highest;
  all["variance"] = json_of(stated->variance);
  if (gathers(job.scene, job.settings)) {
    all["squared_bias"] = json_of(stated->squared_bias);
    all["squared_bias"]["seen"] = stated->bias_seen;
    all["squared_bias"]["below_with_confidence_of_80_percent"] = stated->highest_squared_bias;
  }
  all["bias_not_seen_of"] = maps_of_unseen_bias(job.scene, job.settings);
  return all;
}

/// What each technique finds; null where layers are not kept. What is no number is null, too.
Json techniques(const RenderJob& job, const RenderResult& result) {
  Json all;
  for (const FoundByTechnique& found : found_by_techniques(job.settings, result)) {
    Json technique{{"name", found.name}};
    for_each_counter(found, [&](const std::string& key, double number) { technique[key] = number; });
    all.push_back(std::move(technique));
  }
  return all;
}

/// The numbers of the passes: the first of each range, and that after its last.
Json pass_ranges(const Film& film) {
  Json all = Json::array();
  for (const PassRange& range : film.sums().passes.ranges()) all.push_back({range.first, range.end});
  return all;
}

/// Of the discs of pixels, for the next pass; null where pixels have none.
Json disc_radii(const RenderJob& job, const PixelDiscs& discs) {
  if (discs.empty()) return nullptr;
  const float first = first_radius(job.settings.surface, job.scene);
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

Json memory(const RenderJob& job, const RenderResult& result) {
  const Scene& scene = job.scene;
  const RenderStatistics& s = result.statistics;
  size_t grids = 0;
  for (const Medium& m : scene.media) grids += m.memory_bytes();
  size_t textures = 0;
  for (const auto& texture : scene.textures) textures += texture ? texture->memory_bytes() : 0;
  size_t lights = 0;
  for (const Light& light : scene.lights) lights += light_memory_bytes(light);
  const double maps = static_cast<double>(std::max<int64_t>(1, s.passes)) *
                      static_cast<double>(block_count(job.settings));  // one at a time
  const double stored = static_cast<double>(stored_records(s)) / maps;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {{"unit", "bytes"},
          {"grids", grids},
          {"geometry", scene.geometry.memory_bytes()},
          {"textures", textures},
          {"lights", lights},
          {"radii_of_pixels", result.discs.size() * sizeof(PixelDisc)},
          {"per_stored_record_of_mean_pass", stored > 0.0 ? static_cast<double>(s.photon_map_bytes) / stored : 0.0},
          {"peak_of_process", static_cast<uint64_t>(usage.ru_maxrss) * 1024}};
}

/// Names of files may hold bytes that are no UTF-8, as JSON must be.
std::string whole(const Json& report) { return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// What the report of a render and of a light map have in common.
Json report_of(const RenderJob& job, const std::string& image, const std::string& quantity, const SceneFacts& shown,
               const RenderResult& result) {
  const RenderStatistics& s = result.statistics;
  const Json counts = counted(s);
  WalkCounters walk = s.ledger.walk;
  walk.merge(s.eye.walk);
  return {{"program", fmt::format("vpm {}", version())},
          {"scene", job.source},
          {"scene_hash", job.hash},
          {"image", image},
          {"quantity", quantity},
          {"width", result.film.width()},
          {"height", result.film.height()},
          {"seed", job.settings.seed},
          {"threads", thread_count()},
          {"passes", s.passes},
          {"settings", settings(job.settings)},
          {"stages", stage_lines(job.scene, job.settings, shown)},
          {"overrides", job.overrides},
          {"chosen", chosen(job)},
          {"notes", job.notes},
          {"clamped_density_values", job.clamped_density_values},
          {"times", section({{"unit", "s, wall clock"}, {"total", result.seconds}}, counts["times"])},
          {"lights", lights(job)},
          {"photons", section(counts["photons"], rates(s, tracings_of_pass(job.scene, job.settings)))},
          {"energy", energy(s.ledger, counts["energy"])},
          {"boundaries", {{"crossings", walk.crossings}, {"met_in_another_medium", walk.medium_mismatches}}},
          {"memory", section(memory(job, result), counts["memory"])}};
}

}  // namespace

std::string render_report(const RenderJob& job, const std::string& image, const RenderResult& result) {
  Json report = report_of(job, image, "radiance, W/(m^2 sr)", facts_of(job.scene), result);
  const Camera& camera = job.scene.camera;
  report["width"] = camera.width;
  report["height"] = camera.height;
  const auto& [x0, y0, x1, y1] = camera.rendered();
  report["rendered_pixels"] = {{"x0", x0}, {"y0", y0}, {"x1", x1}, {"y1", y1}};
  report["warnings"] = warnings_of(job, result);
  report["pass_ranges"] = pass_ranges(result.film);
  report["error"] = errors(job, result);
  report["techniques"] = techniques(job, result);
  report["eye"] = counted(result.statistics)["eye"];
  report["radii_of_pixels"] = disc_radii(job, result.discs);
  return whole(report);
}

std::string light_map_report(const RenderJob& job, const std::string& image, const std::string& mesh,
                             const UvLayout& layout, const LightMap& baked) {
  const RenderResult& result = baked.render;
  Json report = report_of(job, image, "irradiance, W/m^2", {.rough_surfaces = true}, result);
  report["warnings"] = warnings_of_light_map(job, result);
  report["texels"] = texels(counted(result.statistics)["eye"]);
  report["light_map"] = {{"mesh", mesh},
                         {"covered_texels", layout.covered_texels()},
                         {"area_m2", std::accumulate(layout.areas.begin(), layout.areas.end(), 0.0)},
                         {"area_of_mesh_m2", job.scene.geometry.area(layout.shape)},
                         {"triangles_without_texels", layout.flat_triangles},
                         {"power_received_W",
                          {{"value", rgb(baked.power.mean())}, {"standard_error", rgb(baked.power.standard_error())}}}};
  return whole(report);
}

}  // namespace vpm
