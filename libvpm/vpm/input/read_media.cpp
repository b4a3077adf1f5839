// The section [media.*]: coefficients, phase functions, grids.
#include "vpm/input/phase_file.h"
#include "vpm/input/sections.h"
#include "vpm/medium/measured.h"

namespace vpm {
namespace {

std::shared_ptr<const PhaseTable> read_phase_table(TableReader& table) {
  const std::string path = table.path("path");
  try {
    return load_phase_table(path);
  } catch (const InputError& error) {
    table.fail("path", error.what());
  }
}

Phase read_phase(TableReader& medium) {
  std::optional<TableReader> table = medium.table("phase", "'phase' of " + medium.title());
  if (!table) return Isotropic{};
  std::vector<std::pair<std::string, Phase>> kinds;
  for_each_phase([&](const auto& kind) { kinds.emplace_back(kind.kName, kind); });
  Phase phase = table->choice<Phase>("type", kinds);
  const auto read_numbers = [&](auto& kind) {
    for (const auto& number : kind.numbers())
      kind.*number.member = table->number(std::string(number.name), number.range);
    if constexpr (requires { kind.fit(); }) kind.fit();
    if constexpr (requires { kind.table; }) kind.table = read_phase_table(*table);
  };
  std::visit(read_numbers, phase);
  table->finish();
  return phase;
}

void read_measured(TableReader& table, Medium& medium) {
  constexpr double kPerMetre = 1000.0;  // of 1/mm
  const std::string name = table.string("measured");
  const MeasuredMedium* measured = find_measured_medium(name);
  if (!measured) {
    Names known;
    for (const MeasuredMedium& m : measured_media()) known.emplace_back(m.name);
    table.fail("measured", "there is no measured medium '" + name + "'", suggest(name, known, "measured are"));
  }
  const double scale = table.number("scale", kPositive, 1.0f) * kPerMetre;
  medium.sigma_s = Rgb(scale * measured->reduced_sigma_s);
  medium.sigma_t = Rgb(scale * (measured->reduced_sigma_s + measured->sigma_a));
  if (!std::holds_alternative<Isotropic>(medium.phase))
    table.fail("phase",
               "measured coefficients are reduced ones, (1 - g) sigma_s: they go with an isotropic phase function only",
               "remove the phase function, or give sigma_s and sigma_a");
}

void read_coefficients(TableReader& table, bool grid, Medium& medium) {
  const bool measured = table.has("measured");
  const bool sigma_s = table.has("sigma_s"), sigma_a = table.has("sigma_a");
  const bool sigma_t = table.has("sigma_t"), albedo = table.has("albedo");
  const bool separate = sigma_s || sigma_a, total = sigma_t || albedo;
  if (measured + separate + total != 1) {
    const std::string wrong =
        measured + separate + total == 0 ? " has no coefficients" : " gives its coefficients in two ways";
    table.fail_here(table.title() + wrong, "give sigma_s and sigma_a (1/m), or sigma_t (1/m) and albedo, or measured");
  }
  if (measured) return read_measured(table, medium);
  if (separate) {
    medium.sigma_s = table.rgb("sigma_s", kNotNegative);
    medium.sigma_t = medium.sigma_s + table.rgb("sigma_a", kNotNegative);
  } else {
    medium.sigma_t = table.rgb("sigma_t", kNotNegative, grid ? std::optional(Rgb(1.0f)) : std::nullopt);
    medium.sigma_s = medium.sigma_t * table.rgb("albedo", kFraction);
  }
}

GridPlan read_grid(TableReader& table, const GridRole& role, const GridValues* given) {
  GridRequest request;
  if (!given) {  // else the key `grid` describes it
    request.path = table.path("path");
    request.from_level_set = table.flag("from_level_set", false);
  }
  if (table.has("grid")) request.name = table.string("grid");
  request.interpolation = table.choice<Interpolation>(
      "interpolation", {{"trilinear", Interpolation::trilinear}, {"nearest", Interpolation::nearest}},
      Interpolation::trilinear);
  request.clamp_negative = table.flag("clamp_negative", false);
  request.object_to_world = read_transform(table, "transform");
  return {role, std::move(request), given, table, "path"};
}

/// A table of a table; what it may look like, where it is no table.
std::optional<TableReader> read_table(TableReader& table, const std::string& key, const std::string& example) {
  const Node* node = table.find(key);
  if (node && !node->table())
    table.fail(key, "'" + key + "' of " + table.title() + " must be a table, not " + kind_of(*node), example);
  return table.table(key, "'" + key + "' of " + table.title());
}

/// The grid that an emission or its temperature names: of the file of the density, unless it names another.
GridPlan read_source_grid(TableReader& table, const std::string& medium, const std::vector<GridPlan>& densities,
                          const GivenParts& given) {
  const GridRole& role = kGridRoles[1];
  const GridValues* values = given.grid({medium, std::string(role.name)});
  GridRequest request;
  if (!densities.empty()) request = densities.front().request;
  request.from_level_set = request.density = false;
  const bool path = table.has("path");
  request.name = table.string("grid");
  if (path)
    request.path = table.path("path");
  else if (!values && request.path.empty())
    table.fail("grid", "no file is given that holds this grid: the medium's density has none",
               "add path = \"FILE.vdb\"");
  return {role, std::move(request), values, table, "grid"};
}

void read_temperature(TableReader& emission, Medium& medium, std::vector<GridPlan>& grids, const GivenParts& given) {
  TableReader table = *read_table(emission, "temperature",
                                  "write temperature = { grid = \"temperature\" }; where all has one temperature, give "
                                  "its radiance instead");
  table.find("scale");
  table.find("offset");
  grids.push_back(read_source_grid(table, medium.name, grids, given));
  medium.emission->blackbody = true;
  medium.emission->scale = table.number("scale", kPositive, 1.0f);
  medium.emission->offset = table.number("offset", kAny, 0.0f);
  medium.emission->colour = Rgb(1.0f);
  table.finish();
}

void read_emission(TableReader& medium_table, Medium& medium, std::vector<GridPlan>& grids, const GivenParts& given) {
  constexpr const char* kKinds =
      "radiance (W/(m^2 sr), of a thick layer), power (W/m^3, whatever the density), or temperature = { grid = "
      "\"temperature\" }";
  std::optional<TableReader> table =
      read_table(medium_table, "emission", std::string("write emission = { ... } with ") + kKinds);
  if (!table && medium_table.has("emission_scale"))
    medium_table.fail("emission_scale", "there is no 'emission' that it would scale", "add emission = { ... }");
  if (!table) return;
  const bool radiance = table->has("radiance"), power = table->has("power"), temperature = table->has("temperature");
  if (radiance + power + temperature == 0) {
    table->find("grid");
    table->find("path");
    table->finish();
    table->fail_here(table->title() + " does not say what is emitted", std::string("give ") + kKinds);
  }
  if (radiance + power + temperature > 1)
    table->fail_here(table->title() + " says in several ways what is emitted", std::string("keep one of ") + kKinds);
  MediumEmission& emission = medium.emission.emplace();
  if (temperature) {
    read_temperature(*table, medium, grids, given);
  } else {
    emission.meaning = power ? MediumEmission::Meaning::volume : MediumEmission::Meaning::thermal;
    emission.colour = power ? read_emitted(*table, "power") / (4.0f * kPi) : read_emitted(*table, "radiance");
    if (table->has("grid"))
      grids.push_back(read_source_grid(*table, medium.name, grids, given));
    else if (table->has("path"))
      table->fail("path", "the grid of this file is not named", "add grid = \"flame\", or what it is called");
  }
  emission.colour *= medium_table.number("emission_scale", kPositive, 1.0f);
  table->finish();
}

MediumPlan read_medium(TableReader table, const std::string& name, const Names& names, const GivenParts& given) {
  std::vector<GridPlan> grids;
  MediumPart part;
  Medium& medium = part.medium;
  medium.name = name;
  const bool grid = table.choice<bool>("type", {{"homogeneous", false}, {"grid", true}});
  medium.phase = read_phase(table);
  read_coefficients(table, grid, medium);
  if (grid) {
    const GridRole& density = kGridRoles[0];
    grids.push_back(read_grid(table, density, given.grid({name, std::string(density.name)})));
    part.boundary = table.choice<GridBoundary>(
        "boundary", {{"box", GridBoundary::box}, {"shapes", GridBoundary::shapes}}, GridBoundary::automatic);
    if (table.has("outside")) part.outside = read_medium_name(table, "outside", names, kVacuum);
    const float scale = table.number("density_scale", kPositive, 1.0f);
    medium.sigma_s *= scale;
    medium.sigma_t *= scale;
  }
  if (!is_finite(medium.sigma_t))
    table.fail_here("the extinction of " + table.title() + " is too large for single precision");
  read_emission(table, medium, grids, given);
  table.finish();
  return {std::move(part), std::move(table), std::move(grids)};
}

}  // namespace

MediumId read_medium_name(TableReader& table, const std::string& key, const Names& media, MediumId fallback) {
  if (!table.has(key)) return fallback;
  const std::string name = table.string(key);
  if (name == "vacuum") return kVacuum;
  for (size_t i = 0; i < media.size(); ++i)
    if (media[i] == name) return static_cast<MediumId>(i);
  Names known = media;
  known.emplace_back("vacuum");
  table.fail(key, "there is no medium '" + name + "'", suggest(name, known, "there are"));
}

std::vector<MediumPlan> read_media(TableReader& section, const Names& names, const GivenParts& given) {
  std::vector<MediumPlan> plans;
  for (auto& [name, table] : section.named_tables("media")) plans.push_back(read_medium(table, name, names, given));
  return plans;
}

}  // namespace vpm
