// What the files of the Python module share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <optional>

#include "vpm/image/image.h"

namespace vpm::python {

namespace py = pybind11;

// Each adds its part to the module.
void bind_scenes(py::module_& module);
void bind_photons(py::module_& module);
void bind_renders(py::module_& module);
void bind_studies(py::module_& module);

/// Arrays of C order, converted where they are something else.
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<uint32_t, py::array::c_style | py::array::forcecast>;

/// The picture as an array (height, width, 3), which takes over its memory.
py::array_t<float> array_of(Image image);
/// The picture as an array that cannot be written to: the memory stays that of `owner`.
py::array_t<float> view_of(const Image& image, py::handle owner);
/// A copy of an array (height, width, 3).
Image image_of(const Floats& array);

/// Runs work on a thread of its own, without the interpreter's lock, while this one lets Python handle signals. Where a
/// handler raises, as that of Ctrl-C does, the work is given up (base/cancel.h), and what it raised is returned once
/// the work has ended. What the work throws is thrown here.
std::optional<py::error_already_set> run_interruptibly(const std::function<void()>& work);

}  // namespace vpm::python
