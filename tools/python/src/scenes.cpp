// Scenes from files, from text with arrays, and arrays into files.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bindings.h"
#include "scene_job.h"
#include "vpm/input/grid/grid_writer.h"
#include "vpm/input/mesh/mesh_writer.h"
#include "vpm/input/scene_file.h"

namespace vpm::python {
namespace {

/// The package hands over aligned floats, so that strides are whole numbers of them.
GridValues grid_values(const py::array_t<float>& array, const Doubles& index_to_world) {
  GridValues grid;
  grid.values = array.data();
  for (int axis = 0; axis < 3; ++axis) {
    grid.count[axis] = static_cast<int>(array.shape(axis));
    grid.strides[static_cast<size_t>(axis)] = array.strides(axis) / static_cast<ptrdiff_t>(sizeof(float));
  }
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) grid.index_to_world[column][row] = index_to_world.at(row, column);
  return grid;
}

template <class Vector, class Array>
std::vector<Vector> rows_of(const Array& array) {
  std::vector<Vector> rows(static_cast<size_t>(array.shape(0)));
  if (!rows.empty()) std::copy_n(array.data(), array.size(), &rows[0][0]);
  return rows;
}

TriangleMesh triangle_mesh(const Floats& vertices, const Indices& faces, const std::optional<Floats>& normals,
                           const std::optional<Floats>& uvs) {
  TriangleMesh mesh{rows_of<Vec3>(vertices), rows_of<glm::uvec3>(faces)};
  if (normals) mesh.normals = rows_of<Vec3>(*normals);
  if (uvs) mesh.uvs = rows_of<Vec2>(*uvs);
  return mesh;
}

using GivenGrid = std::tuple<std::string, std::string, py::array_t<float>, Doubles>;  // of a medium, in a role
using GivenMesh = std::tuple<size_t, Floats, Indices, std::optional<Floats>, std::optional<Floats>>;

LeftOut left_out(bool automatic) { return automatic ? LeftOut::all_automatic : LeftOut::defaults; }

/// The scene that load_job() loads. What a signal's handler raises meanwhile ends that.
std::shared_ptr<SceneJob> load(const std::function<RenderJob()>& load_job) {
  std::shared_ptr<SceneJob> loaded;
  if (auto raised = run_interruptibly([&] { loaded = std::make_shared<SceneJob>(load_job()); }))
    throw *std::move(raised);
  return loaded;
}

std::shared_ptr<SceneJob> load_file(const std::string& path, const std::vector<std::string>& overrides,
                                    bool automatic) {
  return load([&] { return load_scene(path, components_first(overrides), left_out(automatic)); });
}

std::shared_ptr<SceneJob> load_text(const std::string& name, const std::string& text,
                                    const std::vector<GivenGrid>& grids, const std::vector<GivenMesh>& meshes,
                                    const std::vector<std::string>& overrides, bool automatic) {
  SceneText scene{name, text};
  for (const auto& [medium, role, array, index_to_world] : grids)
    scene.given.grids.emplace(GridName{medium, role}, grid_values(array, index_to_world));
  for (const auto& [shape, vertices, faces, normals, uvs] : meshes)
    scene.given.meshes.emplace(shape, triangle_mesh(vertices, faces, normals, uvs));
  return load([&] { return load_scene(scene, components_first(overrides), left_out(automatic)); });
}

void write_array(const std::string& path, const py::array_t<float>& array, const Doubles& index_to_world) {
  const GridValues grid = grid_values(array, index_to_world);
  const py::gil_scoped_release others_run;
  write_grid(grid, path);
}

void write_mesh(const std::string& path, const Floats& vertices, const Indices& faces,
                const std::optional<Floats>& normals, const std::optional<Floats>& uvs) {
  write_ply(triangle_mesh(vertices, faces, normals, uvs), path);
}

}  // namespace

void bind_scenes(py::module_& module) {
  py::class_<SceneJob, std::shared_ptr<SceneJob>>(module, "Job")
      .def_property_readonly("width", [](const SceneJob& scene) { return scene.job.scene.camera.width; })
      .def_property_readonly("height", [](const SceneJob& scene) { return scene.job.scene.camera.height; })
      .def_property_readonly("source", [](const SceneJob& scene) { return scene.job.source; })
      .def_property_readonly("hash", [](const SceneJob& scene) { return scene.job.hash; })
      .def_property_readonly("files", [](const SceneJob& scene) { return scene.job.files; });
  module.def("load_file", &load_file);
  module.def("load_text", &load_text);
  module.def("write_grid", &write_array);
  module.def("write_mesh", &write_mesh);
}

}  // namespace vpm::python
