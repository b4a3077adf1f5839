// A file is taken apart into statements, each with the comments above it. In experiments a statement gets its new key
// where it stands; in scenes it moves to a table of the integrator, and these follow where the first old table was.
#include "vpm/input/toml/upgrade.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "vpm/base/error.h"
#include "vpm/base/lines.h"
#include "vpm/input/node.h"
#include "vpm/input/toml/old_keys.h"
#include "vpm/integrators/describe.h"

namespace vpm {
namespace {

// The order in which tables are written.
constexpr std::array kTables{"integrator",
                             "integrator.photons",
                             "integrator.importance",
                             "integrator.distance",
                             "integrator.transmittance",
                             "integrator.volume",
                             "integrator.single_scattering",
                             "integrator.surface",
                             "integrator.direct",
                             "integrator.indirect",
                             "integrator.caustics"};

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

std::vector<std::string> lines_of_text(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

/// A piece of a file: a header, a statement, an empty line or the end, with the comments above it.
struct Piece {
  enum class Kind { header, statement, empty, end } kind = Kind::empty;
  std::vector<std::string> comments;
  std::string text;   // all lines, without the last line feed
  std::string table;  // the header's, or the one that a statement stands in
  std::string key;    // of a statement, as it is written
};

bool is_toml(const std::string& name, const std::string& text) {
  try {
    parse_toml(name, text);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// "volume" of "[volume]  # a comment".
std::string table_of_header(const std::string& line) {
  const size_t begin = line.find_first_not_of("[ \t"), end = line.find(']');
  return trimmed(line.substr(begin, end - begin));
}

std::vector<Piece> pieces_of(const std::string& name, const std::vector<std::string>& lines) {
  std::vector<Piece> pieces;
  std::vector<std::string> comments;
  std::string table;
  for (size_t i = 0; i < lines.size(); ++i) {
    const std::string line = trimmed(lines[i]);
    if (line.starts_with('#')) {
      comments.push_back(lines[i]);
      continue;
    }
    Piece piece{.kind = Piece::Kind::empty, .comments = std::exchange(comments, {}), .text = lines[i]};
    if (line.starts_with('[')) {
      piece.kind = Piece::Kind::header;
      table = table_of_header(line);
    } else if (!line.empty()) {
      piece.kind = Piece::Kind::statement;
      piece.key = trimmed(line.substr(0, line.find('=')));
      while (i + 1 < lines.size() && !is_toml(name, piece.text)) piece.text += "\n" + lines[++i];
    }
    piece.table = table;
    pieces.push_back(std::move(piece));
  }
  pieces.push_back({.kind = Piece::Kind::end, .comments = std::move(comments)});
  return pieces;
}

/// Where the settings of an experiment begin in a path: behind "set." or "product."; npos in scenes.
size_t after_set(const std::string& path) {
  for (const std::string word : {"set.", "product."})
    if (const size_t at = ("." + path).find("." + word); at != std::string::npos) return at + word.size();
  return std::string::npos;
}

std::string join(const std::string& table, const std::string& key) { return table.empty() ? key : table + "." + key; }

const OldKey* find_old(const std::string& key) {
  const auto all = old_keys();
  const auto found = std::find_if(all.begin(), all.end(), [&](const OldKey& old) { return old.old_key == key; });
  return found == all.end() ? nullptr : &*found;
}

/// A statement with another key, and another value for some words.
std::string with_key(const std::string& statement, const std::string& key, const std::string& new_key) {
  std::string text = statement;
  text.replace(text.find(key), key.size(), new_key);
  if (new_key == "type" || new_key.ends_with("integrator.type"))
    for (const char quote : {'"', '\''})
      if (const std::string photon = fmt::format("{}photon{}", quote, quote); text.find(photon) != std::string::npos)
        text.replace(text.find(photon), photon.size(), fmt::format("{}photon-map{}", quote, quote));
  return text;
}

/// The statements in the place of one of `surface.method`, which stood for two.
std::vector<std::pair<std::string, std::string>> of_method(const std::string& statement) {
  const auto says = [&](const char* word) { return statement.find(word) != std::string::npos; };
  return {{"integrator.direct.type", says("visualise") ? "\"photons\"" : "\"shadow-rays\""},
          {"integrator.indirect.type", says("final-gather") ? "\"final-gather\"" : "\"photons\""}};
}

/// A statement on its way to a new table.
struct Moved {
  std::string key;  // "integrator.volume.radius"
  std::vector<std::string> comments;
  std::string text;
};

/// New keys and texts of a statement of an old key, with the new key written as `written` makes it of the whole.
template <class Written>
std::vector<Moved> moved(const Piece& piece, const OldKey& old, bool combines, Written&& written) {
  std::vector<Moved> all;
  if (old.old_key == "surface.method") {
    for (const auto& [key, value] : of_method(piece.text))
      all.push_back({key, all.empty() ? piece.comments : std::vector<std::string>(), written(key) + " = " + value});
    return all;
  }
  const std::string key = combines && old.old_key == "photons.planes" ? "integrator.planes" : std::string(old.key);
  return {{key, piece.comments, with_key(piece.text, piece.key, written(key))}};
}

/// Replaces old keys within an inline table, as `set = { render.integrator = "path" }` has them.
std::string with_inline_keys(std::string text) {
  for (const OldKey& old : old_keys())
    for (size_t at = text.find(old.old_key); at != std::string::npos; at = text.find(old.old_key, at + 1)) {
      const size_t end = text.find_first_not_of(' ', at + old.old_key.size());
      const bool whole = at > 0 && std::string_view("{ ,").find(text[at - 1]) != std::string_view::npos;
      if (!whole || end == std::string::npos || text[end] != '=') continue;
      const size_t value_end = text.find_first_of(",}", end);
      const std::string statement = text.substr(at, value_end - at);
      text.replace(at, statement.size(), with_key(statement, std::string(old.old_key), std::string(old.key)));
    }
  return text;
}

std::string value_text(const Node& node) {
  if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
  if (const auto* integer = std::get_if<int64_t>(&node.value)) return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&node.value)) return fmt::format("{}", *number);
  if (const auto* flag = std::get_if<bool>(&node.value)) return *flag ? "true" : "false";
  std::vector<std::string> words;
  if (const Node::Array* array = node.array())
    for (const Node& element : *array) words.push_back(value_text(element));
  return fmt::format("{}", fmt::join(words, "+"));
}

/// The keys that the components have which the statements name.
std::set<std::string> keys_of_components(const std::string& name, const std::vector<Moved>& statements) {
  std::map<std::string, std::string> values;
  for (const Moved& each : statements) {
    const std::string key = each.key.substr(each.key.rfind('.') + 1);
    const Document document = parse_toml(name, each.text);
    if (const Entry* const entry = find_entry(*document.root.table(), key)) values[each.key] = value_text(entry->node);
  }
  RenderSettings settings;
  std::set<std::string> keys;
  for (bool more = true; more;) {
    more = false;
    for (const Setting& setting : describe(settings)) {
      if (!keys.insert(setting.key).second || !values.contains(setting.key)) continue;
      if (setting.key == "integrator.type" && values[setting.key] == kAuto) return {setting.key};
      if (const std::optional<SettingValue> value = parse(setting, values[setting.key])) setting.set(*value);
      more = true;
      break;
    }
  }
  return keys;
}

void append(std::string& text, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) text += line + "\n";
}

/// The tables of the integrator.
std::string new_tables(std::vector<Moved> statements,
                       std::map<std::string, std::vector<std::string>> comments_of_tables) {
  std::string text;
  for (const std::string table : kTables) {
    std::string body;
    for (const Moved& each : statements) {
      if (each.key.substr(0, each.key.rfind('.')) != table) continue;
      append(body, each.comments);
      body += each.text + "\n";
    }
    if (body.empty()) continue;
    if (!text.empty()) text += "\n";
    append(text, comments_of_tables[table]);
    text += "[" + table + "]\n" + body;
  }
  return text;
}

bool is_old_table(const std::string& table) {
  const auto all = old_keys();
  return table != "render" && std::any_of(all.begin(), all.end(), [&](const OldKey& old) {
           return old.old_key.substr(0, old.old_key.find('.')) == table;
         });
}

/// A scene without its old keys, and the tables of the new ones.
class UpgradedScene {
 public:
  explicit UpgradedScene(const std::string& name) : name_(name) {}

