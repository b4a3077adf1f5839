// The photons of a pass, and photon maps of any photons: arrays that share the library's memory.
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "scene_job.h"
#include "vpm/base/error.h"
#include "vpm/estimate/photon_queries.h"
#include "vpm/input/grid/field_file.h"
#include "vpm/integrators/photon_map/stored_photons.h"
#include "vpm/job/fluence.h"
#include "vpm/job/photon_files.h"
#include "vpm/study/exact/slab_scene.h"

namespace vpm::python {
namespace {

/// A field of a structured array: its name, its format for numpy, and where it is in a row.
struct Field {
  const char *name, *format;
  size_t offset;
};

py::dtype dtype_of(std::initializer_list<Field> fields, size_t size) {
  py::list names, formats, offsets;
  for (const Field& field : fields) {
    names.append(field.name);
    formats.append(field.format);
    offsets.append(field.offset);
  }
  return py::dtype(names, formats, offsets, static_cast<py::ssize_t>(size));
}

py::dtype dtype_of_photons() {
  using P = StoredPhoton;
  return dtype_of({{"position", "3f4", offsetof(P, position)},
                   {"direction", "3f4", offsetof(P, direction)},
                   {"power", "3f4", offsetof(P, power)},
                   {"density", "f4", offsetof(P, density)},
                   {"number", "u8", offsetof(P, number)},
                   {"place", "u4", offsetof(P, place)},
                   {"scatterings", "u2", offsetof(P, scatterings)},
                   {"reflections", "u2", offsetof(P, reflections)},
                   {"map", "u1", offsetof(P, map)},
                   {"event", "u1", offsetof(P, event)}},
                  sizeof(P));
}

py::dtype dtype_of_flights() {
  using F = PhotonFlight;
  return dtype_of({{"start", "3f4", offsetof(F, from)},
                   {"end", "3f4", offsetof(F, to)},
                   {"power", "3f4", offsetof(F, power)},
                   {"place", "u4", offsetof(F, place)},
                   {"number", "u8", offsetof(F, number)},
                   {"scatterings", "u2", offsetof(F, scatterings)},
                   {"reflections", "u2", offsetof(F, reflections)},
                   {"event", "u1", offsetof(F, event)}},
                  sizeof(F));
}

/// The rows as an array that keeps `owner` alive, and that cannot be written to.
template <class Row>
py::array view_of_rows(const std::vector<Row>& rows, const py::dtype& type, py::handle owner) {
  py::array array(type, {static_cast<py::ssize_t>(rows.size())}, {static_cast<py::ssize_t>(sizeof(Row))}, rows.data(),
                  owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// The numbers as an array that takes over their memory.
template <class T>
py::array_t<T> array_of_vector(std::vector<T> values, std::vector<py::ssize_t> shape) {
  auto* const owned = new std::vector<T>(std::move(values));
  const py::capsule owner(owned, [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
  return py::array_t<T>(std::move(shape), owned->data(), owner);
}

/// What collect(scene, settings) finds, once the job's settings are chosen; or where they are given, for what is not
/// a render.
enum class Settings { chosen, given };
template <class Data, class Collect>
std::shared_ptr<Data> collect(const std::shared_ptr<SceneJob>& scene, std::optional<uint64_t> seed, Settings which,
                              Collect&& of) {
  std::shared_ptr<Data> data;
  auto raised = run_interruptibly([&] {
    std::optional<JobState> state;
    {
      const std::scoped_lock lock(scene->busy);
      state.emplace(scene->job);
    }
    if (seed) state->settings.seed = *seed;
    with_job(*scene, *state, [&](RenderJob& job) {
      if (which == Settings::chosen)
        choose(job);
      else
        refuse_automatic(job, "what counts photons");
      data = std::make_shared<Data>(of(job.scene, job.settings));
    });
  });
  if (raised) throw *std::move(raised);
  return data;
}

std::shared_ptr<StoredPhotons> photons_of(const std::shared_ptr<SceneJob>& scene, std::optional<uint64_t> seed,
                                          int pass) {
  return collect<StoredPhotons>(scene, seed, Settings::chosen, [&](const Scene& of, const RenderSettings& settings) {
    return stored_photons(of, settings, pass);
  });
}

std::shared_ptr<PhotonFlights> flights_of(const std::shared_ptr<SceneJob>& scene, std::optional<uint64_t> seed,
                                          int pass) {
  return collect<PhotonFlights>(scene, seed, Settings::chosen, [&](const Scene& of, const RenderSettings& settings) {
    return photon_flights(of, settings, pass);
  });
}

py::dict energy_of(const Ledger& ledger) {
  const auto of_photon = [&](const Rgbd& power) {
    const Rgbd each = power / static_cast<double>(std::max<uint64_t>(1, ledger.emitted_count));
    return py::make_tuple(each.r, each.g, each.b);
  };
  py::dict energy;
  energy["emitted"] = of_photon(ledger.emitted);
  energy["absorbed_in_media"] = of_photon(ledger.absorbed_in_media);
  energy["absorbed_on_surfaces"] = of_photon(ledger.absorbed_on_surfaces);
  energy["escaped"] = of_photon(ledger.escaped);
  energy["cut"] = of_photon(ledger.cut);
  return energy;
}

PhotonRun photon_run(int passes, const std::optional<double>& seconds) {
  return {.until = {.passes = passes, .seconds = seconds.value_or(0.0)}};
}

using Corners = std::array<float, 6>;  // of a box, m
using Count = std::array<int, 3>;

/// The cells of that box, or of the scene's; cubes of so many along its longest edge, or as many as are asked for.
CellLattice lattice_of(const Scene& scene, const std::optional<Corners>& box, int resolution,
                       const std::optional<Count>& count) {
  const Box asked =
      box ? Box{{(*box)[0], (*box)[1], (*box)[2]}, {(*box)[3], (*box)[4], (*box)[5]}} : default_field_box(scene);
  CellLattice lattice = about_cubes(asked, resolution);
  if (count) lattice.count = {(*count)[0], (*count)[1], (*count)[2]};
  return lattice;
}

std::shared_ptr<FluenceField> fluence_of(const std::shared_ptr<SceneJob>& scene, std::optional<uint64_t> seed,
                                         const std::optional<Corners>& box, int resolution,
                                         const std::optional<Count>& count, int passes,
                                         const std::optional<double>& seconds, bool flux) {
  const PhotonRun run = photon_run(passes, seconds);
  return collect<FluenceField>(scene, seed, Settings::given, [&](const Scene& of, const RenderSettings& settings) {
    return measure_fluence(of, settings, lattice_of(of, box, resolution, count), run, flux);
  });
}

/// Measured shares of a slab, and the rest as JSON.
struct Measured {
  std::string json;
  std::vector<SlabShare> shares;
};

std::shared_ptr<Measured> measured_of(const std::shared_ptr<SceneJob>& scene, std::optional<uint64_t> seed, int passes,
                                      const std::optional<double>& seconds) {
  const PhotonRun run = photon_run(passes, seconds);
  return collect<Measured>(scene, seed, Settings::given, [&](const Scene& of, const RenderSettings& settings) {
    const SlabMeasurement measured = measure_scene(of, settings, run);
    return Measured{json_of(measured.measurement, of), measured.shares};
  });
}

py::tuple channels_of(const Rgbd& value) { return py::make_tuple(value.r, value.g, value.b); }

py::object slab_dict(const Measured& measured) {
  if (measured.shares.empty()) return py::none();
  py::dict slab;
  for (const SlabShare& share : measured.shares)
    slab[share.name] =
        py::make_tuple(channels_of(share.share), channels_of(share.standard_error), channels_of(share.exact));
  return slab;
}

/// An array (nx, ny, nz, 3) of one of a field's quantities.
py::array field_array(const py::object& self, std::vector<Rgb> FluenceField::*values) {
  const auto& field = self.cast<const FluenceField&>();
  const Vec3i& count = field.lattice.count;
  py::array_t<float> array({count.x, count.y, count.z, 3}, reinterpret_cast<const float*>((field.*values).data()),
                           self);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// An array (3, nx, ny, nz, 3) of what is along each axis; none where flux was not asked for.
py::object flux_array(const FluenceField& field, const std::array<std::vector<Rgb>, 3>& along) {
  if (along[0].empty()) return py::none();
  const Vec3i& count = field.lattice.count;
  py::array_t<float> array({3, count.x, count.y, count.z, 3});
  float* to = array.mutable_data();
  for (const std::vector<Rgb>& axis : along)
    to = std::copy_n(reinterpret_cast<const float*>(axis.data()), 3 * axis.size(), to);
  return array;
}

/// The rows of an array (n, 3), read where they are.
std::span<const Vec3> vectors(const Floats& array) {
  return {reinterpret_cast<const Vec3*>(array.data()), static_cast<size_t>(array.shape(0))};
}
std::span<const Vec3> vectors(const std::optional<Floats>& array) {
  return array ? vectors(*array) : std::span<const Vec3>();
}

std::shared_ptr<PhotonQueries> queries_of(const Floats& positions, const Floats& directions, const Floats& powers) {
  const auto place = vectors(positions), travel = vectors(directions), power = vectors(powers);
  const py::gil_scoped_release others_run;
  std::vector<Photon> photons(place.size());
  for (size_t i = 0; i < photons.size(); ++i) photons[i] = {place[i], PackedDirection(travel[i]), Rgb(power[i])};
  return std::make_shared<PhotonQueries>(std::move(photons));
}

/// Calls ask() without the interpreter's lock.
template <class Ask>
auto without_lock(Ask&& ask) {
  const py::gil_scoped_release others_run;
  return ask();
}

py::array count_within(const PhotonQueries& map, const Floats& points, float radius) {
  auto counts = without_lock([&] { return map.count_within(vectors(points), radius); });
  return array_of_vector(std::move(counts), {points.shape(0)});
}

py::tuple within(const PhotonQueries& map, const Floats& points, float radius) {
  NearLists lists = without_lock([&] { return map.within(vectors(points), radius); });
  const auto found = static_cast<py::ssize_t>(lists.numbers.size());
  return py::make_tuple(array_of_vector(std::move(lists.first), {points.shape(0) + 1}),
                        array_of_vector(std::move(lists.numbers), {found}));
}

py::tuple nearest(const PhotonQueries& map, const Floats& points, uint32_t count) {
  NearestLists lists = without_lock([&] { return map.nearest(vectors(points), count); });
  return py::make_tuple(array_of_vector(std::move(lists.numbers), {points.shape(0), count}),
                        array_of_vector(std::move(lists.distances), {points.shape(0), count}));
}

py::array estimate(const PhotonQueries& map, const Floats& points, float radius, const std::string& kernel,
                   const std::optional<Floats>& normals, const std::optional<Floats>& directions, float g) {
  const auto* const info =
      std::find_if(kKernels.begin(), kKernels.end(), [&](const KernelInfo& known) { return known.name == kernel; });
  if (info == kKernels.end()) throw InputError("there is no kernel '" + kernel + "'");
  std::vector<Rgb> found = without_lock([&] {
    return map.estimate(vectors(points), radius, info->kind, {vectors(normals), vectors(directions), g});
  });
  std::vector<float> values(3 * found.size());
  for (size_t i = 0; i < values.size(); ++i) values[i] = found[i / 3][static_cast<int>(i % 3)];
  return array_of_vector(std::move(values), {points.shape(0), 3});
}

}  // namespace

void bind_photons(py::module_& module) {
  py::class_<StoredPhotons, std::shared_ptr<StoredPhotons>>(module, "StoredPhotons")
      .def("array",
           [](const py::object& self) {
             return view_of_rows(self.cast<const StoredPhotons&>().photons, dtype_of_photons(), self);
           })
      .def_readonly("maps", &StoredPhotons::maps)
      .def_readonly("places", &StoredPhotons::places)
      .def_readonly("emitted", &StoredPhotons::emitted)
      .def("energy", [](const StoredPhotons& photons) { return energy_of(photons.ledger); })
      .def("write", [](const StoredPhotons& photons, const std::string& path) {
        const py::gil_scoped_release others_run;
        write_photons(photons, path);
      });
  py::class_<PhotonFlights, std::shared_ptr<PhotonFlights>>(module, "PhotonFlights")
      .def("array",
           [](const py::object& self) {
             return view_of_rows(self.cast<const PhotonFlights&>().flights, dtype_of_flights(), self);
           })
      .def_readonly("places", &PhotonFlights::places)
      .def_readonly("emitted", &PhotonFlights::emitted)
      .def("write", [](const PhotonFlights& flights, const std::string& path) {
        const py::gil_scoped_release others_run;
        write_flights(flights, path);
      });
  py::class_<PhotonQueries, std::shared_ptr<PhotonQueries>>(module, "PhotonQueries")
      .def(py::init(&queries_of))
      .def("count_within", &count_within)
      .def("within", &within)
      .def("nearest", &nearest)
      .def("estimate", &estimate);
  py::class_<FluenceField, std::shared_ptr<FluenceField>>(module, "FluenceField")
      .def("fluence", [](const py::object& self) { return field_array(self, &FluenceField::fluence); })
      .def("fluence_error", [](const py::object& self) { return field_array(self, &FluenceField::fluence_error); })
      .def("absorbed", [](const py::object& self) { return field_array(self, &FluenceField::absorbed); })
      .def("absorbed_error", [](const py::object& self) { return field_array(self, &FluenceField::absorbed_error); })
      .def("flux", [](const FluenceField& field) { return flux_array(field, field.flux); })
      .def("flux_error", [](const FluenceField& field) { return flux_array(field, field.flux_error); })
      .def_property_readonly("box",
                             [](const FluenceField& field) {
                               const auto& [lo, hi] = field.lattice.box;
                               return py::make_tuple(py::make_tuple(lo.x, lo.y, lo.z),
                                                     py::make_tuple(hi.x, hi.y, hi.z));
                             })
      .def_property_readonly("passes", [](const FluenceField& field) { return field.run.passes; })
      .def("energy", [](const FluenceField& field) { return energy_of(field.run.ledger); })
      .def("write", [](const FluenceField& field, const std::string& path) {
        const py::gil_scoped_release others_run;
        write_field(field, path);
      });
  py::class_<Measured, std::shared_ptr<Measured>>(module, "Measured")
      .def_readonly("json", &Measured::json)
      .def_property_readonly("slab", &slab_dict);
  module.def("fluence", &fluence_of);
  module.def("measure", &measured_of);
  module.def("stored_photons", &photons_of);
  module.def("photon_flights", &flights_of);
  module.def("photon_events", &names_of_photon_events);
}

}  // namespace vpm::python
