// How parts of a scene and errors about them are put into words.
#include "vpm/scene/parts.h"

namespace vpm {

std::string to_string(const PartName& part) {
  const auto of_list = [&](const char* list) {
    return list + ("[" + std::to_string(part.number)) + "]" + (part.field.empty() ? "" : "." + part.field);
  };
  switch (part.kind) {
    case PartKind::scene:
      return "scene";
    case PartKind::world:
      return "world_medium";
    case PartKind::cyclic:
      return "cyclic";
    case PartKind::camera:
      return part.field.empty() ? "camera" : part.field;
    case PartKind::medium:
      return of_list("media");
    case PartKind::material:
      return of_list("materials");
    case PartKind::shape:
      return of_list("shapes");
    case PartKind::light:
      return of_list("lights");
    case PartKind::detector:
      return of_list("detectors");
    case PartKind::lights:
      return "lights";
  }
  __builtin_unreachable();
}

PartError::PartError(const PartName& part, const std::string& wrong, const std::string& right)
    : InputError(to_string(part) + ": " + wrong + (right.empty() ? "" : "\n" + right)),
      part_(part),
      wrong_(wrong),
      right_(right) {}

std::string shape_name(const SceneParts& parts, size_t shape) {
  const std::string& name = parts.shapes[shape].name;
  return name.empty() ? "shape " + std::to_string(shape) : name;
}

}  // namespace vpm
