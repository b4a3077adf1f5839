// The sections about how to render: [camera], [film], [render], [photons], [importance], [distance],
// [transmittance], [volume], [surface], [caustics].
#include <tuple>

#include "vpm/input/sections.h"

namespace vpm {
namespace {

constexpr uint64_t kMaxInteger = std::numeric_limits<int64_t>::max();  // of TOML

int small_integer(TableReader& table, const std::string& key, uint64_t hi, int fallback) {
  return static_cast<int>(table.integer(key, 1, hi, static_cast<uint64_t>(fallback)));
}

Filter read_filter(TableReader& film) {
  Filter filter;
  filter.kind = film.choice<FilterKind>(
      "filter", {{"box", FilterKind::box}, {"tent", FilterKind::tent}, {"gaussian", FilterKind::gaussian}},
      FilterKind::box);
  const float usual = filter.kind == FilterKind::box ? 0.5f : filter.kind == FilterKind::tent ? 1.0f : 1.5f;
  filter.radius = film.number("filter_radius", {0.0, 32.0, true, false}, usual);
  return filter;
}

/// A gather radius, m: kernels, 1 over its cube, must be floats; and coordinates are at most 1e9 m.
constexpr Range kRadius{1e-10, 1e9, false, false};
/// A step of a march, voxels: shorter ones would never come to an end.
constexpr Range kVoxels{1e-3, kNoLimit, false, true};
/// The same, optical thickness.
constexpr Range kOpticalStep{1e-4, kNoLimit, false, true};
constexpr Range kSamples{1e-3, 1e6, false, false};

const std::vector<std::pair<std::string, GatherMode>> kAroundPoints{{"radius", GatherMode::radius},
                                                                    {"nearest", GatherMode::nearest}};
const std::vector<std::pair<std::string, GatherMode>> kInMedia{
    {"radius", GatherMode::radius}, {"nearest", GatherMode::nearest}, {"beam", GatherMode::beam}};

void read_gather(TableReader& table, const std::vector<std::pair<std::string, GatherMode>>& modes,
                 GatherSettings& gather, bool& automatic_radius) {
  gather.mode = table.choice<GatherMode>("gather", modes, gather.mode);
  automatic_radius = table.says_auto("radius");
  if (!automatic_radius) gather.radius = table.number("radius", kRadius, gather.radius);
  const bool beams = gather.mode == GatherMode::beam;
  if (gather.mode == GatherMode::radius && table.has("count"))
    table.fail("count", "photons within a radius are not counted", "leave out 'count', or set gather = \"nearest\"");
  uint32_t& count = beams ? gather.beam_count : gather.count;
  count = static_cast<uint32_t>(table.integer("count", beams ? 0 : 2, 1'000'000, count));
  std::vector<std::pair<std::string, KernelKind>> kernels;
  for (const KernelInfo& kernel : kKernels) kernels.emplace_back(kernel.name, kernel.kind);
  gather.kernel = table.choice<KernelKind>("kernel", kernels, gather.kernel);
}

void read_boundary(TableReader& table, const RenderSettings& s, GatherSettings& gather) {
  gather.boundary = table.choice<BoundaryRule>(
      "boundary", {{"none", BoundaryRule::none}, {"corrected", BoundaryRule::corrected}}, gather.boundary);
  if (gather.boundary == BoundaryRule::corrected && s.photons_in_cube > 0)
    table.fail("boundary", "there is no correction at borders where 'in_cube' of [photons] merges photons across them",
               "leave out 'boundary', or 'in_cube'");
}

DirectLight read_direct(TableReader& table, DirectLight fallback) {
  return table.choice<DirectLight>(
      "direct", {{"photons", DirectLight::photons}, {"shadow-rays", DirectLight::shadow_rays}}, fallback);
}

/// Where single scattering comes from.
void read_volume_direct(TableReader& table, RenderSettings& s) {
  s.volume_direct = table.choice<DirectLight>("direct",
                                              {{"photons", DirectLight::photons},
                                               {"shadow-rays", DirectLight::shadow_rays},
                                               {"equiangular", DirectLight::equiangular}},
                                              s.volume_direct);
  if (table.has("direct_samples") && s.volume_direct != DirectLight::equiangular)
    table.fail("direct_samples",
               std::string("no distances are drawn for single scattering: 'direct' of [volume] is ") +
                   (s.volume_direct == DirectLight::photons ? "\"photons\"" : "\"shadow-rays\""),
               "make 'direct' \"equiangular\", or leave out 'direct_samples'");
  s.direct_samples = small_integer(table, "direct_samples", 1'000'000, s.direct_samples);
}

/// A name out of a list of strategies or estimators.
template <class Info>
std::string read_listed(TableReader& table, const std::string& key, std::span<const Info> infos,
                        const std::string& fallback) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const Info& info : infos) names.emplace_back(info.name, info.name);
  return table.choice<std::string>(key, names, fallback);
}

