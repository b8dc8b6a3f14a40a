#pragma once

#include <pybind11/pybind11.h>
// What all bindings need.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <utility>
#include <vector>

#include "docstrings.hpp"

// The Python module tanglebin._core: a function for each concept. The docstrings are the comments of the C++
// headers.
namespace tanglebin::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_geometry(py::module_& module);
void bind_cloud(py::module_& module);
void bind_simulation(py::module_& module);
void bind_recipe(py::module_& module);
void bind_scene(py::module_& module);
void bind_model(py::module_& module);
void bind_score(py::module_& module);
void bind_dataset(py::module_& module);
void bind_experiment(py::module_& module);
void bind_calibrate(py::module_& module);
void bind_index(py::module_& module);

/// Calls `call` without the GIL, so that other Python threads run meanwhile.
template <typename Call>
auto without_gil(const Call& call) {
  const py::gil_scoped_release released;
  return call();
}

/// A comment of the headers, and what is to be said of the binding alone.
inline std::string also(const char* comment, const char* note) {
  return std::string(comment) + "\n\n" + note;
}

/// A list that can be assigned. Python gets a copy: an item in the object's own memory would dangle once
/// another list is assigned. So no such list is a def_readwrite().
template <typename Object, typename Item>
void def_list(py::class_<Object>& described, const char* name, std::vector<Item> Object::*list,
              const char* comment) {
  described.def_property(
      name, [list](const Object& object) { return object.*list; },
      [list](Object& object, std::vector<Item> items) { object.*list = std::move(items); },
      also(comment, "A copy: assign the list to change it.").c_str());
}

}  // namespace tanglebin::python
