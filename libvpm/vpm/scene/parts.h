// The parts of a scene as code gives them to assemble(), and how an error names the part it is about.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vpm/base/error.h"
#include "vpm/scene/scene.h"
#include "vpm/surface/mesh.h"

namespace vpm {

/// A material and the picture that its reflectance is read from, in [0, 1].
struct MaterialPart {
  Material material = Boundary{};
  std::shared_ptr<const Texture> texture{};  // null: the material's own reflectance, everywhere
  std::vector<std::string> notes{};          // on its picture
};

/// Who draws the surface within which a grid medium is met: a box around the grid's support, or shapes that name the
/// medium. Automatic: shapes where one has it inside, a box otherwise.
enum class GridBoundary { automatic, box, shapes };

/// A medium, and where it ends if it is a grid.
struct MediumPart {
  Medium medium{};
  GridBoundary boundary = GridBoundary::automatic;
  std::optional<MediumId> outside{};  // of the grid's box; nothing: the world's medium
};

/// The surfaces that shapes have.
using Surface = std::variant<TriangleMesh, QuadMesh, SphereShape, DiscShape>;

/// What is to be noted of a mesh and its file.
struct MeshNotes {
  uint64_t without_area = 0;       // triangles, which were dropped
  uint64_t not_plane = 0;          // polygons of which a corner is further than 1 % of their extent off the plane
  uint64_t bad_normals = 0;        // corners whose normal is zero, no number or lacking, and became the triangle's own
  uint64_t without_uvs = 0;        // times that texture coordinates are lacking or no numbers, and became zero
  uint64_t free_form = 0;          // surfaces that are none of polygons, which were not read
  uint32_t first_without_uvs = 0;  // the line of the first face with such a one; 0 in files that are no text
};

/// A shape and what it does to light.
struct ShapePart {
  std::string name{};   // of its own; empty: "shape 3", by its number
  std::string title{};  // what errors call it; empty: "shape 'name'"
  Surface surface{};
  uint32_t material = 0;             // its number in SceneParts::materials
  std::optional<Interface> media{};  // that meet at it; nothing: the medium is the same on both sides
  std::optional<Rgb> emission{};     // W/(m^2 sr), to the side of the outward normal
  MeshNotes notes{};
};

/// A light that is no shape.
struct LightPart {
  std::string name{};  // empty where it has none
  Light light{};
  std::vector<std::string> notes{};  // on its picture
};

/// Numbers of media and materials are places in these lists.
struct SceneParts {
  std::vector<MediumPart> media;
  std::vector<MaterialPart> materials;
  std::vector<ShapePart> shapes;
  std::vector<LightPart> lights;
  std::vector<Detector> detectors;
  MediumId world_medium = kVacuum;  // fills all space outside the shapes that separate media
  std::array<bool, 3> cyclic{};     // along which axes the box around all shapes repeats itself
  Camera camera;
  std::optional<MediumId> camera_medium;  // nothing: what the shapes say is around the camera
};

enum class PartKind { scene, world, cyclic, camera, medium, material, shape, light, lights, detector };

/// Names a part: one of a list by its number, or the scene, its world, its camera or all lights.
struct PartName {
  PartKind kind = PartKind::scene;
  size_t number = 0;    // in its list
  std::string field{};  // the member that is wrong; empty: the part as a whole
};
/// "scene", "world_medium", "shapes[3]", "shapes[3].emission".
std::string to_string(const PartName& part);

/// A part that is refused. The message says "<part>: <what is wrong>" and, in a line of its own, what would be right.
class PartError : public InputError {
 public:
  PartError(const PartName& part, const std::string& wrong, const std::string& right = "");

  const PartName& part() const { return part_; }
  const std::string& wrong() const { return wrong_; }
  const std::string& right() const { return right_; }

 private:
  PartName part_;
  std::string wrong_, right_;
};

/// The shape's name, "shape 3" where it has none.
std::string shape_name(const SceneParts& parts, size_t shape);

}  // namespace vpm
