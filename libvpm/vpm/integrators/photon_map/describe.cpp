// The settings of photon maps, table by table.
#include <algorithm>

#include "vpm/integrators/photon_map/integrator.h"
#include "vpm/integrators/photon_map/volume/estimators.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

using S = RenderSettings;
using G = AskedGather;

constexpr uint64_t kMostRays = 1'000'000;  // of rays at one place, and the like

void describe_guide(GuideSettings& guide, Description& d) {
  d.in("integrator.importance");
  const Members<GuideSettings> of(guide, d);
  of.add("importons", &GuideSettings::importons, Integers{0, 1'000'000'000},
         "> 0: photons go where they matter to the picture, as that many paths from the camera find in each pass. Pays "
         "where the camera sees a small part of the scene");
  if (guide.importons == 0) return;
  of.add("aim", &GuideSettings::aim, Flags{}, "emit more where photons are worth more");
  of.add("split", &GuideSettings::split, Flags{},
         "follow photons by several where they are worth more, by fewer where less");
  of.add("scatter", &GuideSettings::scatter, Flags{},
         "scatter a tenth of the photons into directions in which they are worth more. Pays where light has to find "
         "its way through an opening after it has scattered");
}

void describe_photons(PhotonSettings& photons, Description& d) {
  d.in("integrator.photons");
  const Members<PhotonSettings> of(photons, d);
  of.add("stored", &PhotonSettings::stored, Integers{}, "photons per pass and map at which tracing stops; 0: no limit");
  PhotonSettings defaults;
  if (photons.stored > 0) defaults.emitted = 0;
  Members<PhotonSettings>(photons, d, defaults)
      .add("emitted", &PhotonSettings::emitted, Integers{}, "photons per pass; 0: until the maps are full",
           {.default_text = "200000, or 0 where `stored` is above 0",
            .automatic = true,
            .keeps_default = photons.stored > 0});
  of.add("block", &PhotonSettings::block, Integers{},
         "> 0: the photons of a pass are traced, gathered and dropped in blocks of at most so many, so that memory "
         "holds one block at a time; the picture is the same, and eye rays are followed again for each block, see "
         "below; 0: all at once");
  of.add("sequence", &PhotonSettings::sequence,
         "what emission, the first flights and the first scattering of photons are drawn from: points of Sobol's "
         "sequence, scrambled anew for each pass, which lie more evenly and leave less noise in fog; or random "
         "numbers, as always where importance guides photons, caustics aim them, the nearest are gathered, or they "
         "find places for irradiance");
  of.add("in_cube", &PhotonSettings::in_cube, Integers{0, kMostRays},
         "> 0: the most photons kept in a cube of half a gather radius for each octant of directions; these take over "
         "the power of the rest");
}

constexpr const char* kRadiusOfMaps = "of the first pass, or the largest where gathers go by `count`";

void describe_gather_on_surfaces(G& gather, Description& d, const std::string& table) {
  d.in(table);
  const Members<G> of(gather, d);
  of.add("type", &G::mode, "photons within a `\"radius\"`, or the `\"nearest\"` few");
  describe_radius(gather, kRadiusOfMaps, d);
  if (gather.mode == GatherMode::nearest) of.add("count", &G::count, Integers{2, kMostRays}, "how many are nearest");
  describe_kernel(gather, d);
}

void describe_surface(G& surface, Description& d) {
  describe_gather_on_surfaces(surface, d, "integrator.surface");
  Members<G>(surface, d)
      .add(
          "boundary", &G::boundary, words_of<BoundaryRule>(2),
          "`\"corrected\"`: no dark rims at the edges of surfaces, and no light through thin walls, see below; for the "
          "caustic map, too");
}

void describe_single_scattering(SingleScatteringSettings& s, Description& d) {
  d.in("integrator.single_scattering");
  const Members<SingleScatteringSettings> of(s, d);
  of.add("type", &SingleScatteringSettings::type,
         "light that media scatter once: from `\"photons\"`, by `\"shadow-rays\"` from every step of the march, or "
         "`\"equiangular\"`, by shadow rays from a few distances of each segment of an eye ray, drawn both towards the "
         "light and by what reaches the eye. Light that scatters more than once always comes from the photon map");
  if (s.type == DirectLight::equiangular)
    of.add("samples", &SingleScatteringSettings::samples, Integers{1, kMostRays}, "how many pairs of such distances");
}

void describe_light_on_surfaces(S& s, Description& d) {
  d.in("integrator.direct");
  const Members<DirectSettings> direct(s.direct, d);
  direct.add("type", &DirectSettings::type, words_of<DirectLight>(2),
             "light on surfaces that has not scattered yet: from `\"photons\"`, or by `\"shadow-rays\"`");
  if (s.direct.type == DirectLight::shadow_rays)
    direct.add("samples", &DirectSettings::samples, Integers{1, kMostRays},
               "how many shadow rays to each lamp or sky, to places that lie evenly on it");
  d.in("integrator.indirect");
  const Members<IndirectSettings> indirect(s.indirect, d);
  indirect.add("type", &IndirectSettings::type,
               "light that surfaces scattered: from `\"photons\"`, or by `\"final-gather\"`");
  if (!s.gathers_finally()) return;
  indirect.add("rays", &IndirectSettings::rays, Integers{1, kMostRays}, "how many, at each point that the eye sees");
  indirect.add(
      "rays_by", &IndirectSettings::rays_by,
      "how they are drawn: as the `\"material\"` scatters, or up to half of them to where the `\"photons\"` nearby "
      "came from, by a map of their own. Pays where indirect light comes from one side, as out of the next room; "
      "noisier where it comes evenly from everywhere");
  indirect.add(
      "irradiance", &IndirectSettings::irradiance,
      "what they find where they end on a Lambertian surface: an `\"estimate\"` from all photons around, or one "
      "`\"precomputed\"` at the place of a photon nearby. Quicker where rays are many more than photons, and "
      "further off, see below");
  describe_gather_on_surfaces(s.caustics, d, "integrator.caustics");
  Members<CausticMapSettings>(s.caustics, d)
      .add(
          "emitted", &CausticMapSettings::emitted, Integers{},
          "> 0: that many further photons per pass, aimed at mirrors and glass for the caustic map of final gathering");
}

constexpr const char* kRadiiMeaning =
    "how gather radii go on after the first pass: `\"per-pass\"`, smaller from pass to pass, so that the average "
    "converges to the truth; `\"per-pixel\"`, on surfaces each pixel's own, smaller with the photons that it finds "
    "(stochastic progressive photon mapping), see below";

}  // namespace

