#include <Eigen/Geometry>
#include <cstdint>
#include <utility>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/export/archive.hpp"
#include "tanglebin/export/format.hpp"
#include "tanglebin/io/write_npy.hpp"
#include "tanglebin/scan/scan_output.hpp"

namespace tanglebin {
namespace {

/// Collects named arrays in a zip file, as numpy.savez_compressed() does.
class NpzWriter {
public:
  template <typename Value>
  void add(const std::string& name, const std::vector<Value>& values, const NpyShape& shape) {
    archive_.add(name + ".npy", npy_bytes(values, shape));
  }

  template <typename Value>
  void add(const std::string& name, const std::vector<Value>& values) {
    add(name, values, {values.size()});
  }

  // Vectors as rows.
  template <typename Scalar, int size>
  void add(const std::string& name, const std::vector<Eigen::Matrix<Scalar, size, 1>>& vectors) {
    std::vector<Scalar> values;
    values.reserve(vectors.size() * size);
    for (const auto& vector : vectors) values.insert(values.end(), vector.data(), vector.data() + size);
    add(name, values, {vectors.size(), size});
  }

  std::string bytes() {
    archive_.close();
    return std::move(bytes_);
  }

private:
  std::string bytes_;
  ArchiveWriter archive_{ArchiveWriter::Format::zip, [this](std::string_view piece) { bytes_ += piece; }};
};

// What `value_of` gives of each item.
template <typename Item, typename ValueOf>
auto each(const std::vector<Item>& items, const ValueOf& value_of) {
  std::vector<decltype(value_of(items.front()))> values;
  values.reserve(items.size());
  for (const Item& item : items) values.push_back(value_of(item));
  return values;
}

std::int32_t int32(std::size_t number) {
  return static_cast<std::int32_t>(number);
}

void add_images(NpzWriter& npz, const SceneView& view) {
  const DepthImage depth = depth_image(view.scan);
  const LabelImage labels = label_image(view.scan);
  const NpyShape shape{static_cast<std::size_t>(depth.height), static_cast<std::size_t>(depth.width)};
  npz.add("depth", depth.depths, shape);
  npz.add("labels", labels.labels, shape);
}

void add_camera(NpzWriter& npz, const Camera& camera) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose = camera.pose.matrix();
  npz.add("intrinsics", std::vector{camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0},
          {3, 3});
  npz.add("camera_to_world", std::vector<double>(pose.data(), pose.data() + pose.size()), {4, 4});
}

void add_points(NpzWriter& npz, const ExportScene& scene, const SceneView& view) {
  const CloudOf what = scene.recipe.output.bin_points ? CloudOf::tubes_and_bin : CloudOf::tubes;
  const PointCloud cloud = cloud_from_scan(view.scan, what, scene.id.tubes);
  npz.add("points", cloud.points);
  npz.add("point_labels", cloud.labels);
}

void add_whole_masks(NpzWriter& npz, const SceneView& view) {
  const PackedMasks masks = packed_whole_masks(view);
  npz.add("whole_mask_starts", masks.starts);
  npz.add("whole_mask_pixels", masks.pixels);
}

void add_occlusions(NpzWriter& npz, const Occlusions& seen) {
  npz.add("whole_pixels", each(seen.tubes, [](const TubeVisibility& tube) { return int32(tube.whole); }));
  npz.add("visible_pixels", each(seen.tubes, [](const TubeVisibility& tube) { return int32(tube.visible); }));
  npz.add("visible_share", each(seen.tubes, [](const TubeVisibility& tube) { return tube.share(); }));
  npz.add("crossing_over", each(seen.crossings, [](const Crossing& crossing) { return crossing.over; }));
  npz.add("crossing_under", each(seen.crossings, [](const Crossing& crossing) { return crossing.under; }));
  npz.add("crossing_pixels",
          each(seen.crossings, [](const Crossing& crossing) { return int32(crossing.pixels); }));
  npz.add("crossing_visible_pixels",
          each(seen.crossings, [](const Crossing& crossing) { return int32(crossing.visible); }));
  npz.add("crossing_pixel", each(seen.crossings, [](const Crossing& crossing) { return crossing.pixel; }));
  npz.add("crossing_point", each(seen.crossings, [](const Crossing& crossing) { return crossing.point; }));
}

void add_contacts(NpzWriter& npz, const std::vector<Contact>& contacts) {
  npz.add("contact_tube", each(contacts, [](const Contact& contact) { return contact.tube; }));
  npz.add("contact_other", each(contacts, [](const Contact& contact) { return contact.other; }));
  npz.add("contact_bin_part", each(contacts, [](const Contact& contact) {
            return contact.bin_part ? int32(*contact.bin_part) : -1;
          }));
  npz.add("contact_point", each(contacts, [](const Contact& contact) { return contact.point; }));
  npz.add("contact_gap", each(contacts, [](const Contact& contact) { return contact.gap; }));
}

// Nodes and edges of all tubes one after the other.
void add_tubes(NpzWriter& npz, const std::vector<Tube>& tubes) {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<std::int32_t> tube_of_node;
  std::vector<Eigen::Vector2i> edges;
  for (const Tube& tube : tubes) {
    const std::size_t first = nodes.size();
    for (const Edge& edge : tube.edges) edges.emplace_back(int32(first + edge.from), int32(first + edge.to));
    for (const Node& node : tube.nodes) {
      nodes.push_back(node.position);
      tube_of_node.push_back(tube.id);
    }
  }
  npz.add("tube_radius", each(tubes, [](const Tube& tube) { return tube.radius; }));
  npz.add("node_position", nodes);
  npz.add("node_tube", tube_of_node);
  npz.add("edge_nodes", edges);
}

std::string npz_of(const ExportScene& scene, const SceneView& view) {
  NpzWriter npz;
  add_images(npz, view);
  add_camera(npz, view.scan.camera);
  add_points(npz, scene, view);
  add_whole_masks(npz, view);
  add_occlusions(npz, view.occlusions);
  add_contacts(npz, scene.contacts);
  add_tubes(npz, scene.tubes);
  return npz.bytes();
}

}  // namespace

Format numpy_format(const Recipe& recipe) {
  return file_per_view(recipe, "npz", npz_of);
}

}  // namespace tanglebin
