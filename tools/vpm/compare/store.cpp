// A run is a JSON file and a picture for each budget; a reference is a picture. Lists of numbers, to files and back,
// and their means.
#include "compare/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "json.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/base/version.h"
#include "vpm/image/exr.h"
#include "vpm/integrators/describe.h"

namespace vpm::tools {
namespace {

bool are_of_same_techniques(const std::vector<FoundByTechnique>& a, const std::vector<FoundByTechnique>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const FoundByTechnique& x, const FoundByTechnique& y) { return x.name == y.name; });
}

}  // namespace

Json techniques_json(const std::vector<FoundByTechnique>& all) {
  Json array = Json::array();
  for (const FoundByTechnique& found : all) {
    Json json{{"name", found.name}};
    for_each_counter(found, [&](const std::string& key, double x) { json[key] = x; });
    array.push_back(std::move(json));
  }
  return array;
}

std::vector<FoundByTechnique> techniques_of(const Json& all) {
  std::vector<FoundByTechnique> techniques;
  for (const Json& json : all) {
    FoundByTechnique found{.name = json.at("name")};
    for_each_counter(found, [&](const std::string& key, double& x) {
      const Json& value = json.at(key);
      x = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    });
    techniques.push_back(std::move(found));
  }
  return techniques;
}

std::vector<FoundByTechnique> mean_of_techniques(const std::vector<std::vector<FoundByTechnique>>& repetitions) {
  std::vector<FoundByTechnique> sums = repetitions.front();
  double count = 1.0;
  for (size_t r = 1; r < repetitions.size(); ++r) {
    if (!are_of_same_techniques(repetitions[r], sums)) continue;
    for (size_t t = 0; t < sums.size(); ++t) merge_counters(sums[t], repetitions[r][t]);
    count += 1.0;
  }
  for (FoundByTechnique& sum : sums) for_each_counter(sum, [&](const std::string&, double& x) { x /= count; });
  return sums;
}

namespace {

namespace fs = std::filesystem;

RunCost cost_of(const Json& j) {
  RunCost cost;
  for_each_counter(cost, [&](const std::string& name, auto& number) { number = j.at(name); });
  return cost;
}

/// Makes a folder and those it is in.
void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("cannot make the folder '{}': {}", folder.string(), error.message()));
}

constexpr const char* kFormat = "2";

/// The format of what a folder holds: the first, up to 2026-11, did not say so. That of this program where it holds
/// nothing.
std::string format_of(const fs::path& folder) {
  std::ifstream file(folder / "format");
  if (std::string format; std::getline(file, format)) return format;
  std::error_code ignored;
  return fs::exists(folder / "runs", ignored) ? "1" : kFormat;
}

/// How the layer of what a technique finds is called, as in pictures of `vpm render`.
std::string name_of_part(const FoundByTechnique& technique) {
  return fmt::format("combined.{}.weighted", technique.name);
}

/// What `read` makes of a run in a file; nothing where there is none of that identity.
template <class Read>
auto read_run(const fs::path& path, const std::string& identity, Read&& read) -> std::optional<decltype(read(Json()))> {
  std::ifstream stream(path);
  if (!stream) return std::nullopt;
  try {
    const Json run = Json::parse(stream);
    if (run.at("identity") != identity) return std::nullopt;
    return read(run);
  } catch (const Json::exception& error) {
    throw InputError(
        fmt::format("{}: the run is damaged: {}; remove the file, and it is repeated", path.string(), error.what()));
  }
}

}  // namespace

std::string cost_json(const RunCost& cost) {
  Json all;
  for_each_counter(cost, [&](const std::string& name, const auto& number) { all[name] = number; });
  return all.dump();
}

Store::Store(fs::path folder) : folder_(std::move(folder)) {
  const std::string format = format_of(folder_);
  if (format != kFormat)
    throw InputError(
        fmt::format("{}: the runs in this folder are of format {}, and this vpm {} has format {}, whose "
                    "settings have other names: name another folder",
                    folder_.string(), format, version(), kFormat));
  make_folder(folder_ / "runs");
  make_folder(folder_ / "references");
  if (!fs::exists(folder_ / "format")) write_text(folder_ / "format", fmt::format("{}\n", kFormat));
}

fs::path Store::file(const char* kind, const std::string& identity, const std::string& extension) const {
  Fnv1a hash;
  hash.add(identity);
  return folder_ / kind / (hash.digits() + extension);
}