/// `method` names the three usual pairs of direct and indirect light.
void read_surface_light(TableReader& table, RenderSettings& s) {
  using Method = std::pair<DirectLight, IndirectLight>;
  if (table.has("method")) {
    for (const char* key : {"direct", "indirect"})
      if (table.has(key))
        table.fail(key, "'method' of [surface] says where direct and indirect light come from",
                   "leave out '" + std::string(key) + "', or 'method'");
    std::tie(s.surface_direct, s.surface_indirect) =
        table.choice<Method>("method",
                             {{"visualise", {DirectLight::photons, IndirectLight::photons}},
                              {"progressive", {DirectLight::shadow_rays, IndirectLight::photons}},
                              {"final-gather", {DirectLight::shadow_rays, IndirectLight::final_gather}}},
                             Method{s.surface_direct, s.surface_indirect});
  }
  s.surface_direct = read_direct(table, s.surface_direct);
  s.surface_indirect = table.choice<IndirectLight>(
      "indirect", {{"photons", IndirectLight::photons}, {"final-gather", IndirectLight::final_gather}},
      s.surface_indirect);
}

/// What only final gathering asks for.
void read_gathering(TableReader& table, RenderSettings& s) {
  s.gather_rays = small_integer(table, "gather_rays", 1'000'000, s.gather_rays);
  s.gather_by = table.choice<GatherBy>("gather_by", {{"material", GatherBy::material}, {"photons", GatherBy::photons}},
                                       s.gather_by);
  s.end_irradiance = table.choice<EndIrradiance>(
      "irradiance", {{"estimate", EndIrradiance::estimate}, {"precomputed", EndIrradiance::precomputed}},
      s.end_irradiance);
  if (s.end_irradiance == EndIrradiance::precomputed && s.surface.boundary == BoundaryRule::corrected)
    table.fail("irradiance", "irradiance is computed beforehand without a correction at borders",
               "write \"estimate\", or make 'boundary' \"none\"");
  if (s.surface_indirect == IndirectLight::final_gather) return;
  const auto refuse = [&](const std::string& key) {
    table.fail(key, "there are no rays to gather light: 'indirect' of [surface] is \"photons\"",
               "make 'method' \"final-gather\", or leave out '" + key + "'");
  };
  if (s.gather_by == GatherBy::photons) refuse("gather_by");
  if (s.end_irradiance == EndIrradiance::precomputed) refuse("irradiance");
}

