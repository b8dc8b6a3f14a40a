#include "tanglebin/cloud/cloud.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "any_array.hpp"
#include "arrays.hpp"
#include "images.hpp"
#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/depth_input.hpp"
#include "tanglebin/io/grey_png.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/mesh.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_cloud.hpp"

namespace tanglebin::python {
namespace {

namespace io = tanglebin::doc::io;
namespace fs = std::filesystem;

// Puts the values of a property into their place, which stays where it is: arrays on it stay valid.
template <typename Value>
void assign(std::vector<Value>& property, const std::vector<Value>& values, std::size_t points,
            const char* name) {
  if (values.size() != points)
    throw InputError({"", 0, name}, std::to_string(values.size()),
                     fmt::format("one for each of {} points", points));
  if (property.capacity() < points) property.reserve(points);  // it was empty: nothing refers to it
  property.assign(values.begin(), values.end());
}

template <typename Array, typename Convert>
auto optional_values(const std::optional<Array>& array, const Convert& convert) {
  return array ? convert(*array) : decltype(convert(*array)){};
}

std::vector<Eigen::Vector3f> vectors_of(const py::array& array, const char* field) {
  expect_shape(array.ndim() >= 2 && array.ndim() <= 3 && array.shape(array.ndim() - 1) == 3, array, field,
               "n x 3 or h x w x 3");
  return items_of<Eigen::Vector3f>(array, field);
}

std::vector<Color> colors_of(const py::array& array) {
  expect_shape(array.ndim() >= 2 && array.ndim() <= 3 && array.shape(array.ndim() - 1) == 3, array, "colors",
               "n x 3 or h x w x 3");
  const std::vector<std::uint8_t> channels = integers_of<std::uint8_t>(array, "colors");
  std::vector<Color> colors(channels.size() / 3);
  for (std::size_t i = 0; i < colors.size(); ++i)
    colors[i] = {channels[3 * i], channels[3 * i + 1], channels[3 * i + 2]};
  return colors;
}

std::vector<std::int32_t> labels_from(const py::array& array) {
  std::vector<std::int32_t> labels = integers_of<std::int32_t>(array, "labels");
  if (const auto low = std::ranges::min_element(labels); low != labels.end() && *low < -1)
    throw InputError(
        {"", 0, "labels"}, std::to_string(*low),
        fmt::format("a label from -1, which is null, to {}", std::numeric_limits<std::int32_t>::max()));
  return labels;
}

std::vector<float> intensities_of(const py::array& array) {
  return items_of<float>(array, "intensities");
}

std::vector<std::uint8_t> mixed_of(const py::array& array) {
  return integers_of<std::uint8_t>(array, "mixed");
}

PointCloud cloud_of(const AnyArray& points, const std::optional<AnyArray>& labels,
                    const std::optional<AnyArray>& colors, const std::optional<AnyArray>& normals,
                    const std::optional<AnyArray>& intensities, const std::optional<AnyArray>& mixed,
                    const std::optional<py::array_t<double>>& viewpoint) {
  PointCloud cloud;
  cloud.points = vectors_of(points, "points");
  const bool is_organized = points.ndim() == 3;
  cloud.height = is_organized ? static_cast<std::size_t>(points.shape(0)) : 1;
  cloud.width = is_organized ? static_cast<std::size_t>(points.shape(1)) : cloud.points.size();
  const std::size_t size = cloud.points.size();
  if (labels) assign(cloud.labels, labels_from(*labels), size, "labels");
  if (colors) assign(cloud.colors, colors_of(*colors), size, "colors");
  if (normals) assign(cloud.normals, vectors_of(*normals, "normals"), size, "normals");
  if (intensities) assign(cloud.intensities, intensities_of(*intensities), size, "intensities");
  if (mixed) assign(cloud.mixed, mixed_of(*mixed), size, "mixed");
  if (viewpoint) cloud.viewpoint = pose_of(*viewpoint, "viewpoint");
  return cloud;
}

// A property that a cloud may lack, as an array in the cloud's memory.
template <typename Value>
std::optional<py::array> if_there(std::vector<Value>& values, const py::object& self) {
  if (values.empty()) return std::nullopt;
  if constexpr (std::is_arithmetic_v<Value>) {
    return view(values, self);
  } else {
    return rows(values, values.front().data(), 3, self);
  }
}

template <auto Member>
auto getter() {
  return [](const py::object& self) { return if_there(self.cast<PointCloud&>().*Member, self); };
}

template <auto Member, typename Array, auto Convert>
auto setter(const char* name) {
  return [name](PointCloud& cloud, const std::optional<Array>& array) {
    if (array) {
      assign(cloud.*Member, Convert(*array), cloud.points.size(), name);
    } else {
      (cloud.*Member).clear();
    }
  };
}

std::vector<Eigen::Vector3f> normals_of(const py::array& array) {
  return vectors_of(array, "normals");
}

py::tuple cloud_state(const py::object& self) {
  const auto& cloud = self.cast<const PointCloud&>();
  const auto organized = [&](const char* name) -> py::object {
    const py::object array = self.attr(name);
    return cloud.height == 1 ? array : array.attr("reshape")(cloud.height, cloud.width, 3);
  };
  return py::make_tuple(organized("points"), self.attr("labels"), self.attr("colors"), self.attr("normals"),
                        self.attr("intensities"), self.attr("mixed"), self.attr("viewpoint"));
}

PointCloud cloud_from(const py::tuple& state) {
  return cloud_of(state[0].cast<AnyArray>(), state[1].cast<std::optional<AnyArray>>(),
                  state[2].cast<std::optional<AnyArray>>(), state[3].cast<std::optional<AnyArray>>(),
                  state[4].cast<std::optional<AnyArray>>(), state[5].cast<std::optional<AnyArray>>(),
                  state[6].cast<std::optional<py::array_t<double>>>());
}

void bind_point_cloud(py::module_& module) {
  py::class_<PointCloud>(module, "PointCloud", doc::cloud::PointCloud)
      .def(py::init(&cloud_of), py::arg("points"), py::arg("labels") = py::none(),
           py::arg("colors") = py::none(), py::arg("normals") = py::none(),
           py::arg("intensities") = py::none(), py::arg("mixed") = py::none(),
           py::arg("viewpoint") = py::none(),
           "A cloud of points, n x 3, or h x w x 3 for an organized one. Copies the arrays, once.")
      .def("__len__", [](const PointCloud& cloud) { return cloud.points.size(); })
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            auto& points = self.cast<PointCloud&>().points;
            return rows(points, points.empty() ? nullptr : points.front().data(), 3, self);
          },
          "n x 3 float32, m, world frame; in the cloud's memory.")
      .def_property("labels", getter<&PointCloud::labels>(),
                    setter<&PointCloud::labels, AnyArray, &labels_from>("labels"),
                    "int32: 0 = bin, 1..n = tubes, −1 = null; in the cloud's memory. None if it has none.")
      .def_property("colors", getter<&PointCloud::colors>(),
                    setter<&PointCloud::colors, AnyArray, &colors_of>("colors"),
                    "n x 3 uint8: red, green, blue; in the cloud's memory. None if it has none.")
      .def_property(
          "normals", getter<&PointCloud::normals>(),
          setter<&PointCloud::normals, AnyArray, &normals_of>("normals"),
          "n x 3 float32: outward unit normals of the true surface; in the cloud's memory. None if it has "
          "none.")
      .def_property("intensities", getter<&PointCloud::intensities>(),
                    setter<&PointCloud::intensities, AnyArray, &intensities_of>("intensities"),
                    "float32: signal-to-noise ratio; in the cloud's memory. None if it has none.")
      .def_property(
          "mixed", getter<&PointCloud::mixed>(), setter<&PointCloud::mixed, AnyArray, &mixed_of>("mixed"),
          "uint8: 1 for a mixed point, the mean of several surfaces; in the cloud's memory. None if it has "
          "none.")
      .def_readonly("width", &PointCloud::width,
                    "points in a row, of an organized cloud; otherwise all points")
      .def_readonly("height", &PointCloud::height, "rows, of an organized cloud; otherwise 1")
      .def_property(
          "viewpoint",
          [](const PointCloud& cloud) {
            return cloud.viewpoint ? std::optional(matrix_of(*cloud.viewpoint)) : std::nullopt;
          },
          [](PointCloud& cloud, const std::optional<py::array_t<double>>& pose) {
            cloud.viewpoint = pose ? std::optional(pose_of(*pose, "viewpoint")) : std::nullopt;
          },
          doc::cloud::PointCloud_viewpoint)
      .def(py::pickle(&cloud_state, &cloud_from))
      .def("__repr__", [](const PointCloud& cloud) {
        return fmt::format("<PointCloud of {} x {} points>", cloud.height, cloud.width);
      });
  module.def(
      "labelled",
      [](const PointCloud& cloud, const AnyArray& labels) {
        std::vector<std::int32_t> values = labels_from(labels);
        if (values.size() != cloud.points.size())
          throw InputError({"", 0, "labels"}, std::to_string(values.size()),
                           fmt::format("one for each of {} points", cloud.points.size()));
        return labelled(cloud, std::move(values));
      },
      py::arg("cloud"), py::arg("labels"), doc::cloud::labelled);
  module.def(
      "label_colors",
      [](int tubes) {
        const std::vector<Color> colors = label_colors(tubes);
        py::array_t<std::uint8_t> array({signed_size(colors.size()), py::ssize_t{3}});
        std::memcpy(array.mutable_data(), colors.data(), colors.size() * sizeof(Color));
        return array;
      },
      py::arg("tubes"), doc::cloud::label_colors);
  module.def(
      "cloud_from_depths",
      [](const AnyArray& depths, const Intrinsics& intrinsics) {
        return cloud_from_depths(depths_of(depths, "depths"), intrinsics);
      },
      py::arg("depths"), py::arg("intrinsics"), doc::cloud::cloud_from_depths);
}

