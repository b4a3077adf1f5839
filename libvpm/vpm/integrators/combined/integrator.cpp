// All techniques combined as an integrator.
#include "vpm/integrators/integrator.h"

#include <fmt/format.h>

#include <memory>

#include "vpm/base/settings/setting_error.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/combined/technique_layers.h"
#include "vpm/integrators/photon_map/volume/estimators.h"
#include "vpm/integrators/stages.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

constexpr const char* kRadiusOfMerges = "of merges, in the first pass";

/// Strategies whose flights have the density that the transmittance says.
std::vector<std::string> strategies_of_known_density() {
  std::vector<std::string> names;
  for (const StrategyInfo& info : distance_strategies())
    if (info.analog && info.unbiased) names.emplace_back(info.name);
  return names;
}

void describe_combined(RenderSettings& s, Description& d) {
  Members<CombinedSettings> of(s.combined, d);
  of.add_set("techniques", &CombinedSettings::techniques, std::span<const TechniqueInfo>(kTechniques),
             &TechniqueInfo::technique, "which techniques find light; what none of them can find is missing",
             {.default_text = "all", .automatic = true});
  of.add("heuristic", &CombinedSettings::heuristic,
         "how techniques share a path that several find: by their densities, by the squares of these, or by densities "
         "where eye sub-paths end at the first place that does not only mirror or refract, if merges find all light "
         "there: merges beyond it share its noise");
  of.add("layers", &CombinedSettings::layers, Flags{},
         "writes what each technique finds, too: layers `combined.NAME.weighted` and `combined.NAME.unweighted` "
         "(`--layers combined` does the same)");
  const Members<RenderSettings> own(s, d);
  own.add("radii", &RenderSettings::radii, words_of<RadiusSchedule>(2),
          "how the radii of merges go on after the first pass");
  d.in("integrator.photons");
  const Members<PhotonSettings> photons(s.photons, d);
  photons.add("emitted", &PhotonSettings::emitted, Integers{1}, "light sub-paths per pass", {.automatic = true});
  photons.add("sequence", &PhotonSettings::sequence, "what they are drawn from, as for photon maps");
  describe(s.distance, strategies_of_known_density(), "regular", d.in("integrator.distance"));
  d.in("integrator.volume");
  describe_radius(s.volume, kRadiusOfMerges, d);
  describe_kernel(s.volume, d);
  describe_density_floor(s.volume, d);
  d.in("integrator.surface");
  describe_radius(s.surface, kRadiusOfMerges, d);
  describe_kernel(s.surface, d);
}

void check_combined(const RenderSettings& s, const SceneFacts& facts) {
  const TechniqueSet& techniques = s.combined.techniques;
  const bool without_beams = techniques.has(Technique::connections) || techniques.has(Technique::points_2d);
  refuse_if(facts.emitting_media && techniques.has(Technique::short_beams) && !without_beams, "integrator.techniques",
            "first flights from media that emit are not kept as beams: what they bring to media would be lost",
            "add \"connections\" or \"points-2d\"");
  refuse_if(facts.endless_flights && techniques.has(Technique::short_beams), "integrator.techniques",
            "flights have no end in a channel that the medium of the world does not attenuate",
            "leave out \"short-beams\", or put the scene into a box of the medium");
}

PassMaker passes_of_combined(const Scene& scene, const RenderSettings& settings) {
  const auto make = [&scene, &settings](int pass, const RenderResult&, const PassProgress& progress) {
    return render_combined_pass(scene, settings, pass, progress);
  };
  return {make, tile_count(scene.camera)};
}

RaysOfPass rays_of_combined(const Scene& scene, const RenderSettings& settings, int pass) {
  const auto ready = std::make_shared<const CombinedPass>(scene, settings, pass);
  RaysOfPass rays{[ready](std::span<EyeRay> of) { ready->radiance(of); },
                  Image(scene.camera.width, scene.camera.height), ready->statistics()};
  ready->add_light_tracing(rays.light_tracing);
  return rays;
}

/// Those that are used without asking; without beams, which cost most and find nothing where there are no media; and
/// without light tracing, whose shadow rays may cost more than they are worth.
std::vector<Way> ways_of_combined(const Scene& scene, const AutomaticSettings& automatic, const Way& given) {
  const bool open = automatic.has("integrator.type") || automatic.has("integrator.techniques");
  if (!open || given.settings.combined.techniques != TechniqueSet()) return {given};
  Way no_beams = given;
  no_beams.settings.combined.techniques.set(Technique::short_beams, false);
  no_beams.name += " without short-beams";
  Way fewest = no_beams;
  fewest.settings.combined.techniques.set(Technique::light_tracing, false);
  fewest.name += " and light-tracing";
  if (!facts_of(scene).scattering_media) return {fewest, no_beams};
  return {fewest, no_beams, given};
}

double power_of_noise_of_merges(const RenderSettings& settings) {
  if (!merges(settings.combined.techniques)) return 0.0;
  return settings.combined.techniques.has(Technique::short_beams) ? 1.0 : 2.0;
}

std::vector<std::string> stages_of_combined(const Scene& scene, const RenderSettings& settings, const SceneFacts&) {
  std::vector<std::string> lines{"runs sub-paths from the lights and from the eye" + distances_text(settings)};
  for (const TechniqueInfo& info : kTechniques)
    lines.push_back(fmt::format("{} {}: {}", settings.combined.techniques.has(info.technique) ? "runs" : "skips",
                                info.name, info.summary));
  lines.push_back(channels_text(scene));
  return lines;
}

}  // namespace

extern const IntegratorInfo kCombined;
const IntegratorInfo kCombined{
    .describe = describe_combined,
    .check = check_combined,
    .passes = passes_of_combined,
    .rays = rays_of_combined,
    .gathers = [](const Scene&, const RenderSettings& settings) { return merges(settings.combined.techniques); },
    .stages = stages_of_combined,
    .layers = layers_of_techniques,
    .ways = ways_of_combined,
    .power_of_noise = power_of_noise_of_merges,
};

}  // namespace vpm