  void add(const Piece& piece, bool combines) {
    const bool old_table = is_old_table(piece.table);
    if (piece.kind == Piece::Kind::statement)
      if (const OldKey* const old = find_old(join(piece.table, piece.key))) {
        remember_place(old_table);
        const auto name_alone = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
        for (Moved& each : moved(piece, *old, combines, name_alone)) {
          const std::string table = each.key.substr(0, each.key.rfind('.'));
          if (!header_.empty()) comments_of_tables_[table] = std::exchange(header_, {});
          statements_.push_back(std::move(each));
        }
        return;
      }
    if (old_table) {
      if (piece.kind == Piece::Kind::statement)
        throw InputError(
            fmt::format("{}: '{}' of [{}] is no key of an older version, either", name_, piece.key, piece.table));
      remember_place(true);
      if (piece.kind == Piece::Kind::header) header_ = piece.comments;
      for (const std::string& line : piece.kind == Piece::Kind::empty ? piece.comments : std::vector<std::string>())
        left_ += line + "\n";
      return;
    }
    append(left_, piece.comments);
    if (piece.kind != Piece::Kind::end) left_ += piece.text + "\n";
    if (piece.table == "render" && piece.kind == Piece::Kind::statement) behind_render_ = left_.size();
  }

  Upgraded finish() {
    const std::set<std::string> keys = keys_of_components(name_, statements_);
    Upgraded upgraded;
    std::erase_if(statements_, [&](const Moved& each) {
      if (keys.contains(each.key)) return false;
      upgraded.notes.push_back(
          fmt::format("{} is left out: the components that the file names do not have it", each.key));
      return true;
    });
    std::string tables = new_tables(statements_, comments_of_tables_);
    const size_t at = place_ ? *place_ : behind_render_ ? *behind_render_ : left_.size();
    std::string before = left_.substr(0, at), after = left_.substr(at);
    while (before.ends_with("\n\n")) before.pop_back();
    after.erase(0, after.find_first_not_of('\n'));
    if (!tables.empty() && !before.empty()) before += "\n";
    if (!after.empty()) after = "\n" + after;
    upgraded.text = before + tables + after;
    return upgraded;
  }

