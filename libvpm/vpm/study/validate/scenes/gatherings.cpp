// Settings for each way to gather photons, and each set of techniques.
#include "vpm/study/validate/scenes/gatherings.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace vpm {
namespace {

/// Further ways to gather flights: some of them, or as long beams; with planes, which have to find much of the light,
/// and alone find all that is scattered twice.
void append_flights(NamedSettings& all, const RenderSettings& base) {
  RenderSettings beams = base;
  beams.volume.choose("photon-beams");
  beams.volume.flights = base.photons.emitted / 2;
  all.emplace_back("photon beams of some flights", beams);
  beams.volume.flights = 0;
  beams.volume.length = BeamLength::long_beams;
  all.emplace_back("long photon beams", beams);
  beams.volume.choose("beams-points");
  all.emplace_back("long photon beams around points", beams);
  RenderSettings planes = base;
  planes.volume.choose("photon-planes");
  planes.photons.emitted = base.photons.emitted / 4;  // few, so that many of their flights become planes
  planes.volume.planes = 1000;
  all.emplace_back("photon planes and beams", planes);
  planes.volume.length = BeamLength::long_beams;
  all.emplace_back("photon planes and long beams", planes);
  planes.volume.length = BeamLength::short_beams;
  planes.volume.share = PlaneUse::alone;
  planes.single_scattering.type = DirectLight::equiangular;
  all.emplace_back("photon planes alone, single scattering equiangular", planes);
}

}  // namespace

NamedSettings forms(const RenderSettings& base, bool media) {
  NamedSettings all;
  for (const DirectLight direct : {DirectLight::photons, DirectLight::shadow_rays})
    for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon}) {
      if (!media && form == VolumeForm::density_at_photon) continue;
      RenderSettings settings = base;
      settings.single_scattering.type = settings.direct.type = direct;
      settings.volume.form = form;
      const char* name = !media                                 ? "surface map"
                         : form == VolumeForm::density_at_query ? "density at the query"
                                                                : "density at the photon";
      all.emplace_back(
          fmt::format("{}, direct light by {}", name, direct == DirectLight::photons ? "photons" : "shadow rays"),
          settings);
    }
  return all;
}

void append_combined(NamedSettings& all, const RenderSettings& base, bool media, bool surfaces, bool many) {
  using T = Technique;
  std::vector<std::vector<T>> sets{{T::connections, T::light_tracing}};
  if (surfaces && many) sets.push_back({T::connections, T::light_tracing, T::surface_merging});
  if (media) {
    sets.push_back({T::surface_merging, T::points_3d});
    sets.push_back({T::surface_merging, T::points_2d});
    sets.push_back({T::surface_merging, T::short_beams});
  } else {
    sets.push_back({T::surface_merging});
  }
  if (media && many) {
    sets.push_back({T::connections, T::light_tracing, T::points_3d});
    sets.push_back({T::connections, T::light_tracing, T::points_2d});
    sets.push_back({T::connections, T::light_tracing, T::short_beams});
    sets.push_back({T::light_tracing, T::surface_merging, T::points_3d});
    sets.push_back({T::surface_merging, T::points_3d, T::points_2d, T::short_beams});
  }
  std::vector<T> every;
  for (const TechniqueInfo& info : kTechniques) every.push_back(info.technique);
  sets.push_back(every);
  RenderSettings settings = base;
  settings.integrator = Integrator::combined;
  for (const std::vector<T>& set : sets) {
    std::string names;
    for (const TechniqueInfo& info : kTechniques) {
      const bool in = std::find(set.begin(), set.end(), info.technique) != set.end();
      settings.combined.techniques.set(info.technique, in);
      if (in) names += fmt::format("{}{}", names.empty() ? "" : ", ", info.name);
    }
    all.emplace_back("combined: " + names, settings);
  }
  if (!many) return;
  settings.combined.heuristic = Heuristic::power;
  all.emplace_back("combined by the power heuristic", settings);
  settings.combined.heuristic = Heuristic::balance;
  all.emplace_back("combined by the balance heuristic", settings);
}

NamedSettings gatherings(const RenderSettings& base, bool media, bool surfaces, bool many_sets) {
  NamedSettings all = forms(base, media);
  if (media)
    for (auto [name, settings] : forms(base, media)) {
      if (settings.single_scattering.type != DirectLight::shadow_rays) continue;
      settings.single_scattering.type = DirectLight::equiangular;
      all.emplace_back(name + ", equiangular in media", settings);
    }
  RenderSettings nearest = base;
  nearest.volume.choose("nearest");
  nearest.surface.mode = GatherMode::nearest;
  // More than lie within the radius, so that this is what bounds the search.
  nearest.volume.count = nearest.surface.count = 200'000;
  all.emplace_back("k nearest within the radius", nearest);
  if (media) {
    for (const auto& [found, type, form] :
         {std::tuple("photons around rays", "beam", VolumeForm::density_at_query),
          {"photons around rays", "beam", VolumeForm::density_at_photon},
          {"photon beams", "photon-beams", VolumeForm::density_at_query},
          {"photon beams", "photon-beams", VolumeForm::density_at_photon},
          {"photon beams around points", "beams-points", VolumeForm::density_at_query},
          {"photon beams around points", "beams-points", VolumeForm::density_at_photon}}) {
      RenderSettings beams = base;
      beams.volume.choose(type);
      beams.volume.form = form;
      const std::string name =
          fmt::format("{}, density at the {}", found, form == VolumeForm::density_at_query ? "query" : "photon");
      all.emplace_back(name, beams);
      beams.single_scattering.type = DirectLight::shadow_rays;
      all.emplace_back(name + ", single scattering by shadow rays", beams);
      beams.single_scattering.type = DirectLight::equiangular;
      all.emplace_back(name + ", single scattering equiangular", beams);
    }
    append_flights(all, base);
    RenderSettings own_radii = base;
    own_radii.volume.choose("beam");
    own_radii.volume.beam_count = 30;
    all.emplace_back("photons around rays, with radii of their own", own_radii);
  }
  RenderSettings guided = base;
  guided.importance.importons = 1'000;
  all.emplace_back("photons guided by importance", guided);
  RenderSettings only_split = guided;
  only_split.importance.aim = false;
  all.emplace_back("photons guided by importance, not aimed", only_split);
  guided.importance.scatter = true;
  all.emplace_back("photons guided by importance, where they scatter, too", guided);
  guided.importance.split = false;
  all.emplace_back("photons guided by importance, where they scatter, too, but not split", guided);
  append_combined(all, base, media, surfaces, many_sets);
  if (surfaces) {
    RenderSettings corrected = base;
    corrected.volume.boundary = corrected.surface.boundary = corrected.caustics.boundary = BoundaryRule::corrected;
    all.emplace_back("estimates corrected at borders", corrected);
    RenderSettings gathering = base;
    gathering.indirect.type = IndirectLight::final_gather;
    all.emplace_back("final gathering", gathering);
    RenderSettings guided_rays = gathering;
    guided_rays.indirect.rays_by = GatherBy::photons;
    all.emplace_back("final gathering, guided", guided_rays);
    gathering.direct.type = DirectLight::photons;
    gathering.caustics.emitted = base.photons.emitted;
    all.emplace_back("final gathering, direct light by photons, caustics aimed", gathering);
  }
  return all;
}

}  // namespace vpm
