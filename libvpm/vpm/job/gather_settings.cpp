// The settings of [volume], [surface] and [caustics]: how photons are gathered, and what light comes from elsewhere.
#include "vpm/job/declare.h"

namespace vpm {
namespace {

using S = RenderSettings;

constexpr uint64_t kMostRays = 1'000'000;

void append(std::vector<Setting>& all, std::vector<Setting> more) {
  for (Setting& setting : more) all.push_back(std::move(setting));
}

std::string not_counted(const S&) { return "photons within a radius are not counted"; }
constexpr std::string_view kCountInstead = "leave out 'count', or set gather = \"nearest\"";
constexpr std::string_view kCountInMedia = "leave out 'count', or set gather = \"nearest\" or \"beam\"";

/// How photons are gathered from the map of a section, whose settings are the member `Gather`.
template <auto Gather>
std::vector<Setting> declare_gather(const std::string& section, bool in_media) {
  using G = AskedGather;
  return {
      {.key = section + ".gather",
       .member = at<Gather, &G::mode>(),
       .domain = words_of<GatherMode>(in_media ? 6 : 2),
       .meaning =
           in_media
               ? "photons within a `\"radius\"`, or the `\"nearest\"` few, or by `\"beam\"` those within "
                 "the radius of a whole stretch of the eye's ray, in one query; `\"photon-beams\"`: all flights of "
                 "photons that pass it within the radius, and the photons beside it where flights run along it; "
                 "`\"photon-planes\"`: these, and planes without a radius for light that media scatter twice in "
                 "turn; `\"beams-points\"`: flights within the radius of points of a march"
               : "photons within a `\"radius\"`, or the `\"nearest\"` few",
       .automatic = in_media,
       .left_out = {true}},
      {.key = section + ".radius",
       .member = at<Gather, &G::radius>(),
       // Kernels, 1 over its cube, must be floats; and coordinates are at most 1e9 m.
       .domain = Numbers{{1e-10, 1e9, false, false}},
       .meaning = "of the first pass, or the largest where gathers go by `count`",
       .unit = "m",
       .default_text = "goes by where photons lie, see above",
       .automatic = true,
       .usually_chosen = true},
      {.key = section + ".count",
       .member = at<Gather, &G::count>(),
       .domain = Integers{2, 1'000'000},
       .meaning = "how many are nearest; refused with `\"radius\"`, which counts none",
       .need = {[](const S& s) { return (s.*Gather).mode == GatherMode::nearest; }, not_counted,
                in_media ? kCountInMedia : kCountInstead}},
      {.key = section + ".kernel",
       .member = at<Gather, &G::kernel>(),
       .domain = words_of<KernelKind>(),
       .meaning =
           "how photons weigh less farther away; `\"order-4\"` has a negative rim, a bias of the fourth power of "
           "the radius, and more noise, see below"},
  };
}

Setting declare_beam_count() {
  return {.key = "volume.count",
          .member = at<&S::volume, &AskedGather::beam_count>(),
          .domain = Integers{0, 1'000'000},
          .meaning =
              "with `\"beam\"`, where > 0: each photon has a radius of its own, of a ball of about so many "
              "photons, from a hundredth of `radius` to `radius`",
          .need = {[](const S& s) { return s.volume.mode == GatherMode::beam; }, not_counted, kCountInMedia}};
}

constexpr const char* kBorders =
    "against dark rims at the borders of media: `\"ends\"` lets photons past the ends of a stretch of the eye's ray "
    "make up for those missing before them; `\"corrected\"` corrects ball by ball, and lets no light through thin "
    "walls, but is the same as `\"ends\"` for gathers along rays and of flights, see below";
constexpr const char* kEdges =
    "`\"corrected\"`: no dark rims at the edges of surfaces, and no light through thin walls, see below; for the "
    "caustic map, too";

std::vector<Setting> declare_volume() {
  return {
      {.key = "volume.form",
       .member = at<&S::volume_form>(),
       .domain = words_of<VolumeForm>(),
       .meaning = "where the scattering coefficient is taken: `\"density-at-query\"` is sharp, `\"density-at-photon\"` "
                  "bounds weights, see below"},
      {.key = "volume.boundary",
       .member = at<&S::volume, &AskedGather::boundary>(),
       .domain = words_of<BoundaryRule>(),
       .meaning = kBorders},
      {.key = "volume.density_floor",
       .member = at<&S::density_floor>(),
       .domain = Numbers{kFraction},
       .meaning = "for `density-at-query`: where a grid's density is below this fraction of its largest (or of its "
                  "mean, if that is less), photons are also stored along their flights, so that none weighs more than "
                  "1/floor: no bright specks, and no bias. Not with `\"local-extinction\"` and "
                  "`\"mean-extinction\"`, whose photons do not weigh 1/density. 0: at collisions alone"},
      {.key = "volume.direct",
       .member = at<&S::volume_direct>(),
       .domain = words_of<DirectLight>(),
       .meaning = "light that scatters once: from `\"photons\"`, by `\"shadow-rays\"` from every step of the march, or "
                  "`\"equiangular\"`, by shadow rays from a few distances of each stretch of an eye ray, drawn both "
                  "towards the light and by what reaches the eye. Light that scatters more than once always comes from "
                  "the photon map"},
      {.key = "volume.beams",
       .member = at<&S::beam_length>(),
       .domain = words_of<BeamLength>(),
       .meaning = "with `\"photon-beams\"`, `\"photon-planes\"` and `\"beams-points\"`: a beam is a photon's flight, "
                  "`\"short\"`, or goes on to where the ray leaves the medium, `\"long\"`, and counts with the "
                  "transmittance: less noise in thin media; more time, most of all in grids",
       .need = {[](const S& s) { return s.volume.gathers_flights(); },
                [](const S&) { return std::string("there are no beams: 'gather' of [volume] asks for none"); },
                "leave out 'beams', or write gather = \"photon-beams\""}},
      {.key = "volume.planes",
       .member = at<&S::plane_use>(),
       .domain = words_of<PlaneUse>(),
       .meaning =
           "with `\"photon-planes\"`: light that planes can find is `\"combined\"` from them and beams; or comes "
           "from planes `\"alone\"`, without any bias but of infinite variance, for study",
       .need = {[](const S& s) { return s.volume.mode == GatherMode::photon_planes; },
                [](const S&) { return std::string("there are no planes: 'gather' of [volume] asks for none"); },
                "leave out 'planes', or write gather = \"photon-planes\""}},
      {.key = "volume.direct_samples",
       .member = at<&S::direct_samples>(),
       .domain = Integers{1, kMostRays},
       .meaning = "how many pairs of such distances; needs `\"equiangular\"`",
       .need = {[](const S& s) { return s.volume_direct == DirectLight::equiangular; },
                [](const S& s) {
                  return "no distances are drawn for single scattering: 'direct' of [volume] is \"" +
                         word_of(s.volume_direct) + "\"";
                },
                "make 'direct' \"equiangular\", or leave out 'direct_samples'"}},
  };
}

/// The usual pairs of direct and indirect light.
struct Method {
  std::string_view name;
  DirectLight direct;
  IndirectLight indirect;
};
constexpr std::array<Method, 3> kMethods{{{"visualise", DirectLight::photons, IndirectLight::photons},
                                          {"progressive", DirectLight::shadow_rays, IndirectLight::photons},
                                          {"final-gather", DirectLight::shadow_rays, IndirectLight::final_gather}}};

/// "" for another pair.
SettingValue get_method(const S& s) {
  for (const Method& method : kMethods)
    if (method.direct == s.surface_direct && method.indirect == s.surface_indirect) return std::string(method.name);
  return std::string();
}

void set_method(S& s, const SettingValue& value) {
  for (const Method& method : kMethods)
    if (method.name == std::get<std::string>(value)) {
      s.surface_direct = method.direct;
      s.surface_indirect = method.indirect;
    }
}

void set_boundary(S& s, const SettingValue& value) {
  set_member<&S::surface, &AskedGather::boundary>(s, value);
  s.caustics.boundary = s.surface.boundary;
}

std::vector<Setting> declare_surface_light() {
  return {
      {.key = "surface.boundary",
       .member = {get_member<&S::surface, &AskedGather::boundary>, set_boundary},
       .domain = words_of<BoundaryRule>(2),
       .meaning = kEdges},
      {.key = "surface.method",
       .member = {get_method, set_method},
       .domain = names_of(std::span<const Method>(kMethods)),
       .meaning = "`direct` and `indirect` in one, see below",
       .stands_for = {"surface.direct", "surface.indirect"}},
      {.key = "surface.direct",
       .member = at<&S::surface_direct>(),
       .domain = words_of<DirectLight>(2),
       .meaning = "light that has not scattered yet: from `\"photons\"`, or by `\"shadow-rays\"`"},
      {.key = "surface.direct_samples",
       .member = at<&S::surface_direct_samples>(),
       .domain = Integers{1, kMostRays},
       .meaning = "how many shadow rays to each lamp or sky, to places that lie evenly on it; needs "
                  "`\"shadow-rays\"`",
       .need = {
           [](const S& s) { return s.surface_direct == DirectLight::shadow_rays; },
           [](const S&) { return std::string("no rays are sent to lights: 'direct' of [surface] is \"photons\""); },
           "make 'direct' \"shadow-rays\", or leave out 'direct_samples'"}},
      {.key = "surface.indirect",
       .member = at<&S::surface_indirect>(),
       .domain = words_of<IndirectLight>(),
       .meaning = "light that surfaces scattered: from `\"photons\"`, or by `\"final-gather\"`"},
  };
}

std::vector<Setting> declare_final_gathering() {
  return {
      {.key = "surface.gather_rays",
       .member = at<&S::gather_rays>(),
       .domain = Integers{1, kMostRays},
       .meaning = "of final gathering, at each point that the eye sees"},
      {.key = "surface.gather_by",
       .member = at<&S::gather_by>(),
       .domain = words_of<GatherBy>(),
       .meaning = "how final gathering draws them: as the `\"material\"` scatters, or up to half of them to where the "
                  "`\"photons\"` nearby came from, by a map of their own. Pays where indirect light comes from one "
                  "side, as out of the next room; noisier where it comes evenly from everywhere"},
      {.key = "surface.irradiance",
       .member = at<&S::end_irradiance>(),
       .domain = words_of<EndIrradiance>(),
       .meaning = "what they find where they end on a Lambertian surface: an `\"estimate\"` from all photons around, "
                  "or one `\"precomputed\"` at the place of a photon nearby. Quicker where rays are many more than "
                  "photons, and further off, see below"},
  };
}

Setting declare_aimed_photons() {
  return {.key = "caustics.emitted",
          .member = at<&S::caustics_emitted>(),
          .domain = Integers{0, kAnyInteger},
          .meaning =
              "> 0: that many further photons per pass, aimed at mirrors and glass for the caustic "
              "map of final gathering"};
}

}  // namespace

std::vector<Setting> gather_settings() {
  std::vector<Setting> all = declare_gather<&S::volume>("volume", true);
  all.push_back(declare_beam_count());
  append(all, declare_volume());
  append(all, declare_gather<&S::surface>("surface", false));
  append(all, declare_surface_light());
  append(all, declare_final_gathering());
  append(all, declare_gather<&S::caustics>("caustics", false));
  all.push_back(declare_aimed_photons());
  return all;
}

}  // namespace vpm
