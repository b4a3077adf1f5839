// What pictures are measured against: exact solutions, and how far pictures are apart.
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bindings.h"
#include "exact_problems.h"
#include "vpm/image/exr.h"
#include "vpm/image/metrics.h"
#include "vpm/image/statistics_of.h"

namespace vpm::python {
namespace {

py::array_t<double> doubles_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// name, unit, place, its unit, places, values (NaN: there is none), errors.
py::tuple tuple_of(const tools::ExactQuantity& quantity) {
  std::vector<double> values;
  for (const std::optional<double>& value : quantity.values)
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  return py::make_tuple(quantity.name, quantity.unit, quantity.place, quantity.place_unit, doubles_of(quantity.places),
                        doubles_of(values), doubles_of(quantity.errors));
}

py::list solve_exactly(const std::string& name, const std::vector<std::string>& given) {
  std::vector<tools::ExactQuantity> quantities;
  {
    const py::gil_scoped_release others_run;
    const tools::ExactProblem& problem = tools::find_exact_problem(name);
    tools::ExactArguments arguments(problem.name, problem.keys, given);
    quantities = tools::solve(problem, arguments);
  }
  py::list found;
  for (const tools::ExactQuantity& quantity : quantities) found.append(tuple_of(quantity));
  return found;
}

/// Of each problem its name, what it is, and its keys: name, meaning, what it is otherwise, whether it must be given.
py::list problems() {
  py::list all;
  for (const tools::ExactProblem& problem : tools::exact_problems()) {
    py::list keys;
    for (const tools::ExactKey& key : problem.keys)
      keys.append(py::make_tuple(key.name, key.meaning, key.otherwise, key.required));
    all.append(py::make_tuple(problem.name, problem.summary, keys));
  }
  return all;
}

/// A picture, the variances of its pixels and those of its channels' means, where they are known.
using NoisyArray = std::tuple<Floats, std::optional<Floats>, std::optional<std::array<double, 3>>>;

NoisyImage noisy_image(const NoisyArray& array) {
  const auto& [picture, variance, of_means] = array;
  NoisyImage noisy{image_of(picture), {}, {}};
  if (variance) noisy.variance = image_of(*variance);
  if (of_means) noisy.variance_of_channel_means = Rgbd((*of_means)[0], (*of_means)[1], (*of_means)[2]);
  return noisy;
}

py::tuple tuple_of(const Rgbd& c) { return py::make_tuple(c.r, c.g, c.b); }

py::dict difference(const NoisyArray& one, const NoisyArray& other) {
  const NoisyImage picture = noisy_image(one), reference = noisy_image(other);
  py::dict found;
  found["mse"] = mse(picture.image, reference.image);
  found["relative_mse"] = relative_mse(picture.image, reference.image);
  found["relative_mse_of_pbrt"] = relative_mse_of_pbrt(picture.image, reference.image);
  found["means"] = tuple_of(channel_means(picture.image));
  found["means_of_reference"] = tuple_of(channel_means(reference.image));
  const NoisyDifference apart = noisy_difference(picture, reference);
  found["difference_of_means"] = tuple_of(apart.of_channel_means);
  found["standard_errors_of_means"] = tuple_of(apart.standard_errors);
  found["less_noise"] = apart.less_noise;
  found["standard_error"] = apart.standard_error;
  found["noise"] = apart.noise;
  found["noise_of_reference"] = apart.noise_of_reference;
  return found;
}

/// The picture, its planes by their names, its attributes, the pixels that the file has, what was done to the picture,
/// and why its statistics do not fit.
py::tuple read_planes(const std::string& path, const std::string& layer) {
  const ExrPicture picture = read_exr_picture(path, layer);
  const ExrChannels& channels = picture.file;
  py::dict planes;
  for (const auto& [name, values] : channels.planes)
    planes[py::str(name)] = py::array_t<float>({channels.height, channels.width}, values.data());
  py::dict metadata;
  for (const auto& [name, text] : channels.metadata)
    metadata[py::str(name)] = py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
  const auto& [x0, y0, x1, y1] = channels.held;
  const std::optional<Image> variance = layer_of(channels, "variance");
  return py::make_tuple(array_of(picture.image), planes, metadata, py::make_tuple(x0, y0, x1, y1), picture.notes,
                        variance ? why_statistics_do_not_fit(picture, *variance) : "");
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("exact", &solve_exactly);
  module.def("exact_problems", &problems);
  module.def("difference", &difference);
  module.def("read_exr", &read_planes);
}

}  // namespace vpm::python
