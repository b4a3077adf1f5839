// The tables about how to render: [camera] and [film]; [render] and [integrator], which the descriptions of settings
// read.
#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "vpm/input/replaced_keys.h"
#include "vpm/input/sections.h"
#include "vpm/input/setting_tables.h"
#include "vpm/input/toml/old_keys.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

constexpr const char* kIntegratorKey = "integrator.type";

int small_integer(TableReader& table, const std::string& key, uint64_t hi, int fallback) {
  return static_cast<int>(table.integer(key, 1, hi, static_cast<uint64_t>(fallback)));
}

/// [x0, y0, x1, y1], ends excluded.
std::optional<PixelRect> read_crop(TableReader& film, int width, int height) {
  if (!film.has("crop")) return std::nullopt;
  const std::vector<double> ends = film.numbers("crop", 4);
  const auto whole = [](double end) { return std::floor(end) == end && std::abs(end) <= double{kLargestFilm}; };
  const auto at = [&](size_t i) { return static_cast<int>(ends[i]); };
  if (std::all_of(ends.begin(), ends.end(), whole)) {
    const PixelRect crop{at(0), at(1), at(2), at(3)};
    if (lies_in(crop, width, height)) return crop;
  }
  film.fail("crop", fmt::format("[film] crop is no part of the {} x {} pixels", width, height),
            "four whole numbers: [x0, y0, x1, y1] from the upper left corner, without column x1 and row y1");
}

Filter read_filter(TableReader& film) {
  Filter filter;
  filter.kind = film.choice<FilterKind>(
      "filter", {{"box", FilterKind::box}, {"tent", FilterKind::tent}, {"gaussian", FilterKind::gaussian}},
      FilterKind::box);
  const float default_radius = filter.kind == FilterKind::box ? 0.5f : filter.kind == FilterKind::tent ? 1.0f : 1.5f;
  filter.radius = film.number("filter_radius", {0.0, 32.0, true, false}, default_radius);
  return filter;
}

/// What a render has that says nothing of a setting.
void leave_out(const Setting& setting, LeftOut left_out, AutomaticSettings& automatic) {
  setting.set(setting.default_value);
  if (left_out != LeftOut::defaults && setting.automatic && !setting.keeps_default) automatic.keys.insert(setting.key);
  if (setting.default_chosen && !automatic.keys.contains(setting.key)) automatic.default_radii.insert(setting.key);
}

/// An integrator that is to be chosen is chosen with all that it may choose.
void choose_all(RenderSettings& s, AutomaticSettings& automatic) {
  for (const Setting& setting : describe(s)) {
    if (setting.table().starts_with("integrator")) setting.set(setting.default_value);
    if (setting.automatic && !setting.keeps_default) automatic.keys.insert(setting.key);
  }
}

/// Does an option leave out what the file says, as it is no word of this setting any more?
bool leaves_out(TableReader& table, const Setting& setting, ReplacedKeys& replaced) {
  const Node& node = table.require(setting.name());
  const auto* const words = std::get_if<Words>(&setting.domain);
  const auto* const word = std::get_if<std::string>(&node.value);
  if (!words || !word || (setting.automatic && *word == kAuto)) return false;
  const bool is_word = std::find(words->words.begin(), words->words.end(), *word) != words->words.end();
  return !is_word && replaced.leave_out_value(setting.key, node);
}

/// Reads the first setting that is given and has not been read yet; what is missing before it has its default. False
/// where there is none: then all are read.
bool read_next(SettingTables& tables, ReplacedKeys& replaced, LeftOut left_out, std::set<std::string>& read,
               RenderSettings& s, AutomaticSettings& automatic) {
  for (const Setting& setting : describe(s)) {
    if (!read.insert(setting.key).second) continue;
    TableReader* const table = tables.find(setting.table());
    if (!table || !table->has(setting.name()) || leaves_out(*table, setting, replaced)) {
      leave_out(setting, left_out, automatic);
      continue;
    }
    const std::optional<SettingValue> value = read_value(*table, setting);
    setting.set(value.value_or(setting.default_value));
    if (!value) automatic.keys.insert(setting.key);
    return true;
  }
  return false;
}

/// The pilot that chooses how many photons a pass has knows passes in one piece: a number for blocks, which are taken
/// where memory ends, is the user's.
void refuse_blocks_of_chosen_photons(const RenderSettings& s, const AutomaticSettings& automatic) {
  if (s.integrator == Integrator::photon && s.photons.block > 0 && automatic.has("integrator.photons.emitted"))
    throw SettingError("integrator.photons.block",
                       "a pass whose number of photons is to be chosen is not made in blocks",
                       "give 'emitted' a number, or leave out 'block'");
}

}  // namespace

Camera read_camera(TableReader& camera, std::optional<TableReader>& film) {
  const Vec3 position = camera.vector("position");
  const Vec3 target = camera.vector("target");
  const Vec3 up = camera.direction("up", Vec3(0.0f, 1.0f, 0.0f));
  const float fov = camera.number("fov", {0.0, 180.0, true, true}, 40.0f);
  const Vec3d forward = Vec3d(target) - Vec3d(position);
  if (glm::length(forward) == 0.0) camera.fail("target", "the camera's target is its position");
  if (!(glm::length(glm::cross(glm::normalize(forward), Vec3d(up))) > 1e-6))
    camera.fail(camera.has("up") ? "up" : "target", "the camera looks along its 'up' vector",
                "give it an 'up' that points elsewhere");
  int width = 512, height = 512;
  Filter filter;
  std::optional<PixelRect> crop;
  if (film) {
    width = small_integer(*film, "width", kLargestFilm, width);
    height = small_integer(*film, "height", kLargestFilm, height);
    filter = read_filter(*film);
    crop = read_crop(*film, width, height);
    film->finish();
  }
  return make_camera(position, target, up, fov, {width, height, filter, crop});
}

RenderSettings read_settings(TableReader& root, const Document& document, const SceneFacts& facts, LeftOut left_out,
                             RenderJob& job) {
  refuse_old_keys(root);
  RenderSettings s;
  SettingTables tables(root);
  ReplacedKeys replaced(document);
  std::set<std::string> read;
  while (read_next(tables, replaced, left_out, read, s, job.automatic))
    if (job.automatic.keys.contains(kIntegratorKey)) {
      choose_all(s, job.automatic);
      break;
    }
  const bool chosen = job.automatic.keys.contains(kIntegratorKey);
  tables.finish(chosen ? kAuto : word_of(s.integrator), replaced);
  job.replaced = replaced.note();
  if (!job.replaced.empty()) job.notes.push_back(job.replaced);
  try {
    validate(s, facts);
    refuse_blocks_of_chosen_photons(s, job.automatic);
  } catch (const SettingError& error) {
    tables.fail(error);
  }
  return s;
}

}  // namespace vpm
