// What vpm exact can solve: a table of problems, their keys, and the quantities they answer.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vpm::tools {

struct ExactKey {
  std::string name, meaning;
  std::string otherwise;  // its value where none is given; empty: it must be given, or may be left out
  bool required = false;
};

/// Numbers that a key accepts.
struct ExactLimits {
  double lo = -std::numeric_limits<double>::infinity(), hi = std::numeric_limits<double>::infinity();
  bool open_lo = false, open_hi = false;  // without the limit itself
};

/// The key=value pairs of a command line. Reading checks them: InputError says what would be right.
class ExactArguments {
 public:
  /// Refuses unknown and repeated keys, and misses required ones.
  ExactArguments(std::string problem, const std::vector<ExactKey>& keys, const std::vector<std::string>& given);

  double number(const std::string& key, const ExactLimits& limits = {});
  /// Numbers separated by commas; none where the key is not given.
  std::vector<double> list(const std::string& key, const ExactLimits& limits = {});
  std::string word(const std::string& key, const std::vector<std::string>& words);
  /// The name of a file, which must be given.
  std::string path(const std::string& key);
  [[noreturn]] void refuse(const std::string& key, const std::string& what) const;

  /// Refuses keys that were given and not read: they mean nothing with the others given.
  void expect_all_read() const;
  /// All that were read, with their values.
  const std::vector<std::pair<std::string, std::string>>& read() const { return read_; }

 private:
  const std::string& text(const std::string& key);
  double parse(const std::string& key, const std::string& value, const ExactLimits& limits) const;

  std::string problem_;
  std::vector<std::pair<std::string, std::string>> values_, read_;  // in the order of the keys, and of reading
  std::vector<std::string> given_;
};

/// A quantity: one value, or one at each of several places.
struct ExactQuantity {
  std::string name, unit;
  std::string place, place_unit;              // what `places` are; empty for a single value
  std::vector<double> places;                 // lower edges where there is one more of them than values
  std::vector<std::optional<double>> values;  // none: there is no such place
  std::vector<double> errors;
};

struct ExactProblem {
  std::string name, summary;
  std::vector<ExactKey> keys;
  std::vector<ExactQuantity> (*solve)(ExactArguments& arguments);
};

const std::vector<ExactProblem>& exact_problems();
/// Its summary and its keys, a line each.
std::string text_of(const ExactProblem& problem);
/// The problem of that name. Throws InputError where there is none.
const ExactProblem& find_exact_problem(const std::string& name);
/// Solves it, and refuses keys that meant nothing, and what has no finite answer: InputError.
std::vector<ExactQuantity> solve(const ExactProblem& problem, ExactArguments& arguments);

}  // namespace vpm::tools
