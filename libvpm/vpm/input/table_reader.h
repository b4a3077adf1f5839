// Reading one table of a scene file: typed values with ranges, and no key that nobody asked for.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vpm/base/settings/range.h"
#include "vpm/base/settings/setting.h"
#include "vpm/base/vec.h"
#include "vpm/input/node.h"

namespace vpm {

/// Wraps a table. Every key asked for becomes a known key; finish() refuses all others. Numbers must be
/// finite and representable in single precision besides their range. A reader with a default returns
/// it where the key is missing; one without refuses that. All errors are InputErrors with the place.
class TableReader {
 public:
  /// `title` names the table in messages, e.g. "[camera]". Refuses a node that is no table. The files that path()
  /// finds, here and in tables inside, are added to `files`, each once.
  TableReader(const Node& node, std::string title, std::vector<std::string>& files);

  bool has(const std::string& key);
  float number(const std::string& key, const Range& range, std::optional<float> fallback = {});
  /// Does a key that holds a number otherwise say kAuto? Other words are refused.
  bool says_auto(const std::string& key);
  /// Does a key hold this text?
  bool says(const std::string& key, const std::string& text);
  uint64_t integer(const std::string& key, uint64_t lo, uint64_t hi, std::optional<uint64_t> fallback = {});
  bool flag(const std::string& key, bool fallback);
  std::string string(const std::string& key, std::optional<std::string> fallback = {});
  /// The path of a file that is there, relative to the scene file's folder, or to the current one where a --set option
  /// gave it.
  std::string path(const std::string& key);
  /// `count` finite numbers.
  std::vector<double> numbers(const std::string& key, size_t count, const Range& range = kAny);
  /// Three numbers: a point or a vector.
  Vec3 vector(const std::string& key, std::optional<Vec3> fallback = {});
  /// Three numbers, not all zero, normalised.
  Vec3 direction(const std::string& key, std::optional<Vec3> fallback = {});
  /// One number for all channels, or three.
  Rgb rgb(const std::string& key, const Range& range, std::optional<Rgb> fallback = {});
  /// One of a list of words.
  template <class T>
  T choice(const std::string& key, const std::vector<std::pair<std::string, T>>& words, std::optional<T> fallback = {});

  /// An array of some of these words, not empty, each at most once; or a text of them joined by "+".
  std::vector<std::string> words(const std::string& key, const std::vector<std::string>& allowed);

  /// The node of a key; null where it is missing. Marks the key as known.
  const Node* find(const std::string& key);
  const Node& require(const std::string& key);
  /// A sub-table, titled `title` in messages; nothing where it is missing.
  std::optional<TableReader> table(const std::string& key, const std::string& title);
  /// All entries of a table whose keys are names.
  std::vector<std::pair<std::string, TableReader>> named_tables(const std::string& title);
  /// The elements of an array of tables, titled "<title> 'name'" or "<title> number i".
  std::vector<TableReader> tables(const std::string& key, const std::string& title);

  /// The keys that nobody asked for.
  std::vector<const Entry*> unknown() const;
  /// Refuses the first of these; what `hint` has to say of it comes before the keys that there are.
  void finish(const std::function<std::string(const std::string& key)>& hint = {}) const;

  /// Throws an error at the value of `key`, or at the table where the key is missing.
  [[noreturn]] void fail(const std::string& key, const std::string& wrong, const std::string& right = "") const;
  /// Throws an error at the table.
  [[noreturn]] void fail_here(const std::string& wrong, const std::string& right = "") const;
  /// All keys the table has, known or not.
  std::vector<std::string> keys() const;
  const std::string& title() const { return title_; }
  const Place& place() const { return node_->place; }
  const Place& place_of(const std::string& key) const;
  [[noreturn]] void refuse_unknown(const Entry& entry, const std::string& hint = "") const;

 private:
  /// Says what words there are in place of another, or of no word.
  [[noreturn]] void refuse_word(const std::string& key, const Node& node, const std::vector<std::string>& words) const;

  const Node* node_;
  std::string title_;
  std::vector<std::string>* files_;
  std::vector<std::string> known_;
};

template <class T>
T TableReader::choice(const std::string& key, const std::vector<std::pair<std::string, T>>& words,
                      std::optional<T> fallback) {
  if (!find(key) && fallback) return *fallback;
  const Node& node = require(key);
  const auto* word = std::get_if<std::string>(&node.value);
  std::vector<std::string> allowed;
  for (const auto& [name, value] : words) {
    if (word && name == *word) return value;
    allowed.push_back(name);
  }
  refuse_word(key, node, allowed);
}

}  // namespace vpm