void describe_photon_maps(RenderSettings& s, Description& d) {
  const Members<S> of(s, d);
  of.add("radii", &S::radii, kRadiiMeaning);
  of.add(
      "square", &S::square, Integers{1, 4},
      "the edge, in pixels, of squares in which one ray gathers photons for all that see the same, where gather radii "
      "are wide beside it, see below; 1: each ray gathers for itself");
  of.add("max_optical_step", &S::max_optical_step, Numbers{{1e-4, kNoLimit, false, true}},
         "longest step of the eye rays' march, in optical thickness; photons of homogeneous media are summed in steps "
         "of a radius where `boundary` is `\"ends\"`; with `\"beams-points\"` that of the densest place counts "
         "everywhere");
  describe_photons(s.photons, d);
  describe_guide(s.importance, d);
  // Photons are many and fly far: what a flight costs is most of their time, and null collisions cost less of it than
  // cells. Of paths and techniques combined most of the time is elsewhere (papers/distance-sampling.md).
  describe(s.distance, strategies_that(&StrategyInfo::positive), "delta-local", d.in("integrator.distance"));
  const StrategyInfo* const flights = find_strategy(s.distance.strategy);
  describe(s.volume, flights && flights->analog, d.in("integrator.volume"));
  describe_single_scattering(s.single_scattering, d);
  describe_surface(s.surface, d);
  describe_light_on_surfaces(s, d);
  describe(s.transmittance, d.in("integrator.transmittance"));
}

}  // namespace vpm
