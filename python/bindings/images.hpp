#pragma once

#include "arrays.hpp"
#include "tanglebin/cloud/images.hpp"

// Images as arrays h x w.
namespace tanglebin::python {

/// Without a copy.
inline py::array_t<float> array_of(DepthImage image) {
  return moved(std::move(image.depths), {image.height, image.width});
}
inline py::array_t<std::int32_t> array_of(LabelImage image) {
  return moved(std::move(image.labels), {image.height, image.width});
}

/// Decodes the PNG file of a label image. Throws InputError naming the file `name`.
LabelImage labels_of_png(const std::string& png, const std::string& name);

/// Copies. Throws InputError naming `field` unless the array is h x w, of real numbers or of integers.
DepthImage depths_of(const py::array& array, const char* field);
LabelImage labels_of(const py::array& array, const char* field);

}  // namespace tanglebin::python
