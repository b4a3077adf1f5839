// The report is checked for its sections and settings, the picture against what the report says of it.
#include "report/read_report.h"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "vpm/base/error.h"
#include "vpm/base/version.h"
#include "vpm/integrators/describe.h"

namespace vpm::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: {}", path.string(), why));
}

std::string text_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file || fs::is_directory(path)) refuse(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  return text;
}

bool is_by_vpm(const Json& json) {
  return json.is_object() && json.contains("program") && json["program"].is_string() &&
         json["program"].get<std::string>().starts_with("vpm ");
}

/// The report, which is one of vpm render, with all that pages show.
Json report_in(const fs::path& path) {
  const Json json = Json::parse(text_in(path), nullptr, false);
  if (json.is_discarded()) refuse(path, "is not JSON; vpm report wants the .json file that vpm render writes");
  if (!is_by_vpm(json)) refuse(path, "is no report of vpm; vpm report wants the .json file that vpm render writes");
  if (json.contains("light_map")) refuse(path, "is of a light map; vpm report shows reports of vpm render");
  for (const char* const section :
       {"scene",  "scene_hash", "image",  "width",     "height", "rendered_pixels", "seed",     "threads",
        "passes", "settings",   "stages", "overrides", "chosen", "notes",           "warnings", "times",
        "lights", "photons",    "energy", "memory",    "error",  "techniques",      "eye"})
    if (!json.contains(section))
      refuse(path, fmt::format("has no '{}': it is by {}, and this is vpm {}; render again, or use that vpm", section,
                               json["program"].get<std::string>(), version()));
  return json;
}

std::string text_of_json(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// The value of a setting, which may also be the default where that is outside of its domain.
std::optional<SettingValue> value_of(const Setting& setting, const std::string& text) {
  return text == text_of(setting.default_value) ? setting.default_value : parse(setting, text);
}

/// Takes the first setting of the report that these settings have. Is there one?
bool take_next(Json& left, RenderSettings& settings) {
  for (const Setting& setting : describe(settings)) {
    if (!left.contains(setting.key)) continue;
    const std::optional<SettingValue> value = value_of(setting, text_of_json(left[setting.key]));
    if (!value) continue;
    setting.set(*value);
    left.erase(setting.key);
    return true;
  }
  return false;
}

/// In the order of descriptions: which settings there are depends on those before.
RenderSettings settings_in(const fs::path& path, const Json& json) {
  RenderSettings settings;
  Json left = json.at("settings");
  while (take_next(left, settings)) {
  }
  for (const auto& [key, value] : left.items())
    refuse(path, fmt::format("this vpm, {}, has no setting {} = {}: the report is by {}", version(), key,
                             text_of_json(value), json["program"].get<std::string>()));
  return settings;
}

/// What the picture says of itself under a name must be what its report says.
void check_same(const fs::path& picture, const ExrChannels& channels, const std::string& name,
                const std::string& reported) {
  const auto found = channels.metadata.find(name);
  if (found == channels.metadata.end())
    refuse(picture, fmt::format("does not state its {}: it is no picture of vpm render", name));
  if (found->second != reported)
    refuse(picture, fmt::format("is of another render than its report: {} is {} in the picture and {} in the report",
                                name, found->second, reported));
}

ExrChannels picture_of(const fs::path& path, const Json& json, const RenderSettings& settings) {
  const fs::path picture = fs::path(path).replace_extension(".exr");
  if (!fs::exists(picture))
    refuse(path, fmt::format("its picture is missing: it is looked for beside the report, as '{}'", picture.string()));
  ExrChannels channels = read_exr_channels(picture);
  check_same(picture, channels, "vpm.sceneHash", text_of_json(json["scene_hash"]));
  check_same(picture, channels, "vpm.seed", text_of_json(json["seed"]));
  check_same(picture, channels, "vpm.passes", text_of_json(json["passes"]));
  check_same(picture, channels, "vpm.settings", settings_line(settings));
  if (channels.width != json["width"] || channels.height != json["height"])
    refuse(picture, fmt::format("is of another render than its report: it has {} x {} pixels, not {} x {}",
                                channels.width, channels.height, json["width"].dump(), json["height"].dump()));
  return channels;
}

}  // namespace

RenderReport read_report(const fs::path& path) {
  Json json = report_in(path);
  const RenderSettings settings = settings_in(path, json);
  ExrChannels picture = picture_of(path, json, settings);
  return {std::move(json), settings, std::move(picture)};
}

}  // namespace vpm::tools
