// The tables about how to render: [camera] and [film]; [render] and [integrator], which the descriptions of settings
// read.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <set>

#include "vpm/input/sections.h"
#include "vpm/input/toml/old_keys.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

constexpr const char* kIntegratorKey = "integrator.type";
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

/// The tables of settings, each read from the file when it is first asked for.
class SettingTables {
 public:
  explicit SettingTables(TableReader& root) : root_(root) {}

  /// "integrator.volume"; null where the file has none.
  TableReader* find(const std::string& path) {
    const auto [found, first] = tables_.try_emplace(path);
    if (first) {
      const size_t dot = path.rfind('.');
      TableReader* const outer = dot == std::string::npos ? &root_ : find(path.substr(0, dot));
      if (outer) tables_[path] = outer->table(path.substr(dot + 1), "[" + path + "]");
    }
    std::optional<TableReader>& table = tables_[path];
    return table ? &*table : nullptr;
  }

  /// Refuses keys that nobody asked for, but for those that options have replaced: appends these to `left_out`.
  void finish(const Document& document, const std::string& integrator, std::vector<std::string>& left_out) const {
    for (const auto& [path, table] : tables_) {
      if (!table) continue;
      for (const Entry* entry : table->unknown()) {
        const std::string key = path + "." + entry->key;
        if (!is_replaced(document, key, *entry)) table->refuse_unknown(*entry, elsewhere(path, entry->key, integrator));
        add_keys(*entry, key, left_out);
      }
    }
  }

  /// Points at the key, or at the table around it that there is.
  [[noreturn]] void fail(const SettingError& error) {
    std::string path = error.key();
    size_t dot = path.rfind('.');
    std::string name = path.substr(dot + 1);
    for (path.resize(dot); !find(path); path.resize(dot)) {
      dot = path.rfind('.');
      if (dot == std::string::npos) root_.fail_here(error.key() + ": " + error.wrong(), error.right());
      name = path.substr(dot + 1);
    }
    find(path)->fail(name, error.wrong(), error.right());
  }

 private:
  /// Does an option that comes after the entry, and after all in it, name another component for its table?
  static bool is_replaced(const Document& document, const std::string& key, const Entry& entry) {
    if (const Node::Table* const inner = entry.node.table())
      return std::all_of(inner->begin(), inner->end(),
                         [&](const Entry& each) { return is_replaced(document, key + "." + each.key, each); });
    const auto number_of = [&](const Source* source) {
      return std::find_if(document.sources.begin(), document.sources.end(),
                          [&](const auto& each) { return each.get() == source; });
    };
    return std::any_of(document.replaced.begin(), document.replaced.end(), [&](const Replacement& by) {
      return key.starts_with(by.table + ".") && number_of(entry.node.place.source) < number_of(by.option);
    });
  }

  static void add_keys(const Entry& entry, const std::string& key, std::vector<std::string>& keys) {
    const Node::Table* const inner = entry.node.table();
    if (!inner) return keys.push_back(key);
    for (const Entry& each : *inner) add_keys(each, key + "." + each.key, keys);
  }

  /// Where a key that these components do not have is one: "there is 'count' with type = "nearest"; ". Of a table that
  /// of its first key.
  static std::string elsewhere(const std::string& path, const std::string& key, const std::string& integrator) {
    std::string here, tables;
    for (const SettingOfSome& each : every_setting()) {
      const Setting& setting = each.setting;
      const bool in_table = (setting.table() + ".").starts_with(path + "." + key + ".");
      if (setting.key == path + "." + key || (in_table && here.empty()))
        here += (here.empty() ? "" : "; or ") + condition(each, integrator);
      const std::string title = "[" + setting.table() + "]";
      if (setting.name() == key && tables.find(title) == std::string::npos)
        tables += (tables.empty() ? "" : ", ") + title;
    }
    if (!here.empty()) return fmt::format("there is '{}' with {}; ", key, here);
    return tables.empty() ? "" : fmt::format("there is '{}' in {}; ", key, tables);
  }

  /// Without what holds already: the integrator that is chosen.
  static std::string condition(const SettingOfSome& each, const std::string& integrator) {
    const auto& all = each.integrators;
    std::string text;
    if (!all.empty() && std::find(all.begin(), all.end(), integrator) == all.end())
      text = fmt::format("type = \"{}\" of [integrator]{}", fmt::join(all, "\", \""), each.with.empty() ? "" : "; ");
    text += each.with;
    std::erase(text, '`');
    return text;
  }

  TableReader& root_;
  std::map<std::string, std::optional<TableReader>> tables_;
};

/// "integrator.type is "path" in place of "photon-map": left out are integrator.photons.emitted, ...".
std::string text_of_replaced(const Document& document, const std::vector<std::string>& keys) {
  std::vector<std::string> changes;
  for (const Replacement& by : document.replaced)
    changes.push_back(fmt::format("{}.type is \"{}\" in place of \"{}\"", by.table, by.after, by.before));
  return fmt::format("{}: left out are {}", fmt::join(changes, ", "), fmt::join(keys, ", "));
}

/// What a render has that says nothing of a setting.
void leave_out(const Setting& setting, LeftOut left_out, AutomaticSettings& automatic) {
  setting.set(setting.usual);
  if (left_out == LeftOut::automatic && setting.automatic && !setting.stays) automatic.keys.insert(setting.key);
  if (setting.usually_chosen && !automatic.keys.contains(setting.key)) automatic.left_out.insert(setting.key);
}

/// An integrator that is to be chosen is chosen with all that it may choose.
void choose_all(RenderSettings& s, AutomaticSettings& automatic) {
  for (const Setting& setting : describe(s))
    if (setting.automatic && !setting.stays) automatic.keys.insert(setting.key);
}

/// Reads the first setting that is given and has not been read yet; what is missing before it has its default. False
/// where there is none: then all are read.
bool read_next(SettingTables& tables, LeftOut left_out, std::set<std::string>& read, RenderSettings& s,
               AutomaticSettings& automatic) {
  for (const Setting& setting : describe(s)) {
    if (!read.insert(setting.key).second) continue;
    TableReader* const table = tables.find(setting.table());
    if (!table || !table->has(setting.name())) {
      leave_out(setting, left_out, automatic);
      continue;
    }
    if (const std::optional<SettingValue> value = read_value(*table, setting))
      setting.set(*value);
    else
      automatic.keys.insert(setting.key);
    return true;
  }
  return false;
}

/// The pilot that chooses how many photons a pass has knows passes in one piece: a number for blocks, which are taken
/// where memory ends, is the user's.
void refuse_blocks_of_chosen_photons(const RenderSettings& s, const AutomaticSettings& automatic) {
  if (s.integrator == Integrator::photon && s.photons_block > 0 && automatic.has("integrator.photons.emitted"))
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
  std::set<std::string> read;
  while (read_next(tables, left_out, read, s, job.automatic))
    if (job.automatic.keys.contains(kIntegratorKey)) {
      choose_all(s, job.automatic);
      break;
    }
  std::vector<std::string> dropped;
  const bool chosen = job.automatic.keys.contains(kIntegratorKey);
  tables.finish(document, chosen ? kAuto : word_of(s.integrator), dropped);
  if (!dropped.empty()) job.notes.push_back(text_of_replaced(document, dropped));
  try {
    validate(s, facts);
    refuse_blocks_of_chosen_photons(s, job.automatic);
  } catch (const SettingError& error) {
    tables.fail(error);
  }
  return s;
}

}  // namespace vpm
