// Lists of numbers, to files and back, and their means.
#include "compare/techniques.h"

#include <algorithm>
#include <limits>

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

}  // namespace vpm::tools
