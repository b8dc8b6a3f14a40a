#pragma once

#include <fmt/core.h>
#include <pybind11/numpy.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "tanglebin/base/error.hpp"

// C++ arrays as NumPy's, and the other way round.
namespace tanglebin::python {

using Sizes = std::vector<py::ssize_t>;

inline py::ssize_t signed_size(std::size_t size) {
  return static_cast<py::ssize_t>(size);
}

/// A NumPy array in the memory of `owner`, which it keeps alive; strides in bytes.
template <typename Value>
py::array_t<Value> view(Value* data, Sizes shape, Sizes strides, py::handle owner) {
  return py::array_t<Value>(std::move(shape), std::move(strides), data, owner);
}

/// The numbers of a vector, without a copy.
template <typename Value>
py::array_t<Value> view(std::vector<Value>& values, py::handle owner) {
  return view(values.data(), {signed_size(values.size())}, {sizeof(Value)}, owner);
}

/// The rows of a vector whose items begin with `columns` numbers at `first`, without a copy.
template <typename Value, typename Item>
py::array_t<Value> rows(std::vector<Item>& items, Value* first, py::ssize_t columns, py::handle owner) {
  return view(first, {signed_size(items.size()), columns}, {sizeof(Item), sizeof(Value)}, owner);
}

/// Moves a vector into a NumPy array of this shape, without a copy.
template <typename Value>
py::array_t<Value> moved(std::vector<Value> values, Sizes shape) {
  auto owner = std::make_unique<std::vector<Value>>(std::move(values));
  Value* const data = owner->data();
  const py::capsule capsule(owner.get(),
                            [](void* vector) { delete static_cast<std::vector<Value>*>(vector); });
  static_cast<void>(owner.release());  // the capsule's now
  return py::array_t<Value>(std::move(shape), data, capsule);
}

inline std::string text_of_shape(const py::array& array) {
  return fmt::format(
      "an array of shape {}",
      std::string(py::str(py::tuple(py::cast(Sizes(array.shape(), array.shape() + array.ndim()))))));
}

inline void expect_shape(bool is_right, const py::array& array, const char* field,
                         const std::string& expected) {
  if (!is_right) throw InputError({"", 0, field}, text_of_shape(array), expected);
}

/// Copies an array of real numbers, of which one or several make an item: n x 3, h x w x 3, … Throws
/// InputError naming `field` for other types: NumPy would convert complex numbers, booleans and text.
template <typename Item>
std::vector<Item> items_of(const py::array& any, const char* field) {
  if (std::string_view("fiu").find(any.dtype().kind()) == std::string_view::npos)
    throw InputError({"", 0, field}, "an array of " + std::string(py::str(any.dtype())),
                     "an array of real numbers");
  const py::array_t<float, py::array::c_style | py::array::forcecast> array(any);
  static_assert(std::is_trivially_copyable_v<float> && sizeof(Item) % sizeof(float) == 0);
  std::vector<Item> items(static_cast<std::size_t>(array.nbytes()) / sizeof(Item));
  if (!items.empty())
    std::memcpy(static_cast<void*>(items.data()), array.data(), items.size() * sizeof(Item));
  return items;
}

/// Copies an array of integers of the type `Wide`, or of one that it includes.
template <typename Integer, typename Wide>
std::vector<Integer> narrowed(const py::array_t<Wide, py::array::c_style | py::array::forcecast>& wide,
                              const char* field) {
  std::vector<Integer> integers(static_cast<std::size_t>(wide.size()));
  for (std::size_t i = 0; i < integers.size(); ++i) {
    const Wide value = wide.data()[i];
    if (!std::in_range<Integer>(value))
      throw InputError({"", 0, field}, std::to_string(value),
                       fmt::format("an integer from {} to {}", std::numeric_limits<Integer>::min(),
                                   std::numeric_limits<Integer>::max()));
    integers[i] = static_cast<Integer>(value);
  }
  return integers;
}

/// Copies an array of integers of any type. Throws InputError naming `field` for other types and for numbers
/// that are out of range.
template <typename Integer>
std::vector<Integer> integers_of(const py::array& array, const char* field) {
  const char kind = array.dtype().kind();
  if (kind == 'u') return narrowed<Integer, std::uint64_t>(array, field);
  if (kind == 'i' || kind == 'b') return narrowed<Integer, std::int64_t>(array, field);
  throw InputError({"", 0, field}, "an array of " + std::string(py::str(array.dtype())),
                   "an array of integers");
}

/// A pose as a 4 x 4 matrix, and the inverse, which throws InputError naming `field`.
py::array_t<double> matrix_of(const Eigen::Isometry3d& pose);
Eigen::Isometry3d pose_of(const py::array_t<double>& matrix, const char* field);

/// A vector as an array of three numbers, and the inverse.
py::array_t<double> array_of(const Eigen::Vector3d& vector);
Eigen::Vector3d vector_of(const py::array_t<double>& array, const char* field);

}  // namespace tanglebin::python
