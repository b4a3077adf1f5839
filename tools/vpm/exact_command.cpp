// vpm exact: exact solutions with their error bounds, for people or as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.h"
#include "exact_problems.h"
#include "json.h"

namespace vpm::tools {

namespace {

void print_problems() {
  fmt::print("vpm exact PROBLEM key=value ...; lists are separated by commas\n");
  for (const ExactProblem& problem : exact_problems()) fmt::print("\n{}", text_of(problem));
}

/// The digits that the error leaves.
std::string digits(double value, double error) {
  const double count = value == 0.0 || error == 0.0 ? 17.0 : std::log10(std::fabs(value) / error) + 2.0;
  return fmt::format("{:.{}g}", value, static_cast<int>(std::clamp(count, 2.0, 17.0)));
}

void print_value(const std::string& label, const std::optional<double>& value, double error, const std::string& unit) {
  if (value)
    fmt::print("{:<24} {:<22} +- {:.1e}{}{}\n", label, digits(*value, error), error, unit.empty() ? "" : "  ", unit);
  else
    fmt::print("{:<24} none\n", label);
}

void print_quantity(const ExactQuantity& quantity) {
  if (quantity.place.empty()) return print_value(quantity.name, quantity.values[0], quantity.errors[0], quantity.unit);
  fmt::print("{}{}\n", quantity.name, quantity.unit.empty() ? "" : " (" + quantity.unit + ")");
  const bool bins = quantity.places.size() == quantity.values.size() + 1;
  for (size_t i = 0; i < quantity.values.size(); ++i) {
    const std::string to = bins ? fmt::format(" to {:g}", quantity.places[i + 1]) : "";
    const std::string label =
        fmt::format("  {} {:g}{} {}", quantity.place, quantity.places[i], to, quantity.place_unit);
    print_value(label, quantity.values[i], quantity.errors[i], "");
  }
}

void print_json(const std::string& problem, const ExactArguments& arguments,
                const std::vector<ExactQuantity>& quantities) {
  Json report;
  report["problem"] = problem;
  for (const auto& [key, value] : arguments.read()) report["arguments"][key] = value;
  for (const ExactQuantity& quantity : quantities) {
    Json entry;
    entry["name"] = quantity.name;
    entry["unit"] = quantity.unit;
    if (!quantity.place.empty()) {
      entry["place"] = quantity.place;
      entry["place_unit"] = quantity.place_unit;
      entry["places"] = quantity.places;
    }
    for (size_t i = 0; i < quantity.values.size(); ++i) {
      entry["values"].push_back(quantity.values[i] ? Json(*quantity.values[i]) : nullptr);
      entry["errors"].push_back(quantity.errors[i]);
    }
    report["quantities"].push_back(entry);
  }
  fmt::print("{}\n", report.dump(2));
}

}  // namespace

std::string text_of(const ExactProblem& problem) {
  std::string text = fmt::format("{}: {}\n", problem.name, problem.summary);
  for (const ExactKey& key : problem.keys) {
    const std::string note = key.required ? " [required]" : key.otherwise.empty() ? "" : " [" + key.otherwise + "]";
    text += fmt::format("  {:<10} {}{}\n", key.name, key.meaning, note);
  }
  return text;
}

int exact_command(const ExactOptions& options) {
  if (options.problem.empty()) {
    print_problems();
    return 0;
  }
  const ExactProblem& problem = find_exact_problem(options.problem);
  ExactArguments arguments(problem.name, problem.keys, options.arguments);
  const std::vector<ExactQuantity> quantities = solve(problem, arguments);
  if (options.json) {
    print_json(problem.name, arguments, quantities);
    return 0;
  }
  fmt::print("{}", problem.name);
  for (const auto& [key, value] : arguments.read())
    if (!value.empty()) fmt::print(" {}={}", key, value);
  fmt::print("\n");
  for (const ExactQuantity& quantity : quantities) print_quantity(quantity);
  return 0;
}

}  // namespace vpm::tools
