// The settings of [combined]: which techniques there are, and how they share paths.
#include "vpm/job/declare.h"

namespace vpm {
namespace {

using S = RenderSettings;
using C = CombinedSettings;

SettingValue get_techniques(const S& s) {
  std::string joined;
  for (const TechniqueInfo& info : kTechniques)
    if (s.combined.techniques.has(info.technique)) joined += (joined.empty() ? "" : "+") + std::string(info.name);
  return joined;
}

void set_techniques(S& s, const SettingValue& value) {
  const std::vector<std::string> words = words_in(std::get<std::string>(value));
  for (const TechniqueInfo& info : kTechniques)
    s.combined.techniques.set(info.technique, std::find(words.begin(), words.end(), info.name) != words.end());
}

bool combines(const S& s) { return s.integrator == Integrator::combined; }
std::string combines_nothing(const S& s) {
  return "no techniques are combined: 'integrator' of [render] is \"" + word_of(s.integrator) + "\"";
}
constexpr std::string_view kCombine = "leave out [combined], or write integrator = \"combined\" in [render]";

}  // namespace

std::vector<Setting> combined_settings() {
  return {
      {.key = "combined.techniques",
       .member = {get_techniques, set_techniques},
       .domain = WordSet{names_of(std::span<const TechniqueInfo>(kTechniques)).words},
       .meaning = "which techniques find light; what none of them can find is missing",
       .default_text = "all but `\"long-beams\"` and `\"planes\"`",
       .automatic = true,
       .left_out = {true, "render.integrator", "combined"},
       .need = {combines, combines_nothing, kCombine}},
      {.key = "combined.heuristic",
       .member = at<&S::combined, &C::heuristic>(),
       .domain = words_of<Heuristic>(),
       .meaning =
           "how techniques share a path that several find: by their densities, by the squares of these, or by "
           "densities where eye sub-paths end at the first place that does not only mirror or refract, if merges "
           "find all light there: merges beyond it share its noise",
       .need = {combines, combines_nothing, kCombine}},
      {.key = "combined.layers",
       .member = at<&S::combined, &C::layers>(),
       .domain = Flags{},
       .meaning =
           "writes what each technique finds, too: layers `combined.NAME.weighted` and `combined.NAME.unweighted` "
           "(`--layers combined` does the same)",
       .need = {combines, combines_nothing, kCombine}},
  };
}

}  // namespace vpm
