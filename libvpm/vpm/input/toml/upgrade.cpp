// A file is taken apart into statements, each with its comments. In experiments a statement gets its new key
// where it stands; in scenes it moves to a table of the integrator, and these follow where the first old table was.
// What comes out is read again: it must be TOML, and have no old keys.
#include "vpm/input/toml/upgrade.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "vpm/base/error.h"
#include "vpm/input/toml/old_keys.h"
#include "vpm/input/toml/pieces.h"
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

std::string join(const std::string& table, const std::string& key) { return table.empty() ? key : table + "." + key; }

/// Where the settings of an experiment begin in a path: behind "set." or "product."; npos where it has none.
size_t after_set(const std::string& path) {
  for (const std::string word : {"set.", "product."})
    if (const size_t at = ("." + path).find("." + word); at != std::string::npos) return at + word.size();
  return std::string::npos;
}

const OldKey* find_old(const std::string& key) {
  const auto all = old_keys();
  const auto found = std::find_if(all.begin(), all.end(), [&](const OldKey& old) { return old.old_key == key; });
  return found == all.end() ? nullptr : &*found;
}

bool is_old_table(const std::string& table) {
  const auto all = old_keys();
  return table != "render" && std::any_of(all.begin(), all.end(), [&](const OldKey& old) {
           return old.old_key.substr(0, old.old_key.find('.')) == table;
         });
}

struct FoundKey {
  std::string key;
  Place place;
};

/// The first old key of the tables of a scene, or of the settings of an experiment, if there is any.
std::optional<FoundKey> old_key_in(const Node::Table& tables) {
  for (const Entry& entry : tables) {
    const Node::Table* const inner = entry.node.table();
    if (inner && is_old_table(entry.key)) {
      if (inner->empty()) return FoundKey{entry.key, entry.place};
      return FoundKey{entry.key + "." + inner->front().key, inner->front().place};
    }
    if (inner && entry.key == "render")
      for (const Entry& each : *inner)
        if (find_old("render." + each.key)) return FoundKey{"render." + each.key, each.place};
  }
  return std::nullopt;
}

std::optional<FoundKey> old_key_of_experiment(const Node& node) {
  if (const Node::Array* const array = node.array())
    for (const Node& element : *array)
      if (auto found = old_key_of_experiment(element)) return found;
  if (!node.table()) return std::nullopt;
  for (const Entry& entry : *node.table()) {
    const bool settings = (entry.key == "set" || entry.key == "product") && entry.node.table();
    if (auto found = settings ? old_key_in(*entry.node.table()) : old_key_of_experiment(entry.node)) return found;
  }
  return std::nullopt;
}

/// A statement with another key, and another value for some words.
std::string with_key(const std::string& statement, const std::string& key, const std::string& new_key) {
  std::string text = statement;
  text.replace(text.find(key), key.size(), new_key);
  if (new_key != "type" && !new_key.ends_with("integrator.type")) return text;
  for (const char quote : {'"', '\''}) {
    const std::string photon = fmt::format("{}photon{}", quote, quote);
    const size_t end = text.size() - comment_behind(text).size(), at = text.find(photon);
    if (at < end) text.replace(at, photon.size(), fmt::format("{}photon-map{}", quote, quote));
  }
  return text;
}

/// The keys and values in the place of `surface.method`, which stood for two.
std::array<std::pair<std::string, std::string>, 2> of_method(const std::string& method) {
  return {{{"integrator.direct.type", method == "visualise" ? "\"photons\"" : "\"shadow-rays\""},
           {"integrator.indirect.type", method == "final-gather" ? "\"final-gather\"" : "\"photons\""}}};
}

/// A statement on its way to a new table.
struct Moved {
  std::string key;  // "integrator.volume.radius"
  std::vector<std::string> comments, below;
  std::string text;
  std::string value;
};

/// New keys and texts of a statement of an old key, with the new key written as `written` makes it of the whole.
template <class Written>
std::vector<Moved> moved(const Source& source, const TomlPiece& piece, const OldKey& old, Written&& written) {
  if (old.old_key != "surface.method") {
    std::string text = with_key(piece.text, piece.written_key, written(std::string(old.key)));
    return {{std::string(old.key), piece.comments, piece.below, std::move(text),
             piece.says("photon") ? "photon-map" : text_of(piece.value)}};
  }
  const auto* const method = std::get_if<std::string>(&piece.value.value);
  if (!method)
    fail_at({&source, piece.line}, fmt::format("'{}' stands for two keys now, {}", piece.key, old.key),
            "write a method of [[methods]] for each of its values, with both keys");
  std::vector<Moved> all;
  for (const auto& [key, value] : of_method(*method))
    all.push_back({key, {}, {}, written(key) + " = " + value, value.substr(1, value.size() - 2)});
  all.front().comments = piece.comments;
  all.back().below = piece.below;
  if (const std::string comment = comment_behind(piece.text); !comment.empty()) all.front().comments.push_back(comment);
  return all;
}

