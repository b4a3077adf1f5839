// The section [materials.*].
#include <fmt/format.h>

#include "vpm/input/sections.h"
#include "vpm/surface/material/fresnel.h"
#include "vpm/surface/material/metals.h"

namespace vpm {
namespace {

constexpr Range kIndex{kLeastIndex, kLargestIndex, false, false};
constexpr Range kIndexK{kLeastK, kLargestK, false, false};

/// The index of a metal's refraction, by its name or as two colours.
Conductor read_metal(TableReader& table) {
  if (!table.has("metal")) {
    if (!table.has("eta") && !table.has("k"))
      table.fail_here(table.title() + " lacks a metal", "add: metal = \"gold\", or eta and k");
    return {table.rgb("eta", kIndex), table.rgb("k", kIndexK)};
  }
  std::vector<std::pair<std::string, Metal>> metals;
  for (const Metal& metal : kMetals) metals.emplace_back(metal.name, metal);
  const auto metal = table.choice<Metal>("metal", metals);
  for (const char* key : {"eta", "k"})
    if (table.has(key)) table.fail(key, "the metal of " + table.title() + " has its own '" + key + "'", "remove one");
  return {metal.eta, metal.k};
}

float read_roughness(TableReader& table, const std::string& smooth_type) {
  const float roughness = table.number("roughness", {0.0, 1.0, false, false});
  if (roughness < kLeastRoughness)
    table.fail(
        "roughness",
        fmt::format("the roughness of {} must be at least {}, not {}", table.title(), kLeastRoughness, roughness),
        "type = \"" + smooth_type + "\" is the smooth one");
  return roughness;
}

Material read_phong(TableReader& table) {
  const Phong phong{table.rgb("diffuse", kFraction), table.rgb("glossy", kFraction),
                    table.number("exponent", {0.0, kLargestExponent, false, false})};
  if (max_channel(phong.diffuse + phong.glossy) > 1.0f)
    table.fail("glossy", "'diffuse' and 'glossy' of " + table.title() + " together reflect more than arrives",
               "their sum must be at most 1 in every channel");
  return phong;
}

Material read_rough_dielectric(TableReader& table) {
  const float ior = table.number("ior", kIndex);
  if (std::abs(ior - 1.0f) < kLeastIorStep)
    table.fail("ior",
               fmt::format("the ior of {} must be at least {} away from 1, not {}", table.title(), kLeastIorStep, ior),
               "type = \"dielectric\" or \"boundary\" pass light that hardly turns");
  return RoughDielectric{ior, read_roughness(table, "dielectric")};
}

}  // namespace

MaterialPlan read_material(TableReader table) {
  using Reader = Material (*)(TableReader&, MaterialPart&);
  const auto read = table.choice<Reader>(
      "type",
      {{"lambertian", [](TableReader& t, MaterialPart& p) -> Material { return Lambertian{read_reflectance(t, p)}; }},
       {"phong", [](TableReader& t, MaterialPart&) { return read_phong(t); }},
       {"mirror",
        [](TableReader& t, MaterialPart& p) -> Material { return Mirror{read_reflectance(t, p, Rgb(1.0f))}; }},
       {"conductor", [](TableReader& t, MaterialPart&) -> Material { return read_metal(t); }},
       {"rough-conductor",
        [](TableReader& t, MaterialPart&) -> Material {
          const Conductor metal = read_metal(t);
          return RoughConductor{metal.eta, metal.k, read_roughness(t, "conductor")};
        }},
       {"dielectric", [](TableReader& t, MaterialPart&) -> Material { return Dielectric{t.number("ior", kIndex)}; }},
       {"thin-dielectric",
        [](TableReader& t, MaterialPart&) -> Material { return ThinDielectric{t.number("ior", kIndex)}; }},
       {"rough-dielectric", [](TableReader& t, MaterialPart&) { return read_rough_dielectric(t); }},
       {"boundary", [](TableReader&, MaterialPart&) -> Material { return Boundary{}; }}});
  MaterialPart part;
  part.material = read(table, part);
  table.finish();
  return {std::move(part), std::move(table)};
}

std::vector<MaterialPlan> read_materials(TableReader& section) {
  std::vector<MaterialPlan> materials;
  for (auto& [name, table] : section.named_tables("materials")) materials.push_back(read_material(table));
  return materials;
}

}  // namespace vpm
