// The module vpm._vpm: what the package vpm calls of the library. The package is what users see.
#include "bindings.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <string>
#include <utility>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/base/version.h"
#include "vpm/render/render.h"

namespace vpm::python {

py::array_t<float> array_of(Image image) {
  auto* const owned = new Image(std::move(image));
  const py::capsule owner(owned, [](void* pointer) { delete static_cast<Image*>(pointer); });
  return py::array_t<float>({owned->height, owned->width, 3}, reinterpret_cast<const float*>(owned->pixels.data()),
                            owner);
}

py::array_t<float> view_of(const Image& image, py::handle owner) {
  py::array_t<float> view({image.height, image.width, 3}, reinterpret_cast<const float*>(image.pixels.data()), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

Image image_of(const Floats& array) {
  if (array.ndim() != 3 || array.shape(2) != 3)
    throw InputError("a picture is an array (height, width, 3), not one of shape " +
                     std::string(py::str(array.attr("shape"))));
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  std::copy_n(array.data(), array.size(), reinterpret_cast<float*>(image.pixels.data()));
  return image;
}

std::optional<py::error_already_set> run_interruptibly(const std::function<void()>& work) {
  constexpr std::chrono::milliseconds kBetweenLooks(20);
  std::atomic<bool> stop{false};
  std::optional<py::error_already_set> raised;
  const py::gil_scoped_release others_run;
  std::future<void> done = std::async(std::launch::async, [&] {
    const CancelScope asked_to_end(stop);
    try {
      work();
    } catch (const Cancelled&) {
    }
  });
  while (done.wait_for(kBetweenLooks) != std::future_status::ready) {
    const py::gil_scoped_acquire lock;
    if (raised || PyErr_CheckSignals() == 0) continue;
    raised.emplace();
    stop = true;
  }
  done.get();
  return raised;
}

}  // namespace vpm::python

PYBIND11_MODULE(_vpm, module) {
  using namespace vpm;
  pybind11::register_exception<InputError>(module, "InputError", PyExc_ValueError).doc() =
      "Wrong input. The text is that of the command line: where, what is wrong, and what would be right.";
  pybind11::register_exception<NoPassFits>(module, "NoPassFits", PyExc_TimeoutError).doc() =
      "Not even one pass ends within twice the seconds that were asked for. The text says what would fit.";
  module.def("version", [] { return std::string(version()); });
  module.def("set_threads", &set_threads, pybind11::arg("count"));
  module.def("thread_count", &thread_count);
  python::bind_scenes(module);
  python::bind_photons(module);
  python::bind_renders(module);
  python::bind_studies(module);
}