// Writes what `write` puts into a stream to a file, whole or not at all.
template <typename Write>
void write_to(const fs::path& file, const Write& write) {
  without_gil([&] { write_file(file, bytes_of(write)); });
}

LabelImage read_labels(const fs::path& file) {
  return labels_of_png(read_file(file, std::size_t{1} << 30U), file.string());
}

void bind_readers(py::module_& module) {
  const auto reader = [&](const char* name, auto read, const char* text) {
    module.def(
        name, [read](const fs::path& file) { return without_gil([&] { return read(file); }); },
        py::arg("file"), text);
  };
  reader(
      "read_cloud", [](const fs::path& file) { return read_cloud(file); }, io::read_cloud);
  reader(
      "read_ply", [](const fs::path& file) { return read_ply(file); }, io::read_ply);
  reader(
      "read_pcd", [](const fs::path& file) { return read_pcd(file); }, io::read_pcd);
  reader(
      "read_configuration", [](const fs::path& file) { return read_configuration(file); },
      io::read_configuration);
  module.def(
      "read_depths",
      [](const fs::path& file, std::optional<double> steps_per_metre, double floats_per_metre) {
        return array_of(without_gil([&] { return read_depths(file, steps_per_metre, floats_per_metre); }));
      },
      py::arg("file"), py::arg("steps_per_metre") = py::none(), py::arg("floats_per_metre") = 1.0,
      io::read_depths);
  module.def(
      "read_labels",
      [](const fs::path& file) { return array_of(without_gil([&] { return read_labels(file); })); },
      py::arg("file"),
      "Reads the PNG file of a label image as int32, h x w: 0 = bin, 1..n = tubes, −1 = null. Raises "
      "InputError naming "
      "the file.");
}