/// Replaces old keys within an inline table, as `set = { render.integrator = "path" }` has them: not in texts.
std::string with_inline_keys(const std::string& statement) {
  std::string text;
  char quote = 0;
  for (size_t i = 0; i < statement.size();) {
    const char c = statement[i];
    if (quote != 0 || c == '"' || c == '\'') quote = quote == 0 ? c : c == quote ? 0 : quote;
    if (quote == 0 && c == '#') return text + statement.substr(i);
    const bool begins =
        quote == 0 && i > 0 && c != ' ' && std::string_view("{ ,").find(statement[i - 1]) != std::string_view::npos;
    const size_t equals = begins ? statement.find('=', i) : std::string::npos;
    const OldKey* const old =
        equals == std::string::npos ? nullptr : find_old(trimmed(statement.substr(i, equals - i)));
    if (!old) {
      text += statement[i++];
      continue;
    }
    const size_t end = std::min(statement.find_first_of(",}", equals), statement.size());
    const std::string part = trimmed(statement.substr(i, end - i)), value = trimmed(part.substr(part.find('=') + 1));
    if (old->old_key == "surface.method") {
      const auto both = of_method(value.substr(1, value.size() - 2));
      text += fmt::format("{} = {}, {} = {}", both[0].first, both[0].second, both[1].first, both[1].second);
    } else {
      text += with_key(part, std::string(old->old_key), std::string(old->key));
    }
    i += part.size();
  }
  return text;
}

/// The keys that the components have which the statements name.
std::set<std::string> keys_of_components(const std::vector<Moved>& statements) {
  std::map<std::string, std::string> values;
  for (const Moved& each : statements) values[each.key] = each.value;
  if (values["integrator.type"] == kAuto) return {"integrator.type"};
  RenderSettings settings = settings_with(values);
  std::set<std::string> keys;
  for (const Setting& setting : describe(settings)) keys.insert(setting.key);
  return keys;
}

void append(std::string& text, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) text += line + "\n";
}

/// The tables of the integrator. Takes the comments of those that there are.
std::string new_tables(const std::vector<Moved>& statements,
                       std::map<std::string, std::vector<std::string>>& comments_of_tables) {
  std::string text;
  for (const std::string table : kTables) {
    std::string body;
    for (const Moved& each : statements) {
      if (each.key.substr(0, each.key.rfind('.')) != table) continue;
      append(body, each.comments);
      body += each.text + "\n";
      append(body, each.below);
    }
    if (body.empty()) continue;
    if (!text.empty()) text += "\n";
    append(text, std::exchange(comments_of_tables[table], {}));
    text += "[" + table + "]\n" + body;
  }
  return text;
}

/// A scene without its old keys, and the tables of the new ones.
class UpgradedScene {
 public:
  explicit UpgradedScene(const Source& source) : source_(source) {}

  void add(const TomlPiece& piece) {
    const bool statement = piece.kind == TomlPiece::Kind::statement, in_old_table = is_old_table(piece.table);
    const OldKey* const old = statement ? find_old(join(piece.table, piece.key)) : nullptr;
    if (statement && in_old_table && !old)
      fail_at({&source_, piece.line},
              fmt::format("'{}' of [{}] is no key of an older version, either", piece.key, piece.table));
    if (in_old_table && !place_) place_ = left_.size();
    if (old) return move(piece, *old);
    if (!in_old_table) return leave(piece);
    headers_.insert(headers_.end(), piece.comments.begin(), piece.comments.end());
    if (piece.kind != TomlPiece::Kind::header) return;
    if (const std::string comment = comment_behind(piece.text); !comment.empty()) headers_.push_back(comment);
  }

