// Origins as fields.
#include "vpm/job/origin.h"

#include <charconv>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace vpm {
namespace {

constexpr const char *kScene = "scene", *kSeed = "seed", *kAutomatic = "automatic", *kOverride = "override";

/// Names of files and values of options may have line feeds.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') out += "\\\\";
    if (c == '\n') out += "\\n";
    if (c != '\\' && c != '\n') out += c;
  }
  return out;
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      out += text[i];
      continue;
    }
    if (++i == text.size() || (text[i] != '\\' && text[i] != 'n')) throw std::invalid_argument("a lone backslash");
    out += text[i] == 'n' ? '\n' : '\\';
  }
  return out;
}

uint64_t number_of(std::string_view text) {
  uint64_t number = 0;
  const char* const last = text.data() + text.size();
  if (const auto [end, error] = std::from_chars(text.data(), last, number); end != last || error != std::errc())
    throw std::invalid_argument("no number");
  return number;
}

}  // namespace

Origin origin_of(const RenderJob& job) {
  const std::string scene = job.source.empty() ? "" : std::filesystem::absolute(job.source).string();
  return {scene, job.overrides, job.chooses_defaults, job.settings.seed};
}

Identity fields_of(const Origin& origin) {
  Identity fields{{kScene, escaped(origin.scene)},
                  {kSeed, std::to_string(origin.seed)},
                  {kAutomatic, origin.automatic ? "1" : "0"}};
  for (const std::string& each : origin.overrides) fields.emplace_back(kOverride, escaped(each));
  return fields;
}

Origin origin_from(const Identity& fields) {
  Origin origin;
  for (const auto& [name, value] : fields) {
    if (name == kScene)
      origin.scene = unescaped(value);
    else if (name == kSeed)
      origin.seed = number_of(value);
    else if (name == kAutomatic)
      origin.automatic = number_of(value) != 0;
    else if (name == kOverride)
      origin.overrides.push_back(unescaped(value));
    else
      throw std::invalid_argument("an unknown field");
  }
  return origin;
}

}  // namespace vpm