 private:
  void remember_place(bool old_table) {
    if (old_table && !place_) place_ = left_.size();
  }

  std::string name_;
  std::string left_;  // what stays as it is
  std::optional<size_t> place_, behind_render_;
  std::vector<std::string> header_;  // the comments above an old header, until they have a table
  std::map<std::string, std::vector<std::string>> comments_of_tables_;
  std::vector<Moved> statements_;
};

std::string upgraded_experiment(const std::string& name, const std::vector<Piece>& pieces) {
  std::string text;
  for (const Piece& piece : pieces) {
    const std::string path = join(piece.table, piece.key);
    const size_t at = after_set(path);
    const OldKey* const old =
        piece.kind == Piece::Kind::statement && at != std::string::npos ? find_old(path.substr(at)) : nullptr;
    if (old && piece.table.size() + 1 > at)
      throw InputError(fmt::format("{}: '{}' stands in the table [{}]: write it as a dotted key of the table above",
                                   name, piece.key, piece.table));
    append(text, old ? std::vector<std::string>() : piece.comments);
    if (!old) {
      if (piece.kind != Piece::Kind::end) text += with_inline_keys(piece.text) + "\n";
      continue;
    }
    for (const Moved& each : moved(piece, *old, false, [](const std::string& key) { return key; })) {
      append(text, each.comments);
      text += each.text + "\n";
    }
  }
  return text;
}

}  // namespace

Upgraded upgrade(const std::string& name, const std::string& text) {
  const Document document = parse_toml(name, text);
  const std::vector<Piece> pieces = pieces_of(name, lines_of_text(text));
  const bool experiment =
      find_entry(*document.root.table(), "methods") || find_entry(*document.root.table(), "product");
  if (experiment) return {upgraded_experiment(name, pieces)};
  const bool any_old = std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
    return is_old_table(piece.table) ||
           (piece.kind == Piece::Kind::statement && find_old(join(piece.table, piece.key)));
  });
  if (!any_old) return {text};
  const bool combines = std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
    return join(piece.table, piece.key) == "render.integrator" && piece.text.find("combined") != std::string::npos;
  });
  UpgradedScene scene(name);
  for (const Piece& piece : pieces) scene.add(piece, combines);
  return scene.finish();
}

}  // namespace vpm
