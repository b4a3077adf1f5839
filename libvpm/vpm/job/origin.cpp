// Origins as JSON.
#include "vpm/job/origin.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace vpm {

Origin origin_of(const RenderJob& job) {
  const std::string scene = job.source.empty() ? "" : std::filesystem::absolute(job.source).string();
  return {scene, job.overrides, job.left_out_is_automatic, job.settings.seed};
}

std::string line_of(const Origin& origin) {
  using Json = nlohmann::ordered_json;
  return Json{
      {"scene", origin.scene}, {"overrides", origin.overrides}, {"automatic", origin.automatic}, {"seed", origin.seed}}
      .dump(-1, ' ', true, Json::error_handler_t::replace);
}

Origin origin_of_line(const std::string& line) {
  try {
    const nlohmann::json read = nlohmann::json::parse(line);
    const Origin none;
    return {read.value("scene", none.scene), read.value("overrides", none.overrides),
            read.value("automatic", none.automatic), read.value("seed", none.seed)};
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace vpm
