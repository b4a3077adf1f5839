// The section [[detectors]].
#include "vpm/input/sections.h"

namespace vpm {
namespace {

QuadDetector read_quad_detector(TableReader& table) {
  QuadDetector quad{table.vector("corner"), table.vector("edge_u"), table.vector("edge_v")};
  if (!table.has("cells")) return quad;
  const std::vector<double> cells = table.numbers("cells", 2, Range{1.0, 1e5, false, false});
  for (size_t a = 0; a < 2; ++a) {
    quad.cells[a] = static_cast<int>(cells[a]);
    if (cells[a] != quad.cells[a]) table.fail("cells", "'cells' of " + table.title() + " must be whole numbers");
  }
  return quad;
}

Detector read_detector(TableReader& table, const std::string& usual_name, const Names& media) {
  enum class Kind { plane, disc, quad, sphere, medium };
  Detector detector;
  detector.name = table.string("name", usual_name);
  switch (table.choice<Kind>("type", {{"plane", Kind::plane},
                                      {"disc", Kind::disc},
                                      {"quad", Kind::quad},
                                      {"sphere", Kind::sphere},
                                      {"medium", Kind::medium}})) {
    case Kind::plane:
      detector.kind = PlaneDetector{table.vector("point"), table.direction("normal")};
      break;
    case Kind::disc:
      detector.kind =
          DiscDetector{table.vector("center"), table.direction("normal"), table.number("radius", kPositive)};
      break;
    case Kind::quad:
      detector.kind = read_quad_detector(table);
      break;
    case Kind::sphere:
      detector.kind = SphereDetector{table.vector("center"), table.number("radius", kPositive)};
      break;
    case Kind::medium:
      table.require("medium");
      detector.kind = MediumDetector{read_medium_name(table, "medium", media, kVacuum)};
      break;
  }
  if (!detector.of_medium()) detector.angles = static_cast<int>(table.integer("angles", 1, 10'000, 1));
  table.finish();
  return detector;
}

}  // namespace

std::vector<DetectorPlan> read_detectors(std::vector<TableReader>& tables, const Names& media) {
  std::vector<DetectorPlan> plans;
  for (TableReader& table : tables) {
    Detector detector = read_detector(table, "detector " + std::to_string(plans.size()), media);
    plans.push_back({std::move(detector), table});
  }
  return plans;
}

}  // namespace vpm
