// Cases of reference numbers as files give them, and what became of them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vpm/base/error.h"
#include "vpm/base/vec.h"
#include "vpm/study/check.h"
#include "vpm/study/validate/ladder.h"

namespace vpm::tools {

/// A value as JSON has it. A boolean is the text "true" or "false".
struct OracleValue {
  using List = std::vector<OracleValue>;
  using Object = std::map<std::string, OracleValue, std::less<>>;
  std::variant<std::monostate, double, std::string, List, Object> value;

  bool is_null() const { return std::holds_alternative<std::monostate>(value); }
  const double* number() const { return std::get_if<double>(&value); }
  const std::string* text() const { return std::get_if<std::string>(&value); }
  const List* list() const { return std::get_if<List>(&value); }
  const Object* object() const { return std::get_if<Object>(&value); }
};

/// One case of a file. Its fields are read by kind; what is missing or of another kind throws InputError with file,
/// case and field.
class OracleCase {
 public:
  OracleCase(const OracleValue::Object& fields, std::string place) : fields_(fields), place_(std::move(place)) {}

  const std::string& place() const { return place_; }
  const OracleValue::Object& fields() const { return fields_.get(); }
  /// "id", or the fields that identify the case.
  std::string id() const;
  bool has(std::string_view field) const;
  /// A finite number, or text that is one.
  double number(std::string_view field) const;
  /// A number or "inf".
  double number_or_infinity(std::string_view field) const;
  /// A number within [lo, hi].
  double number_in(std::string_view field, double lo, double hi) const;
  /// A fraction: a number within [0, 1] up to rounding, which is taken off.
  double share(std::string_view field) const;
  std::vector<double> shares(std::string_view field, size_t size) const;
  /// A whole number >= 1.
  uint64_t count(std::string_view field) const;
  std::string text(std::string_view field) const;
  std::vector<double> numbers(std::string_view field) const;
  /// As many as another list has.
  std::vector<double> numbers(std::string_view field, size_t size) const;
  Vec3d vector(std::string_view field) const;
  /// An object, and the objects of a list.
  OracleCase object(std::string_view field) const;
  std::vector<OracleCase> objects(std::string_view field) const;
  const OracleValue& value(std::string_view field) const;

  [[noreturn]] void refuse(const std::string& why) const;

 private:
  std::reference_wrapper<const OracleValue::Object> fields_;
  std::string place_;
};

/// Scenes have floats.
inline float as_float(double x) { return static_cast<float>(x); }

/// What became of a case: its checks; or why there are none, or none that can fail.
struct CaseResult {
  std::string id;
  std::vector<Check> checks;
  std::string unchecked;  // why the case is not checked; empty: it is
};

/// The cases of a list in a file.
struct OracleList {
  std::string file, name;  // e.g. "s6_density.json", "knn"
  std::vector<OracleCase> cases;
};
using CaseRunner = std::vector<CaseResult> (*)(const OracleList&, const Effort&);

/// The runner of a list of that name in a file of that name; null where none knows it.
CaseRunner runner_of(std::string_view file, std::string_view list);

// A problem each. Cases may share work: the results stand in the order of the cases.
std::vector<CaseResult> run_free_flights(const OracleList&, const Effort&);       // S1
std::vector<CaseResult> run_point_sources(const OracleList&, const Effort&);      // S2
std::vector<CaseResult> run_airlights(const OracleList&, const Effort&);          // S3
std::vector<CaseResult> run_slabs(const OracleList&, const Effort&);              // S4, S8
std::vector<CaseResult> run_spheres(const OracleList&, const Effort&);            // S5
std::vector<CaseResult> run_density_estimates(const OracleList&, const Effort&);  // S6
std::vector<CaseResult> run_irradiances(const OracleList&, const Effort&);        // S7
std::vector<CaseResult> run_cavities(const OracleList&, const Effort&);           // S7
std::vector<CaseResult> run_emission(const OracleList&, const Effort&);           // S9

/// What `run` makes of a case. One that it refuses, for a field that is missing or of a value that the framework does
/// not know, stays unchecked.
template <class Run>
CaseResult run_case(Run&& run) {
  try {
    return run();
  } catch (const InputError& error) {
    return {{}, {}, error.what()};
  }
}

/// Runs each case of a list by itself.
template <class Run>
std::vector<CaseResult> run_each(const OracleList& list, Run&& run) {
  std::vector<CaseResult> results;
  results.reserve(list.cases.size());
  for (const OracleCase& c : list.cases) results.push_back(run_case([&] { return run(c); }));
  return results;
}

}  // namespace vpm::tools