void read_render(TableReader& table, RenderSettings& s) {
  s.integrator = table.choice<Integrator>("integrator", {{"photon", Integrator::photon}, {"path", Integrator::path}},
                                          s.integrator);
  s.passes = small_integer(table, "passes", 1'000'000'000, s.passes);
  s.seconds = table.number("seconds", kNotNegative, static_cast<float>(s.seconds));
  s.error = table.number("error", kNotNegative, static_cast<float>(s.error));
  s.seed = table.integer("seed", 0, kMaxInteger, s.seed);
  s.samples_per_pixel = small_integer(table, "samples_per_pixel", 1'000'000, s.samples_per_pixel);
  s.max_events = small_integer(table, "max_events", 1'000'000'000, s.max_events);
  s.radii = table.choice<RadiusSchedule>("radii",
                                         {{"constant", RadiusSchedule::constant},
                                          {"per-pass", RadiusSchedule::per_pass},
                                          {"per-pixel", RadiusSchedule::per_pixel}},
                                         s.radii);
  s.max_optical_step = table.number("max_optical_step", kOpticalStep, s.max_optical_step);
}

void read_photons(TableReader& table, RenderSettings& s, bool& automatic) {
  s.photons_stored = table.integer("stored", 0, kMaxInteger, s.photons_stored);
  automatic = table.says_auto("emitted");
  if (!automatic)
    s.photons_emitted = table.integer("emitted", 0, kMaxInteger, s.photons_stored > 0 ? 0 : s.photons_emitted);
  s.photons_in_cube = static_cast<uint32_t>(table.integer("in_cube", 0, 1'000'000, s.photons_in_cube));
  if (s.photons_emitted == 0 && s.photons_stored == 0)
    table.fail("emitted", "no photon would be emitted: 'emitted' and 'stored' are both 0", "make one of them positive");
  if (s.photons_in_cube > 0 && s.radii == RadiusSchedule::per_pixel)
    table.fail("in_cube", "where render.radii is \"per-pixel\" photons are counted, so that none may be merged",
               "write 0, or other radii");
}

/// Radii of pixels' own are those of gathers by radius, straight from the map of single photons.
void check_radii_of_pixels(TableReader& surface, const RenderSettings& s) {
  const std::string pixels = "where render.radii is \"per-pixel\" ";
  if (s.surface.mode != GatherMode::radius)
    surface.fail("gather", pixels + "surfaces gather by radius", "write \"radius\", or other radii");
  if (s.surface_indirect == IndirectLight::final_gather)
    surface.fail(surface.has("method") ? "method" : "indirect", pixels + "there is no final gathering",
                 "take indirect light from \"photons\", or write other radii");
  if (s.surface.boundary == BoundaryRule::corrected)
    surface.fail("boundary", pixels + "the photons found tell the radius, so that none may be left out at borders",
                 "write \"none\", or other radii");
}

/// The strategies for which that is true.
Names strategies_that(bool StrategyInfo::*is) {
  Names names;
  for (const StrategyInfo& info : distance_strategies())
    if (info.*is) names.emplace_back(info.name);
  return names;
}

/// The strategy; of "auto" the default.
std::string read_strategy(TableReader& table, const std::string& usual, bool& automatic) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const StrategyInfo& info : distance_strategies()) names.emplace_back(info.name, info.name);
  names.emplace_back(kAuto, kAuto);
  const std::string name = table.choice<std::string>("strategy", names, usual);
  automatic = name == kAuto;
  return automatic ? usual : name;
}

void read_distance(TableReader& table, RenderSettings& s, bool has_grid, bool& automatic) {
  DistanceSettings& distance = s.distance;
  distance.strategy = read_strategy(table, distance.strategy, automatic);
  distance.step = table.number("step", kVoxels, distance.step);
  distance.optical_step = table.number("optical_step", kOpticalStep, distance.optical_step);
  distance.majorant = table.number("majorant", {1e-6, 1.0, false, false}, distance.majorant);
  distance.extinction_floor = table.number("extinction_floor", kPositive, distance.extinction_floor);
  const StrategyInfo& info = strategy_info(distance.strategy);
  if (has_grid && !info.heterogeneous)
    table.fail("strategy", "the strategy '" + distance.strategy + "' is wrong in a grid medium, and the scene has one",
               suggest(distance.strategy, strategies_that(&StrategyInfo::heterogeneous), "right in grids"));
  if (s.integrator == Integrator::photon && !info.positive)
    table.fail(
        "strategy",
        "the strategy '" + distance.strategy + "' gives weights below 0, which the power of photons must not have",
        "write integrator = \"path\" in [render], or use another strategy; " +
            suggest(distance.strategy, strategies_that(&StrategyInfo::positive), "right for photons"));
}

void read_transmittance(TableReader& table, TransmittanceSettings& transmittance, bool used) {
  const std::string exact = transmittance.estimator;
  transmittance.estimator = read_listed(table, "estimator", transmittance_estimators(), exact);
  transmittance.step = table.number("step", kVoxels, transmittance.step);
  transmittance.samples = table.number("samples", kSamples, transmittance.samples);
  if (!used && transmittance.estimator != exact)
    table.fail("estimator", "nothing asks '" + transmittance.estimator + "': shadow rays do, and none are cast",
               "write direct = \"shadow-rays\" in [volume] or [surface] of what scatters, or leave out 'estimator'");
}

