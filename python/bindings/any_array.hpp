#pragma once

#include <pybind11/numpy.h>

#include "bindings.hpp"

namespace tanglebin::python {

/// An argument that is an array of any type. Lists and what else NumPy makes arrays of are taken, too.
class AnyArray : public py::array {
public:
  using py::array::array;
};

}  // namespace tanglebin::python

namespace pybind11::detail {

template <>
struct handle_type_name<tanglebin::python::AnyArray> {
  static constexpr auto name = const_name("numpy.ndarray");
};

template <>
struct pyobject_caster<tanglebin::python::AnyArray> {
  using type = tanglebin::python::AnyArray;

  bool load(handle source, bool convert) {
    if (!convert && !isinstance<array>(source)) return false;
    const array found = array::ensure(source);
    if (!found) return false;
    value = reinterpret_borrow<type>(found);
    return true;
  }

  PYBIND11_TYPE_CASTER(type, handle_type_name<type>::name);
};

}  // namespace pybind11::detail
