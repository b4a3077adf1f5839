// The sections about how to render: [camera] and [film], and those of the settings, which their declarations read.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>

#include "vpm/input/sections.h"
#include "vpm/job/setting.h"

namespace vpm {
namespace {

constexpr uint64_t kLargestOfToml = std::numeric_limits<int64_t>::max();

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
  const float usual = filter.kind == FilterKind::box ? 0.5f : filter.kind == FilterKind::tent ? 1.0f : 1.5f;
  filter.radius = film.number("filter_radius", {0.0, 32.0, true, false}, usual);
  return filter;
}

Words with_auto(Words words) {
  words.words.emplace_back(kAuto);
  return words;
}

/// An array of words, in the order of the set.
std::string read_word_set(TableReader& table, const std::string& key, const WordSet& set) {
  const std::vector<std::string> given = table.words(key, set.words);
  std::string joined;
  for (const std::string& word : set.words)
    if (std::find(given.begin(), given.end(), word) != given.end()) joined += (joined.empty() ? "" : "+") + word;
  return joined;
}

/// The value of a key that the table has, checked against the setting's domain; nothing where it is kAuto.
std::optional<SettingValue> read_value(TableReader& table, const Setting& setting) {
  const std::string key = setting.name();
  if (const auto* words = std::get_if<Words>(&setting.domain)) {
    std::vector<std::pair<std::string, std::string>> allowed;
    for (const std::string& word : (setting.automatic ? with_auto(*words) : *words).words)
      allowed.emplace_back(word, word);
    const std::string word = table.choice<std::string>(key, allowed);
    return setting.automatic && word == kAuto ? std::nullopt : std::optional<SettingValue>(word);
  }
  if (const auto* set = std::get_if<WordSet>(&setting.domain)) {
    if (setting.automatic && table.says(key, std::string(kAuto))) return std::nullopt;
    return read_word_set(table, key, *set);
  }
  if (setting.automatic && table.says_auto(key)) return std::nullopt;
  if (const auto* integers = std::get_if<Integers>(&setting.domain))
    return table.integer(key, integers->lo, std::min(integers->hi, kLargestOfToml));
  if (const auto* numbers = std::get_if<Numbers>(&setting.domain)) return table.number(key, numbers->range);
  return table.flag(key, false);
}

/// Refuses keys that the setting stands for.
void refuse_in_place_of(TableReader& table, const Setting& setting) {
  for (const std::string_view key : setting.stands_for) {
    const std::string name(key.substr(key.find('.') + 1));
    if (table.has(name))
      table.fail(name, "'" + setting.name() + "' of " + table.title() + " stands for '" + name + "'",
                 "leave out '" + name + "', or '" + setting.name() + "'");
  }
}

/// Does another declaration of the key serve, whose need is met?
bool another_serves(const Setting& setting, const RenderSettings& s) {
  return !setting.needed(s) && find_setting(setting.key, s);
}

/// Refuses what is for one gather in media alone, where the gather is to be chosen.
void refuse_beside_chosen_gather(const TableReader& table, const std::string& key, const AutomaticSettings& automatic) {
  constexpr std::array kOfOneGather{"photons.flights", "photons.planes", "volume.count", "volume.beams",
                                    "volume.planes"};
  if (!automatic.has("volume.gather") || std::find(kOfOneGather.begin(), kOfOneGather.end(), key) == kOfOneGather.end())
    return;
  const std::string name = key.substr(key.find('.') + 1);
  table.fail(name, "what is gathered in media is to be chosen: 'gather' of [volume] is \"auto\"",
             "leave out '" + name + "', or write the gather that it is for");
}

void read_setting(TableReader& table, const Setting& setting, RenderSettings& s, AutomaticSettings& automatic) {
  if (another_serves(setting, s)) return;
  if (setting.section() == "combined" && automatic.has("render.integrator"))
    table.fail(setting.name(), "whether techniques are combined is to be chosen: 'integrator' of [render] is \"auto\"",
               "leave out [combined], or write integrator = \"combined\" in [render]");
  if (!setting.needed(s)) {
    refuse_beside_chosen_gather(table, setting.key, automatic);
    table.fail(setting.name(), setting.need.wrong(s), std::string(setting.need.right));
  }
  refuse_in_place_of(table, setting);
  if (const std::optional<SettingValue> value = read_value(table, setting))
    setting.member.set(s, *value);
  else
    automatic.keys.insert(setting.key);
}

using Sections = std::map<std::string, std::optional<TableReader>>;

/// The section of a setting, read from the file when it is first asked for.
std::optional<TableReader>& section_of(const Setting& setting, TableReader& root, Sections& sections) {
  const std::string name = setting.section();
  const auto [found, first] = sections.try_emplace(name);
  if (first) found->second = root.table(name, "[" + name + "]");
  return found->second;
}

/// "there is 'radius' in [volume], [surface]; " of a setting of other sections.
std::string elsewhere(const std::string& key) {
  std::string sections;
  for (const Setting& setting : all_settings()) {
    const std::string title = "[" + setting.section() + "]";
    if (setting.name() == key && sections.find(title) == std::string::npos)
      sections += (sections.empty() ? "" : ", ") + title;
  }
  return sections.empty() ? "" : "there is '" + key + "' in " + sections + "; ";
}

/// The pilot that chooses how many photons a pass has knows passes in one piece: a number for blocks, which are taken
/// where memory ends, is the user's.
void refuse_blocks_of_chosen_photons(const RenderSettings& s, const AutomaticSettings& automatic) {
  if (s.photons_block > 0 && automatic.has("photons.emitted"))
    throw SettingError("photons.block", "a pass whose number of photons is to be chosen is not made in blocks",
                       "give 'emitted' a number, or leave out 'block'");
}

/// What is decided by others where the file says nothing of it.
void decide(const Setting& setting, RenderSettings& s, AutomaticSettings& automatic) {
  const DecidedBy& rule = setting.decided_by;
  if (rule.value) setting.member.set(s, rule.value(s));
  if (automatic.has(rule.chosen_with)) automatic.keys.insert(setting.key);
  if (setting.usually_chosen) automatic.left_out.insert(setting.key);
}

/// Tells the place of the key, or of the one that is given in its place.
[[noreturn]] void fail_with(const SettingError& error, const TableReader& root, Sections& sections,
                            const AutomaticSettings& automatic) {
  const size_t dot = error.key().find('.');
  std::optional<TableReader>& section = sections[error.key().substr(0, dot)];
  if (!section) root.fail_here(error.key() + ": " + error.wrong(), error.right());
  refuse_beside_chosen_gather(*section, error.key(), automatic);
  std::string name = error.key().substr(dot + 1);
  for (const Setting& setting : all_settings())
    for (const std::string_view key : setting.stands_for)
      if (key == error.key() && !section->has(name)) name = setting.name();
  section->fail(name, error.wrong(), error.right());
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

RenderSettings read_settings(TableReader& root, const SceneFacts& facts, AutomaticSettings& automatic) {
  RenderSettings s;
  Sections sections;
  for (const Setting& setting : all_settings()) {
    std::optional<TableReader>& table = section_of(setting, root, sections);
    if (table && table->has(setting.name()))
      read_setting(*table, setting, s, automatic);
    else
      decide(setting, s, automatic);
  }
  for (const auto& [name, table] : sections)
    if (table) table->finish(elsewhere);
  try {
    validate(s, facts);
    refuse_blocks_of_chosen_photons(s, automatic);
  } catch (const SettingError& error) {
    fail_with(error, root, sections, automatic);
  }
  return s;
}

}  // namespace vpm
