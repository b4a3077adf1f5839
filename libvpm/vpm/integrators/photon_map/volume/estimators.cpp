// The list of estimators of the light of media, and what several of them have.
#include "vpm/integrators/photon_map/volume/estimators.h"

#include <algorithm>
#include <stdexcept>

#include "vpm/integrators/words.h"

namespace vpm {

extern const VolumeEstimatorInfo kPointsInRadius, kNearestPoints, kBeamRadiance, kPhotonBeams, kPhotonPlanes,
    kBeamsAroundPoints;

std::span<const VolumeEstimatorInfo> volume_estimators() {
  static const std::vector<VolumeEstimatorInfo> all{kPointsInRadius, kNearestPoints, kBeamRadiance,
                                                    kPhotonBeams,    kPhotonPlanes,  kBeamsAroundPoints};
  return all;
}

VolumeSettings::VolumeSettings(std::string_view type, const AskedGather& gather) : AskedGather(gather) { choose(type); }

const VolumeEstimatorInfo& VolumeSettings::info() const {
  const auto all = volume_estimators();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const VolumeEstimatorInfo& info) { return info.name == type_; });
  if (found == all.end()) throw std::invalid_argument("there is no estimator '" + type_ + "' of the light of media");
  return *found;
}

void VolumeSettings::choose(std::string_view type) {
  type_ = type;
  mode = info().mode;
  beam_count = 0;
}

VolumeSettings along_rays(VolumeSettings settings) {
  if (settings.boundary == BoundaryRule::corrected) settings.boundary = BoundaryRule::ends;
  return settings;
}

namespace {

std::string meaning_of_types() {
  std::string text = "how photons are gathered:";
  for (const VolumeEstimatorInfo& info : volume_estimators())
    text += (text.back() == ':' ? " `\"" : "; `\"") + std::string(info.name) + "\"`: " + std::string(info.summary);
  return text;
}

void describe_type(VolumeSettings& settings, Description& description) {
  description.add("type", {{.automatic = true, .keeps_default = true},
                           "",
                           meaning_of_types(),
                           Words{names_of(volume_estimators())},
                           VolumeSettings().type(),
                           [&settings] { return SettingValue(settings.type()); },
                           [&settings](const SettingValue& value) { settings.choose(std::get<std::string>(value)); }});
}

}  // namespace

void describe_radius(AskedGather& gather, const char* meaning, Description& description) {
  // Kernels, 1 over the cube of the radius, must be floats; and coordinates are at most 1e9 m.
  Members<AskedGather>(gather, description)
      .add("radius", &AskedGather::radius, Numbers{{1e-10, 1e9, false, false}}, meaning,
           {.unit = "m",
            .default_text = "goes by where photons lie, see above",
            .automatic = true,
            .default_chosen = true});
}

void describe_kernel(AskedGather& gather, Description& description) {
  Members<AskedGather>(gather, description)
      .add("kernel", &AskedGather::kernel,
           "how photons weigh less farther away; `\"order-4\"` has a negative rim, a bias of the fourth power of the "
           "radius, and more noise, see below");
}

void describe_density_floor(VolumeSettings& settings, Description& description) {
  Members<VolumeSettings>(settings, description)
      .add("density_floor", &VolumeSettings::density_floor, Numbers{kFraction},
           "for `density-at-query`: where a grid's density is below this fraction of its largest (or of its mean, if "
           "that is less), photons are also stored along their flights, so that none weighs more than 1/floor: no "
           "bright specks, and no bias. Not with strategies whose photons do not weigh 1/density. 0: at collisions "
           "alone");
}

void describe_flights(VolumeSettings& settings, Description& description) {
  const Members<VolumeSettings> of(settings, description);
  of.add("length", &VolumeSettings::length,
         "a beam is a photon's flight, `\"short\"`, or goes on to where the ray leaves the medium, `\"long\"`, and "
         "counts with the transmittance: less noise in thin media; more time, most of all in grids");
  of.add("flights", &VolumeSettings::flights, Integers{},
         "at most so many flights of a pass become beams, drawn evenly from all and with the power of all; 0: all");
}

void describe(VolumeSettings& settings, bool photons_weigh, Description& description) {
  describe_type(settings, description);
  describe_radius(settings, "of the first pass, or the largest where gathers go by `count`", description);
  describe_kernel(settings, description);
  Members<VolumeSettings>(settings, description)
      .add("form", &VolumeSettings::form,
           "where the scattering coefficient is taken: `\"density-at-query\"` is sharp, `\"density-at-photon\"` bounds "
           "weights, see below");
  Members<AskedGather>(settings, description, VolumeSettings())
      .add("boundary", &AskedGather::boundary,
           "against dark rims at the borders of media: `\"ends\"` lets photons past the ends of a segment of the eye's "
           "ray make up for those missing before them; `\"corrected\"` corrects ball by ball, and lets no light "
           "through thin walls, but is the same as `\"ends\"` for gathers along rays and of flights, see below");
  if (photons_weigh && settings.info().collisions) describe_density_floor(settings, description);
  if (settings.info().describe) settings.info().describe(settings, description);
}

}  // namespace vpm
