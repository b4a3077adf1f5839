// Values and texts of settings.
#include "vpm/base/settings/setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <charconv>
#include <cmath>

#include "vpm/base/overloads.h"

namespace vpm {
namespace {

template <class Number>
std::optional<SettingValue> number_in(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// Finite in single precision, too.
template <class Number>
bool is_in(const Range& range, Number number) {
  return std::isfinite(static_cast<float>(number)) && contains(range, number);
}

std::optional<SettingValue> value_in(const Setting& setting, const std::string& text) {
  if (std::holds_alternative<Words>(setting.domain) || std::holds_alternative<WordSet>(setting.domain)) return text;
  if (std::holds_alternative<Integers>(setting.domain)) return number_in<uint64_t>(text);
  if (std::holds_alternative<Numbers>(setting.domain))
    return std::holds_alternative<float>(setting.default_value) ? number_in<float>(text) : number_in<double>(text);
  if (text == "true" || text == "false") return text == "true";
  return std::nullopt;
}

}  // namespace

std::vector<std::string> words_in(const std::string& value) {
  std::vector<std::string> words;
  for (size_t begin = 0; begin <= value.size();) {
    const size_t end = std::min(value.find('+', begin), value.size());
    words.push_back(value.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::string text_of(const SettingValue& value) {
  return std::visit([](const auto& held) { return fmt::format("{}", held); }, value);
}

std::string outside_of(const Domain& domain, const SettingValue& value) {
  const auto must = [&](const std::string& allowed) {
    return fmt::format("must be {}, not {}", allowed, text_of(value));
  };
  return std::visit(
      Overloads{
          [](const Flags&) { return std::string(); },
          [&](const Integers& of) {
            const uint64_t integer = std::get<uint64_t>(value);
            return of.lo <= integer && integer <= of.hi ? "" : must(fmt::format("from {} to {}", of.lo, of.hi));
          },
          [&](const Numbers& of) {
            const auto* single = std::get_if<float>(&value);
            const bool inside = single ? is_in(of.range, *single) : is_in(of.range, std::get<double>(value));
            return inside ? std::string() : must(text_of(of.range));
          },
          [&](const Words& of) {
            const bool known =
                std::find(of.words.begin(), of.words.end(), std::get<std::string>(value)) != of.words.end();
            return known ? "" : must(fmt::format("one of {}", fmt::join(of.words, ", ")));
          },
          [&](const WordSet& of) {
            for (const std::string& word : words_in(std::get<std::string>(value)))
              if (std::find(of.words.begin(), of.words.end(), word) == of.words.end())
                return must(fmt::format("some of {}", fmt::join(of.words, ", ")));
            return std::string();
          },
      },
      domain);
}

std::optional<SettingValue> parse(const Setting& setting, const std::string& text) {
  std::optional<SettingValue> value = value_in(setting, text);
  return value && outside_of(setting.domain, *value).empty() ? value : std::nullopt;
}

}  // namespace vpm
