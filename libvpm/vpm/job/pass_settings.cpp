// The settings of [render], [photons] and [importance]: which passes there are, and of how many paths they are made.
#include "vpm/job/declare.h"

namespace vpm {
namespace {

using S = RenderSettings;
using G = GuideSettings;

constexpr uint64_t kMostSamples = 1'000'000;
constexpr std::string_view kNoLayers = "none";

SettingValue get_layers(const S& s) {
  std::string joined;
  for (const ViewLayerInfo& info : kViewLayers)
    if (s.layers.has(info.layer)) joined += (joined.empty() ? "" : "+") + std::string(info.name);
  return joined.empty() ? std::string(kNoLayers) : joined;
}

void set_layers(S& s, const SettingValue& value) {
  const std::vector<std::string> words = words_in(std::get<std::string>(value));
  for (const ViewLayerInfo& info : kViewLayers)
    s.layers.set(info.layer, std::find(words.begin(), words.end(), info.name) != words.end());
}

std::vector<Setting> declare_render() {
  return {
      {.key = "render.integrator",
       .member = at<&S::integrator>(),
       .domain = words_of<Integrator>(),
       .meaning = "photon mapping, the unbiased reference path tracer, or all techniques `\"combined\"`, see below",
       .automatic = true},
      {.key = "render.passes",
       .member = at<&S::until, &StopRule::passes>(),
       .domain = Integers{1, kMostPasses},
       .meaning = "independent passes that are averaged",
       .of_passes = true},
      {.key = "render.seconds",
       .member = at<&S::until, &StopRule::seconds>(),
       .domain = Numbers{kNotNegative},
       .meaning = "> 0: passes start until this time, from the start of the process on, is over, or one more would end "
                  "at over 1.05 times it and 0.25 s; instead",
       .unit = "s",
       .of_passes = true},
      {.key = "render.error",
       .member = at<&S::until, &StopRule::error>(),
       .domain = Numbers{kNotNegative},
       .meaning = "> 0: passes start until the relative MSE is below that with a confidence of about 80 %, instead",
       .of_passes = true},
      {.key = "render.seed",
       .member = at<&S::seed>(),
       .domain = Integers{0, kAnyInteger},
       .meaning = "of all random numbers",
       .of_passes = true},
      {.key = "render.samples_per_pixel",
       .member = at<&S::samples_per_pixel>(),
       .domain = Integers{1, kMostSamples},
       .meaning = "camera rays per pixel and pass"},
      {.key = "render.max_events",
       .member = at<&S::max_events>(),
       .domain = Integers{1, 1'000'000'000},
       .meaning = "events of one path before it is cut; cuts are counted in the report"},
      {.key = "render.radii",
       .member = at<&S::radii>(),
       .domain = words_of<RadiusSchedule>(),
       .meaning = "how gather radii go on after the first pass: `\"per-pass\"`, smaller from pass to pass, so that the "
                  "average converges to the truth; `\"per-pixel\"`, on surfaces each pixel's own, smaller with the "
                  "photons that it finds (stochastic progressive photon mapping), see below"},
      {.key = "render.max_optical_step",
       .member = at<&S::max_optical_step>(),
       .domain = Numbers{{1e-4, kNoLimit, false, true}},
       .meaning =
           "longest step of the eye rays' march, in optical thickness; photons of homogeneous media are summed in "
           "steps of a radius where `boundary` is `\"ends\"`; with `\"beams-points\"` that of the densest place counts "
           "everywhere"},
      {.key = "render.layers",
       .member = {get_layers, set_layers},
       .domain = WordSet{names_of(std::span<const ViewLayerInfo>(kViewLayers)).words},
       .meaning = "layers of the picture that tell what its pixels see, see below; `--layers` does the same",
       .default_text = "none"},
  };
}

std::vector<Setting> declare_photons() {
  return {
      {.key = "photons.stored",
       .member = at<&S::photons_stored>(),
       .domain = Integers{0, kAnyInteger},
       .meaning = "photons per pass and map at which tracing stops; 0: no limit"},
      {.key = "photons.emitted",
       .member = at<&S::photons_emitted>(),
       .domain = Integers{0, kAnyInteger},
       .meaning = "photons per pass; 0: until the maps are full",
       .default_text = "200000, or 0 where `stored` is above 0",
       .automatic = true,
       .decided_by = {"photons.stored",
                      [](const S& s) -> SettingValue { return s.photons_stored > 0 ? 0 : S{}.photons_emitted; }}},
      {.key = "photons.block",
       .member = at<&S::photons_block>(),
       .domain = Integers{0, kAnyInteger},
       .meaning = "> 0: the photons of a pass are traced, gathered and dropped in blocks of at most so many, so that "
                  "memory holds one block at a time; the picture is the same, and eye rays are followed again for each "
                  "block, see below; 0: all at once"},
      {.key = "photons.sequence",
       .member = at<&S::photon_sequence>(),
       .domain = words_of<PhotonSequence>(),
       .meaning = "what emission, the first flights and the first scattering of photons are drawn from: points of "
                  "Sobol's sequence, scrambled anew for each pass, which lie more evenly and leave less noise in fog; "
                  "or random numbers, as always where importance guides photons, caustics aim them, the nearest are "
                  "gathered, or they find places for irradiance"},
      {.key = "photons.in_cube",
       .member = at<&S::photons_in_cube>(),
       .domain = Integers{0, 1'000'000},
       .meaning = "> 0: the most photons kept in a cube of half a gather radius for each octant of directions; these "
                  "take over the power of the rest"},
      {.key = "photons.flights",
       .member = at<&S::flights>(),
       .domain = Integers{0, kAnyInteger},
       .meaning =
           "with `gather = \"photon-beams\"`, `\"photon-planes\"` or `\"beams-points\"`: at most so many flights "
           "of a pass become beams, drawn evenly from all and with the power of all; 0: all"},
      {.key = "photons.planes",
       .member = at<&S::planes>(),
       .domain = Integers{1, 1'000'000},
       .meaning =
           "with `gather = \"photon-planes\"`: at most so many flights of a pass become planes, likewise; where "
           "techniques are combined: about so many, drawn by chance. Eye rays send a shadow ray for each plane that "
           "they cross"},
  };
}

std::vector<Setting> declare_importance() {
  return {
      {.key = "importance.importons",
       .member = at<&S::guide, &G::importons>(),
       .domain = Integers{0, 1'000'000'000},
       .meaning = "> 0: photons go where they matter to the picture, as that many paths from the camera tell in each "
                  "pass. Pays where the camera sees a small part of the scene"},
      {.key = "importance.aim",
       .member = at<&S::guide, &G::aim>(),
       .domain = Flags{},
       .meaning = "emit more where photons are worth more"},
      {.key = "importance.split",
       .member = at<&S::guide, &G::split>(),
       .domain = Flags{},
       .meaning = "follow photons by several where they are worth more, by fewer where less"},
      {.key = "importance.scatter",
       .member = at<&S::guide, &G::scatter>(),
       .domain = Flags{},
       .meaning = "scatter a tenth of the photons into directions in which they are worth more; needs `importons`. "
                  "Pays where light has to find its way through an opening after it has scattered"},
  };
}

}  // namespace

std::vector<Setting> pass_settings() {
  std::vector<Setting> all = declare_render();
  for (auto declare : {declare_photons, declare_importance})
    for (Setting& setting : declare()) all.push_back(std::move(setting));
  return all;
}

}  // namespace vpm