std::optional<std::vector<RunCost>> Store::find_run(const std::string& identity) const {
  return read_run(file("runs", identity, ".json"), identity, [](const Json& run) {
    std::vector<RunCost> costs;
    for (const Json& cost : run.at("budgets")) costs.push_back(cost_of(cost));
    return costs;
  });
}

Image Store::picture(const std::string& identity, size_t budget) const {
  return read_exr(file("runs", identity, fmt::format(".{}.exr", budget)));
}

std::string Store::chosen(const std::string& identity) const {
  const auto chosen = [](const Json& run) { return run.at("chosen").get<std::string>(); };
  return read_run(file("runs", identity, ".json"), identity, chosen).value_or("");
}

std::vector<FoundByTechnique> Store::techniques(const std::string& identity) const {
  const auto found = [](const Json& run) { return techniques_of(run.at("techniques")); };
  return read_run(file("runs", identity, ".json"), identity, found).value_or(std::vector<FoundByTechnique>());
}

std::vector<Image> Store::parts(const std::string& identity, size_t budget) const {
  const std::vector<FoundByTechnique> all = techniques(identity);
  std::vector<Image> parts;
  if (all.empty()) return parts;
  const fs::path path = file("runs", identity, fmt::format(".{}.exr", budget));
  const ExrChannels channels = read_exr_channels(path);
  for (const FoundByTechnique& technique : all) {
    std::optional<Image> part = layer_of(channels, name_of_part(technique));
    if (!part)
      throw InputError(fmt::format("{}: the run is damaged: there is no layer {}; remove its .json, and it is repeated",
                                   path.string(), name_of_part(technique)));
    parts.push_back(std::move(*part));
  }
  return parts;
}

void Store::add_run(const std::string& identity, const MethodRun& run) const {
  const std::vector<Snapshot>& snapshots = run.snapshots;
  std::string chosen;
  for (const Choice& choice : run.choices)
    chosen += fmt::format("{}{}={}", chosen.empty() ? "" : " ", choice.key, choice.value);
  Json costs = Json::array();
  for (size_t i = 0; i < snapshots.size(); ++i) {
    std::vector<ExrLayer> layers;
    if (i + 1 == snapshots.size())
      for (size_t t = 0; t < run.parts.size(); ++t) layers.push_back({name_of_part(run.techniques[t]), &run.parts[t]});
    write_exr(file("runs", identity, fmt::format(".{}.exr", i)), snapshots[i].mean, layers, {{"vpm.run", identity}});
    costs.push_back(Json::parse(cost_json(snapshots[i].cost)));
  }
  const Json finished{
      {"identity", identity}, {"chosen", chosen}, {"budgets", costs}, {"techniques", techniques_json(run.techniques)}};
  // Last: with it the run is finished.
  write_text(file("runs", identity, ".json"), finished.dump(1) + "\n");
}

std::optional<Reference> Store::find_reference(const std::string& identity) const {
  const fs::path path = file("references", identity, ".exr");
  if (!fs::exists(path)) return std::nullopt;
  const auto& metadata = read_exr_channels(path).metadata;
  const auto found = metadata.find("vpm.run");
  if (found == metadata.end() || found->second != identity) return std::nullopt;
  return read_reference(path);
}

void Store::add_reference(const std::string& identity, const Reference& reference) const {
  write_exr(file("references", identity, ".exr"), reference.mean, {{"variance", &reference.variance}},
            {{"vpm.run", identity}});
}

Reference read_reference(const fs::path& path) {
  const ExrChannels file = read_exr_channels(path);
  Reference reference{read_exr(path), Image(file.width, file.height)};
  if (file.held != PixelRect{0, 0, file.width, file.height}) reference.part = file.held;
  if (std::optional<Image> variance = layer_of(file, "variance"))
    reference.variance = std::move(*variance);
  else
    reference.doubt = "the reference has no variance";
  const auto settings = file.metadata.find("vpm.settings");
  if (settings != file.metadata.end()) {
    const std::optional<std::string> integrator = integrator_of(settings->second);
    if (!integrator) reference.doubt = "the reference does not say what estimated it";
    if (integrator == "photon-map") reference.doubt = kOfPhotons;
  }
  return reference;
}

}  // namespace vpm::tools
