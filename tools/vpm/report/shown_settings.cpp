// Declarations of settings beside their values; options as a shell takes them.
#include "report/shown_settings.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <filesystem>
#include <string_view>

#include "vpm/job/setting.h"
#include "vpm/job/settings_table.h"

namespace vpm::tools {
namespace {

/// Why a setting was chosen; null where it was not.
Json reason_of(const Json& report, const std::string& key) {
  for (const Json& choice : report.at("chosen"))
    if (choice.at("key") == key) return choice.at("reason");
  return nullptr;
}

/// A word as a shell reads it back.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) c == '\'' ? text += "'\\''" : text += c;
  return text + "'";
}

/// The scene as it was rendered, without its choices: these are options, too.
std::string options_again(const Json& report) {
  std::string options;
  for (const std::string change : report.at("overrides")) {
    const std::string key = change.substr(0, change.find('='));
    if (reason_of(report, key).is_null()) options += " --set " + quoted(change);
  }
  for (const Json& choice : report.at("chosen"))
    options += " --set " +
               quoted(fmt::format("{}={}", choice.at("key").get<std::string>(), choice.at("value").get<std::string>()));
  return options;
}

/// What a render has that says nothing of the setting.
SettingValue usual_value(const Setting& setting, const RenderSettings& settings) {
  return setting.decided_by.value ? setting.decided_by.value(settings) : setting.member.get({});
}

}  // namespace

Json shown_settings(const RenderReport& report) {
  Json rows = Json::array();
  for (const Field& field : estimate_fields(report.settings)) {
    const Setting* const setting = find_setting(field.key, report.settings);
    assert(setting);
    rows.push_back({{"key", field.key},
                    {"value", text_of(field.value)},
                    {"usual", usual_of(*setting)},
                    {"is_usual", field.value == usual_value(*setting, report.settings)},
                    {"meaning", setting->meaning},
                    {"values", values_of(*setting)},
                    {"reason", reason_of(report.json, field.key)}});
  }
  return rows;
}

Json commands_again(const Json& report) {
  if (std::filesystem::path(report.at("scene").get<std::string>()).extension() != ".toml") return Json::array();
  const std::string scene = quoted(report.at("scene")), image = report.at("image");
  const std::string options = options_again(report);
  const uint64_t seed = report.at("seed"), passes = report.at("passes");
  const std::string other = std::filesystem::path(image).replace_extension("other.exr").string();
  const auto render = [&](const std::string& to, uint64_t with_seed) {
    return fmt::format("vpm render {} -o {} --seed {} --passes {}{}", scene, quoted(to), with_seed, passes, options);
  };
  return {{{"does", "renders the same picture again, on any number of threads"}, {"command", render(image, seed)}},
          {{"does", "renders it with other random numbers"}, {"command", render(other, seed + 1)}},
          {{"does", "tells how far the two are apart"},
           {"command", fmt::format("vpm error {} {}", quoted(image), quoted(other))}},
          {{"does", "tells what the scene holds and what a render of it runs"},
           {"command", fmt::format("vpm info {}{}", scene, options)}}};
}

}  // namespace vpm::tools