void bind_writers(py::module_& module) {
  module.def(
      "write_ply",
      [](const fs::path& file, const PointCloud& cloud, const std::string& coordinates) {
        write_to(file, [&](std::ostream& out) { write_ply(out, cloud, coordinates); });
      },
      py::arg("file"), py::arg("cloud"), py::arg("coordinates") = "metres, world frame", io::write_ply);
  module.def(
      "write_pcd",
      [](const fs::path& file, const PointCloud& cloud) {
        write_to(file, [&](std::ostream& out) { write_pcd(out, cloud); });
      },
      py::arg("file"), py::arg("cloud"), io::write_pcd);
  module.def(
      "write_configuration",
      [](const fs::path& file, const std::vector<Tube>& tubes) {
        write_to(file, [&](std::ostream& out) { write_configuration(out, tubes); });
      },
      py::arg("file"), py::arg("tubes"), io::write_configuration);
  module.def(
      "write_mesh_ply",
      [](const fs::path& file, const std::vector<TubeMesh>& meshes) {
        write_to(file, [&](std::ostream& out) { write_mesh_ply(out, meshes); });
      },
      py::arg("file"), py::arg("meshes"), io::write_mesh_ply);
  module.def(
      "write_mesh_obj",
      [](const fs::path& file, const std::vector<TubeMesh>& meshes) {
        write_to(file, [&](std::ostream& out) { write_mesh_obj(out, meshes); });
      },
      py::arg("file"), py::arg("meshes"), io::write_mesh_obj);
  module.attr("depth_scale") = depth_scale;
  module.def(
      "depth_png",
      [](const AnyArray& depths) {
        const DepthImage image = depths_of(depths, "depths");
        return py::bytes(without_gil([&] { return depth_png(image); }));
      },
      py::arg("depths"), io::depth_png);
  module.def(
      "label_png",
      [](const AnyArray& labels) {
        const LabelImage image = labels_of(labels, "labels");
        return py::bytes(without_gil([&] { return label_png(image); }));
      },
      py::arg("labels"), io::label_png);
  module.def("camera_json", &camera_json, py::arg("camera"), io::camera_json);
}

}  // namespace

LabelImage labels_of_png(const std::string& png, const std::string& name) {
  const GreyImage image = grey_image_from_png(png, name);
  LabelImage labels{image.width, image.height, {}};
  labels.labels.reserve(image.values.size());
  for (const std::uint16_t value : image.values)
    labels.labels.push_back(value == nothing_in_label_image ? null_label : static_cast<std::int32_t>(value));
  return labels;
}

DepthImage depths_of(const py::array& array, const char* field) {
  expect_shape(array.ndim() == 2, array, field, "h x w");
  return {static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), items_of<float>(array, field)};
}

LabelImage labels_of(const py::array& array, const char* field) {
  expect_shape(array.ndim() == 2, array, field, "h x w");
  return {static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), labels_from(array)};
}

void bind_cloud(py::module_& module) {
  bind_point_cloud(module);
  bind_readers(module);
  bind_writers(module);
}

}  // namespace tanglebin::python
