#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "tanglebin/cloud/images.hpp"
#include "tanglebin/export/format.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/scan/scan_output.hpp"

namespace tanglebin {
namespace {

// What instances are, in category_id_segmaps.
constexpr std::uint8_t category_of_nothing = 0;
constexpr std::uint8_t category_of_tubes = 1;
constexpr std::uint8_t category_of_bin = 2;

// The library's functions return a negative number if they fail.
template <typename Result>
Result expect_done(Result result) {
  if (result < 0) throw std::runtime_error("HDF5 failed");
  return result;
}

/// An object of the HDF5 library.
class Handle {
public:
  using Close = herr_t (*)(hid_t);

  Handle(hid_t id, Close close) : id_(expect_done(id)), close_(close) {}
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  hid_t id() const { return id_; }

private:
  hid_t id_;
  Close close_;
};

using Shape = std::vector<hsize_t>;

hid_t type_of(float /*value*/) {
  return H5T_IEEE_F32LE;
}
hid_t type_of(std::uint8_t /*value*/) {
  return H5T_STD_U8LE;
}
hid_t type_of(std::uint16_t /*value*/) {
  return H5T_STD_U16LE;
}
hid_t type_of(std::uint32_t /*value*/) {
  return H5T_STD_U32LE;
}

// In parts of at most 64 rows, or 65536 values of a list.
Shape chunk_of(Shape shape) {
  shape.front() = std::min<hsize_t>(shape.front(), shape.size() == 1 ? 1U << 16U : 64U);
  return shape;
}

hid_t file_in_memory() {
  constexpr std::size_t growth = 1U << 20U;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  expect_done(H5Pset_fapl_core(access.id(), growth, false));
  return H5Fcreate("scene.hdf5", H5F_ACC_TRUNC, H5P_DEFAULT, access.id());
}

/// An HDF5 file in memory. The same content gives the same bytes: its objects have no times.
class Hdf5Writer {
public:
  /// An array, compressed.
  template <typename Value>
  void add(const std::string& name, const std::vector<Value>& values, const Shape& shape) {
    constexpr unsigned compression_level = 4;  // h5py's, and so BlenderProc's
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (!values.empty()) {
      const Shape chunk = chunk_of(shape);
      expect_done(H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data()));
      expect_done(H5Pset_deflate(creation.id(), compression_level));
    }
    write(name, type_of(Value{}), space, creation, values.data());
  }

  /// Text, as h5py writes numpy.bytes_.
  void add(const std::string& name, const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    expect_done(H5Tset_size(type.id(), text.size()));
    expect_done(H5Tset_strpad(type.id(), H5T_STR_NULLPAD));
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    write(name, type.id(), space, creation, text.data());
  }

  std::string bytes() const {
    expect_done(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL));
    const auto size = expect_done(H5Fget_file_image(file_.id(), nullptr, 0));
    std::string bytes(static_cast<std::size_t>(size), '\0');
    expect_done(H5Fget_file_image(file_.id(), bytes.data(), bytes.size()));
    return bytes;
  }

private:
  void write(const std::string& name, hid_t type, const Handle& space, const Handle& creation,
             const void* values) {
    expect_done(H5Pset_obj_track_times(creation.id(), false));
    const Handle dataset(
        H5Dcreate2(file_.id(), name.c_str(), type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
        H5Dclose);
    expect_done(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  }

  Handle file_{file_in_memory(), H5Fclose};
};

std::uint16_t instance_of(std::int32_t label) {
  return static_cast<std::uint16_t>(label == null_label ? nothing_in_label_image : label);
}

std::uint8_t category_of(std::int32_t label) {
  if (label == null_label) return category_of_nothing;
  return label == bin_label ? category_of_bin : category_of_tubes;
}

template <typename Value>
std::vector<Value> each(const std::vector<std::int32_t>& labels, Value (*value_of)(std::int32_t)) {
  std::vector<Value> values(labels.size());
  std::ranges::transform(labels, values.begin(), value_of);
  return values;
}

Json attributes_of(const SceneView& view) {
  Json attributes = Json::array();
  const auto add = [&](std::int32_t label, const std::string& name) -> Json& {
    attributes.push_back({{"idx", instance_of(label)}, {"category_id", category_of(label)}, {"name", name}});
    return attributes.back();
  };
  add(bin_label, "bin");
  for (const TubeVisibility& tube : view.occlusions.tubes)
    add(tube.tube, fmt::format("tube_{}", tube.tube))["visible_share"] = tube.share();
  add(null_label, "nothing");
  return attributes;
}

std::string hdf5_of(const ExportScene& scene, const SceneView& view) {
  const DepthImage depth = depth_image(view.scan);
  const std::vector<std::int32_t> labels = label_image(view.scan).labels;
  const PackedMasks masks = packed_whole_masks(view);
  const Shape shape{static_cast<hsize_t>(depth.height), static_cast<hsize_t>(depth.width)};
  Hdf5Writer file;
  file.add("depth", depth.depths, shape);
  file.add("instance_segmaps", each(labels, instance_of), shape);
  file.add("category_id_segmaps", each(labels, category_of), shape);
  file.add("instance_attribute_maps", json_text(attributes_of(view)));
  file.add("whole_mask_starts", masks.starts, {masks.starts.size()});
  file.add("whole_mask_pixels", masks.pixels, {masks.pixels.size()});
  file.add("scene", json_text(view_json(scene, view)));
  return file.bytes();
}

}  // namespace

Format hdf5_format(const Recipe& recipe) {
  expect_done(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));  // does not print
  return file_per_view(recipe, "hdf5", hdf5_of);
}

}  // namespace tanglebin
