// All settings that there are, found by choosing each component once.
#include "vpm/integrators/every_setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>

#include "vpm/base/overloads.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

std::vector<std::string> words_of_domain(const Domain& domain) {
  const auto* words = std::get_if<Words>(&domain);
  return words ? words->words : std::vector<std::string>();
}

bool same(const Setting& a, const Setting& b) {
  return a.key == b.key && a.meaning == b.meaning && words_of_domain(a.domain) == words_of_domain(b.domain);
}

bool has(RenderSettings settings, const Setting& wanted) {
  const std::vector<Setting> all = describe(settings);
  return std::any_of(all.begin(), all.end(), [&](const Setting& each) { return same(each, wanted); });
}

RenderSettings with(RenderSettings settings, const std::string& key, const SettingValue& value) {
  find_setting(settings, key)->set(value);
  return settings;
}

/// The value of a set without one of its words.
std::string without(const WordSet& set, const std::string& left_out) {
  std::vector<std::string> words = set.words;
  std::erase(words, left_out);
  return fmt::format("{}", fmt::join(words, "+"));
}

/// Values that other settings may depend on: each word, a number that is not 0, and all words of a set.
std::vector<SettingValue> values_to_try(const Setting& setting) {
  return std::visit(
      Overloads{[](const Words& of) { return std::vector<SettingValue>(of.words.begin(), of.words.end()); },
                [](const Integers& of) {
                  return of.lo == 0 ? std::vector<SettingValue>{uint64_t{1}} : std::vector<SettingValue>{};
                },
                [](const WordSet& of) { return std::vector<SettingValue>{without(of, "")}; },
                [](const auto&) { return std::vector<SettingValue>{}; }},
      setting.domain);
}

/// Settings that were found, table by table, each with what was chosen for it.
struct Found {
  Setting setting;
  RenderSettings chosen;
};

/// Where a setting of that table comes: behind the others of it, or last.
std::vector<Found>::iterator end_of(const std::string& table, std::vector<Found>& found) {
  const auto last =
      std::find_if(found.rbegin(), found.rend(), [&](const Found& each) { return each.setting.table() == table; });
  return last == found.rend() ? found.end() : last.base();
}

/// Adds those that are new. Were there any?
bool add(const RenderSettings& chosen, std::vector<Found>& found) {
  RenderSettings settings = chosen;
  const size_t before = found.size();
  for (Setting& setting : describe(settings)) {
    if (std::any_of(found.begin(), found.end(), [&](const Found& each) { return same(each.setting, setting); }))
      continue;
    setting.get = nullptr;  // of settings that are gone
    setting.set = nullptr;
    const auto end = end_of(setting.table(), found);
    found.insert(end, {std::move(setting), chosen});
  }
  return found.size() > before;
}

std::vector<Found> find_all() {
  std::vector<Found> found;
  std::deque<RenderSettings> open;
  for (const Integrator integrator : {Integrator::photon, Integrator::path, Integrator::combined}) {
    RenderSettings settings;
    settings.integrator = integrator;
    add(settings, found);
    open.push_back(settings);
  }
  for (; !open.empty(); open.pop_front()) {
    RenderSettings base = open.front();
    for (const Setting& setting : describe(base))
      for (const SettingValue& value : values_to_try(setting))
        if (const RenderSettings chosen = with(open.front(), setting.key, value); add(chosen, found))
          open.push_back(chosen);
  }
  return found;
}

std::string quoted(const std::vector<std::string>& words) {
  return fmt::format("`\"{}\"`", fmt::join(words, "\"`, `\""));
}

/// What a choice must be for a setting that others of its values leave out: "`type` = `"nearest"`"; "" where any may.
std::string needed(const Found& found, const Setting& choice) {
  const std::string name = choice.table() == found.setting.table()
                               ? choice.name()
                               : fmt::format("{}` of `[{}]", choice.name(), choice.table());
  if (const auto* words = std::get_if<Words>(&choice.domain)) {
    std::vector<std::string> right, wrong;
    for (const std::string& word : words->words)
      (has(with(found.chosen, choice.key, word), found.setting) ? right : wrong).push_back(word);
    if (wrong.empty()) return "";
    return wrong.size() < 3 && right.size() > wrong.size() ? fmt::format("`{}` other than {}", name, quoted(wrong))
                                                           : fmt::format("`{}` = {}", name, quoted(right));
  }
  if (const auto* integers = std::get_if<Integers>(&choice.domain); integers && integers->lo == 0)
    return has(with(found.chosen, choice.key, uint64_t{0}), found.setting) ? "" : fmt::format("`{}` > 0", name);
  if (const auto* set = std::get_if<WordSet>(&choice.domain); set && choice.key == "integrator.techniques")
    for (const std::string& word : set->words)
      if (!has(with(found.chosen, choice.key, without(*set, word)), found.setting))
        return fmt::format("`{}` with `\"{}\"`", name, word);
  return "";
}

std::vector<std::string> conditions(const Found& found) {
  RenderSettings chosen = found.chosen;
  std::vector<std::string> all;
  for (const Setting& choice : describe(chosen))
    if (choice.key != found.setting.key && choice.key != "integrator.type")
      if (std::string one = needed(found, choice); !one.empty()) all.push_back(std::move(one));
  return all;
}

/// Is every component one that the integrator can have?
bool has_words_of_its_own(RenderSettings settings) {
  const std::vector<Setting> all = describe(settings);
  return std::all_of(all.begin(), all.end(), [](const Setting& setting) {
    return !std::holds_alternative<Words>(setting.domain) || outside_of(setting.domain, setting.get()).empty();
  });
}

/// The integrators that have it, under what else was chosen.
std::vector<std::string> integrators_of(const Found& found) {
  std::vector<std::string> integrators;
  for (const Integrator integrator : {Integrator::photon, Integrator::path, Integrator::combined}) {
    RenderSettings chosen = found.chosen;
    chosen.integrator = integrator;
    if (has(chosen, found.setting) && has_words_of_its_own(chosen)) integrators.push_back(word_of(integrator));
  }
  return integrators.size() < 3 ? integrators : std::vector<std::string>();
}

}  // namespace

const std::vector<SettingOfSome>& every_setting() {
  static const std::vector<SettingOfSome> all = [] {
    std::vector<SettingOfSome> found_all;
    for (const Found& found : find_all())
      found_all.push_back({found.setting, integrators_of(found), conditions(found)});
    return found_all;
  }();
  return all;
}

}  // namespace vpm