/// Reads a section if the file has it.
template <class Read>
void read_section(TableReader& root, const std::string& key, Read read) {
  std::optional<TableReader> table = root.table(key, "[" + key + "]");
  if (!table) return;
  read(*table);
  table->finish();
}

}  // namespace

Camera read_camera(TableReader& camera, std::optional<TableReader>& film) {
  const Vec3 position = camera.vector("position");
  const Vec3 target = camera.vector("target");
  const Vec3 up = camera.direction("up", Vec3(0.0f, 1.0f, 0.0f));
  const float fov = camera.number("fov", {0.0, 180.0, true, true}, 40.0f);
  const Vec3d forward = Vec3d(target) - Vec3d(position);
  if (glm::length(forward) == 0.0) camera.fail("target", "the camera's target is its position");
  if (!(glm::length(glm::cross(glm::normalize(forward), Vec3d(up))) > 1e-6))
    camera.fail(camera.has("up") ? "up" : "target", "the camera looks along its 'up' vector",
                "give it an 'up' that points elsewhere");
  int width = 512, height = 512;
  Filter filter;
  if (film) {
    width = small_integer(*film, "width", 32768, width);
    height = small_integer(*film, "height", 32768, height);
    filter = read_filter(*film);
    film->finish();
  }
  return make_camera(position, target, up, fov, width, height, filter);
}

RenderSettings read_settings(TableReader& root, const SceneContents& contents, AutomaticSettings& automatic) {
  RenderSettings s;
  read_section(root, "render", [&](TableReader& table) { read_render(table, s); });
  read_section(root, "photons", [&](TableReader& table) { read_photons(table, s, automatic.photons); });
  read_section(root, "importance", [&](TableReader& table) {
    s.guide.importons = table.integer("importons", 0, 1'000'000'000, s.guide.importons);
    s.guide.aim = table.flag("aim", s.guide.aim);
    s.guide.split = table.flag("split", s.guide.split);
    s.guide.scatter = table.flag("scatter", s.guide.scatter);
    if (s.guide.scatter && s.guide.importons == 0)
      table.fail("scatter", "nothing tells photons where to scatter: 'importons' of [importance] is 0",
                 "make 'importons' positive, or leave out 'scatter'");
  });
  read_section(root, "distance",
               [&](TableReader& table) { read_distance(table, s, contents.grids, automatic.strategy); });
  read_section(root, "volume", [&](TableReader& table) {
    read_gather(table, kInMedia, s.volume, automatic.volume_radius);
    s.volume_form = table.choice<VolumeForm>(
        "form",
        {{"density-at-query", VolumeForm::density_at_query}, {"density-at-photon", VolumeForm::density_at_photon}},
        s.volume_form);
    read_boundary(table, s, s.volume);
    if (s.volume.boundary == BoundaryRule::corrected && s.volume_form == VolumeForm::density_at_photon)
      table.fail("boundary",
                 "there is no correction at borders for 'density-at-photon', which counts photons from outside",
                 "use form = \"density-at-query\", or leave out 'boundary'");
    if (s.volume.boundary == BoundaryRule::corrected && s.volume.mode == GatherMode::beam)
      table.fail("boundary", "there is no correction at borders for \"beam\", which gathers along whole rays",
                 "use gather = \"radius\", or leave out 'boundary'");
    s.density_floor = table.number("density_floor", kFraction, s.density_floor);
    read_volume_direct(table, s);
  });
  read_section(root, "surface", [&](TableReader& table) {
    read_gather(table, kAroundPoints, s.surface, automatic.surface_radius);
    read_boundary(table, s, s.surface);
    s.caustics.boundary = s.surface.boundary;
    read_surface_light(table, s);
    read_gathering(table, s);
    if (s.radii == RadiusSchedule::per_pixel) check_radii_of_pixels(table, s);
  });
  read_section(root, "caustics", [&](TableReader& table) {
    read_gather(table, kAroundPoints, s.caustics, automatic.caustic_radius);
    s.caustics_emitted = table.integer("emitted", 0, kMaxInteger, s.caustics_emitted);
  });
  const bool shadow_rays = casts_shadow_rays(contents.scattering, s);
  read_section(root, "transmittance",
               [&](TableReader& table) { read_transmittance(table, s.transmittance, shadow_rays); });
  return s;
}

}  // namespace vpm