  Upgraded finish() {
    const std::set<std::string> keys = keys_of_components(statements_);
    const char* const reason = keys.size() == 1 ? "type \"auto\" chooses it, too; name a type to keep it"
                                                : "the components that the file names do not have it";
    Upgraded upgraded;
    std::erase_if(statements_, [&](const Moved& each) {
      if (keys.contains(each.key)) return false;
      upgraded.notes.push_back(fmt::format("{} is left out, with its comments: {}", each.key, reason));
      return true;
    });
    const std::string tables = new_tables(statements_, comments_of_tables_);
    const size_t at = place_ ? *place_ : behind_render_ ? *behind_render_ : left_.size();
    std::string before = left_.substr(0, at), after = left_.substr(at);
    for (const auto& [table, comments] : comments_of_tables_) append(before, comments);
    append(before, headers_);
    while (before.ends_with("\n\n")) before.pop_back();
    after.erase(0, after.find_first_not_of('\n'));
    if (!tables.empty() && !before.empty()) before += "\n";
    if (!after.empty() && !(before + tables).empty()) after = "\n" + after;
    for (const Moved& each : statements_)
      for (const char* const gone : {"long-beams", "planes"})
        if (each.key == "integrator.techniques" &&
            ("+" + each.value + "+").find(std::string("+") + gone + "+") != std::string::npos)
          upgraded.notes.push_back(
              fmt::format("integrator.techniques names \"{}\", which is none any more: take it out", gone));
    upgraded.text = before + tables + after;
    return upgraded;
  }

 private:
  void move(const TomlPiece& piece, const OldKey& old) {
    const auto name_alone = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
    for (Moved& each : moved(source_, piece, old, name_alone)) {
      std::vector<std::string>& comments = comments_of_tables_[each.key.substr(0, each.key.rfind('.'))];
      comments.insert(comments.end(), headers_.begin(), headers_.end());
      headers_.clear();
      statements_.push_back(std::move(each));
    }
  }
  void leave(const TomlPiece& piece) {
    append(left_, piece.comments);
    if (piece.kind != TomlPiece::Kind::end) left_ += piece.text + "\n";
    append(left_, piece.below);
    if (piece.table == "render" && piece.kind == TomlPiece::Kind::statement) behind_render_ = left_.size();
  }

  const Source& source_;
  std::string left_;  // what stays as it is
  std::optional<size_t> place_, behind_render_;
  std::vector<std::string> headers_;  // the comments of old headers, until they have a table
  std::map<std::string, std::vector<std::string>> comments_of_tables_;
  std::vector<Moved> statements_;
};

std::string upgraded_experiment(const Source& source, const std::vector<TomlPiece>& pieces) {
  std::string text;
  for (const TomlPiece& piece : pieces) {
    const std::string path = join(piece.table, piece.key);
    const size_t at = after_set(path), own = piece.table.empty() ? 0 : piece.table.size() + 1;  // where the key begins
    const OldKey* const old =
        piece.kind == TomlPiece::Kind::statement && at != std::string::npos ? find_old(path.substr(at)) : nullptr;
    if (!old || own > at) {
      append(text, piece.comments);
      if (piece.kind != TomlPiece::Kind::end) text += with_inline_keys(piece.text) + "\n";
      append(text, piece.below);
      continue;
    }
    const std::string before = path.substr(own, at - own);  // "set."
    for (const Moved& each : moved(source, piece, *old, [&](const std::string& key) { return before + key; })) {
      append(text, each.comments);
      text += each.text + "\n";
      append(text, each.below);
    }
  }
  return text;
}

Upgraded upgraded_scene(const Source& source, const std::vector<TomlPiece>& pieces) {
  UpgradedScene scene(source);
  for (const TomlPiece& piece : pieces) scene.add(piece);
  return scene.finish();
}

bool is_experiment(const Document& document) {
  return find_entry(*document.root.table(), "methods") || find_entry(*document.root.table(), "product");
}

std::optional<FoundKey> old_key_of(const Document& document) {
  return is_experiment(document) ? old_key_of_experiment(document.root) : old_key_in(*document.root.table());
}

}  // namespace

Upgraded upgrade(const std::string& name, const std::string& text) {
  const Document document = parse_toml(name, text);
  const std::optional<FoundKey> first = old_key_of(document);
  if (!first) return {text};
  const Lines lines(text);
  const std::vector<TomlPiece> pieces = pieces_of(name, lines.lines);
  const Source& source = *document.sources.front();
  Upgraded upgraded =
      is_experiment(document) ? Upgraded{upgraded_experiment(source, pieces)} : upgraded_scene(source, pieces);
  std::optional<Document> read;
  try {
    read = parse_toml(name, upgraded.text);
  } catch (const InputError&) {
    fail_at(first->place,
            fmt::format("'{}', or another old key, cannot be rewritten: a key or table of today says the same, or it "
                        "has no line of its own",
                        first->key),
            "take out what says the same, and give each old table a header, each old key a line");
  }
  if (const std::optional<FoundKey> left = old_key_of(*read))
    fail_at(first->place, fmt::format("'{}' cannot be rewritten where it stands", left->key),
            "write it as a line of its own, in scenes below its table's header, in experiments as a dotted key");
  upgraded.text = lines.as_written(upgraded.text);
  return upgraded;
}

}  // namespace vpm
