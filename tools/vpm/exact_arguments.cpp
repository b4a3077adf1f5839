// Reading the key=value pairs of vpm exact.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "exact_problems.h"
#include "vpm/base/error.h"

namespace vpm::tools {

namespace {

std::string names(const std::vector<ExactKey>& keys) {
  std::string text;
  for (const ExactKey& key : keys) text += (text.empty() ? "" : ", ") + key.name;
  return text;
}

std::string describe(const ExactLimits& limits) {
  const bool low = std::isfinite(limits.lo), high = std::isfinite(limits.hi);
  std::string text = "a number";
  if (low) text += fmt::format(" {} {:g}", limits.open_lo ? "above" : high ? "from" : "of at least", limits.lo);
  if (low && high && limits.open_lo) text += " and";
  if (high)
    text += fmt::format(" {} {:g}", limits.open_hi ? "below" : low && !limits.open_lo ? "to" : "up to", limits.hi);
  return text;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace

ExactArguments::ExactArguments(std::string problem, const std::vector<ExactKey>& keys,
                               const std::vector<std::string>& given)
    : problem_(std::move(problem)) {
  for (const ExactKey& key : keys) values_.emplace_back(key.name, key.otherwise);
  for (const std::string& argument : given) {
    const size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals);
    const auto value = std::find_if(values_.begin(), values_.end(), [&](const auto& v) { return v.first == name; });
    if (equals == std::string::npos || equals + 1 == argument.size())
      throw InputError(
          fmt::format("exact {}: {} is not of the form key=value; keys: {}", problem_, argument, names(keys)));
    if (value == values_.end())
      throw InputError(fmt::format("exact {}: there is no key {}; keys: {}", problem_, name, names(keys)));
    if (std::find(given_.begin(), given_.end(), name) != given_.end()) refuse(name, "is given twice");
    value->second = argument.substr(equals + 1);
    given_.push_back(name);
  }
  for (const ExactKey& key : keys)
    if (key.required && std::find(given_.begin(), given_.end(), key.name) == given_.end())
      throw InputError(
          fmt::format("exact {}: {}=... is missing: {}; keys: {}", problem_, key.name, key.meaning, names(keys)));
}

void ExactArguments::refuse(const std::string& key, const std::string& what) const {
  throw InputError(fmt::format("exact {}: {} {}", problem_, key, what));
}

const std::string& ExactArguments::text(const std::string& key) {
  const auto value = std::find_if(values_.begin(), values_.end(), [&](const auto& v) { return v.first == key; });
  if (std::find(read_.begin(), read_.end(), *value) == read_.end()) read_.push_back(*value);
  return value->second;
}

double ExactArguments::parse(const std::string& key, const std::string& value, const ExactLimits& limits) const {
  double number = 0.0;
  const char* const end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  const bool above = limits.open_lo ? number > limits.lo : number >= limits.lo;
  const bool below = limits.open_hi ? number < limits.hi : number <= limits.hi;
  if (error != std::errc() || stop != end || !above || !below)
    refuse(key, fmt::format("is {}, and must be {}", value.empty() ? "missing" : value, describe(limits)));
  return number;
}

double ExactArguments::number(const std::string& key, const ExactLimits& limits) {
  return parse(key, text(key), limits);
}

std::vector<double> ExactArguments::list(const std::string& key, const ExactLimits& limits) {
  std::vector<double> numbers;
  const std::string& all = text(key);
  if (all.empty()) return numbers;
  for (const std::string& part : split(all)) numbers.push_back(parse(key, part, limits));
  return numbers;
}

std::string ExactArguments::word(const std::string& key, const std::vector<std::string>& words) {
  const std::string& value = text(key);
  if (std::find(words.begin(), words.end(), value) == words.end())
    refuse(key, fmt::format("is {}, and must be one of {}", value, fmt::join(words, ", ")));
  return value;
}

std::string ExactArguments::path(const std::string& key) {
  const std::string& value = text(key);
  if (value.empty()) refuse(key, "is missing: name a file");
  return value;
}

void ExactArguments::expect_all_read() const {
  for (const std::string& name : given_)
    if (std::none_of(read_.begin(), read_.end(), [&](const auto& v) { return v.first == name; }))
      refuse(name, "means nothing here: with the other keys given, it is not used");
}

}  // namespace vpm::tools
