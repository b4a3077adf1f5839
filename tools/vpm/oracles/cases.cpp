// Reading of cases, and the list of those who can run them.
#include "oracles/cases.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "vpm/base/error.h"

namespace vpm::tools {
namespace {

constexpr double kReferenceRounding = 1e-6;  // of reference numbers, at most

/// The whole of a text as a number; NaN where it is none.
double parse_number(const std::string& text) {
  size_t used = 0;
  try {
    const double value = std::stod(text, &used);
    return used == text.size() ? value : std::numeric_limits<double>::quiet_NaN();
  } catch (const std::exception&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

double as_number(const OracleValue& value) {
  if (value.number()) return *value.number();
  return value.text() ? parse_number(*value.text()) : std::numeric_limits<double>::quiet_NaN();
}

/// A value as messages show it.
std::string shown(const OracleValue& value) {
  if (value.is_null()) return "null";
  if (value.number()) return fmt::format("{}", *value.number());
  if (value.text()) return '"' + *value.text() + '"';
  return value.list() ? "a list" : "an object";
}

}  // namespace

void OracleCase::refuse(const std::string& why) const { throw InputError(place_ + ": " + why); }

std::string OracleCase::id() const {
  if (has("id")) return text("id");
  std::string fields;
  for (const char* field : {"dimension", "kernel"})
    if (has(field)) fields += fmt::format("{}{} {}", fields.empty() ? "" : ", ", field, shown(value(field)));
  return fields.empty() ? place_ : fields;
}

bool OracleCase::has(std::string_view field) const {
  const auto found = fields().find(field);
  return found != fields().end() && !found->second.is_null();
}

const OracleValue& OracleCase::value(std::string_view field) const {
  const auto found = fields().find(field);
  if (found == fields().end()) refuse(fmt::format("\"{}\" is missing", field));
  return found->second;
}

double OracleCase::number_or_infinity(std::string_view field) const {
  const double x = as_number(value(field));
  if (std::isnan(x)) refuse(fmt::format("\"{}\" is {}, it must be a number", field, shown(value(field))));
  return x;
}

double OracleCase::number(std::string_view field) const {
  const double x = number_or_infinity(field);
  if (std::isinf(x)) refuse(fmt::format("\"{}\" is infinite, it must be finite", field));
  return x;
}

double OracleCase::number_in(std::string_view field, double lo, double hi) const {
  const double x = number(field);
  if (!(x >= lo && x <= hi)) refuse(fmt::format("\"{}\" is {}, it must be from {} to {}", field, x, lo, hi));
  return x;
}

double OracleCase::share(std::string_view field) const {
  return std::clamp(number_in(field, -kReferenceRounding, 1.0 + kReferenceRounding), 0.0, 1.0);
}

std::vector<double> OracleCase::shares(std::string_view field, size_t size) const {
  std::vector<double> result = numbers(field, size);
  for (double& x : result) {
    if (!(x >= -kReferenceRounding && x <= 1.0 + kReferenceRounding))
      refuse(fmt::format("\"{}\" holds {}, it must be from 0 to 1", field, x));
    x = std::clamp(x, 0.0, 1.0);
  }
  return result;
}

uint64_t OracleCase::count(std::string_view field) const {
  const double x = number_in(field, 1.0, 1e9);
  if (x != std::floor(x)) refuse(fmt::format("\"{}\" is {}, it must be a whole number", field, x));
  return static_cast<uint64_t>(x);
}

std::string OracleCase::text(std::string_view field) const {
  const OracleValue& found = value(field);
  if (!found.text()) refuse(fmt::format("\"{}\" is {}, it must be text", field, shown(found)));
  return *found.text();
}

std::vector<double> OracleCase::numbers(std::string_view field) const {
  const OracleValue::List* list = value(field).list();
  if (!list || list->empty()) refuse(fmt::format("\"{}\" must be a list of numbers", field));
  std::vector<double> result;
  for (const OracleValue& item : *list) {
    result.push_back(as_number(item));
    if (!std::isfinite(result.back()))
      refuse(fmt::format("\"{}\" holds {}, it must hold finite numbers", field, shown(item)));
  }
  return result;
}

std::vector<double> OracleCase::numbers(std::string_view field, size_t size) const {
  std::vector<double> result = numbers(field);
  if (result.size() != size) refuse(fmt::format("\"{}\" has {} numbers, it must have {}", field, result.size(), size));
  return result;
}

Vec3d OracleCase::vector(std::string_view field) const {
  const std::vector<double> x = numbers(field, 3);
  return {x[0], x[1], x[2]};
}

OracleCase OracleCase::object(std::string_view field) const {
  const OracleValue& found = value(field);
  if (!found.object()) refuse(fmt::format("\"{}\" must be an object", field));
  return {*found.object(), fmt::format("{}, {}", place_, field)};
}

std::vector<OracleCase> OracleCase::objects(std::string_view field) const {
  const OracleValue::List* list = value(field).list();
  if (!list) refuse(fmt::format("\"{}\" must be a list", field));
  std::vector<OracleCase> result;
  for (const OracleValue& item : *list) {
    if (!item.object()) refuse(fmt::format("\"{}\" must hold objects", field));
    result.emplace_back(*item.object(), fmt::format("{}, {}[{}]", place_, field, result.size()));
  }
  return result;
}

CaseRunner runner_of(std::string_view file, std::string_view list) {
  struct Known {
    std::string_view file, list;
    CaseRunner run;
  };
  static constexpr Known kKnown[] = {
      {"s1_", "cases", run_free_flights},  //
      {"s2_", "cases", run_point_sources},
      {"s3_", "cases", run_airlights},
      {"s4_", "cases", run_slabs},
      {"s5_", "cases", run_spheres},
      {"s6_", "kernels", run_density_estimates},
      {"s6_", "knn", run_density_estimates},
      {"s6_", "fixed_radius", run_density_estimates},
      {"s6_", "bias", run_density_estimates},
      {"s6_", "progressive", run_density_estimates},
      {"s7_", "irradiance", run_irradiances},
      {"s7_", "cavities", run_cavities},
      {"s8_", "cases", run_slabs},
      {"s9_", "cases", run_emission},
  };
  for (const Known& known : kKnown)
    if (file.starts_with(known.file) && list == known.list) return known.run;
  return nullptr;
}

}  // namespace vpm::tools
