// Scores an algorithm on clouds with true labels: score_my_algorithm DATASET/A10/plys/1.ply …
// Put yours in the place of label_points(). The same in Python: python/examples/score_my_algorithm.py.
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace {

using Cell = std::array<int, 3>;

// Gives a label to a cell and all cells that are connected with it.
void spread(std::map<Cell, std::int32_t>& labels, const Cell& first, std::int32_t label) {
  std::vector<Cell> next{first};
  while (!next.empty()) {
    const auto [x, y, z] = next.back();
    next.pop_back();
    const auto found = labels.find({x, y, z});
    if (found == labels.end() || found->second != tanglebin::null_label) continue;
    found->second = label;
    for (int step = 0; step < 27; ++step)
      next.push_back({x + step % 3 - 1, y + step / 3 % 3 - 1, z + step / 9 - 1});
  }
}

// An example to be beaten: points in neighbouring cells of 2 cm belong together. Points in m, world frame.
std::vector<std::int32_t> label_points(const std::vector<Eigen::Vector3f>& points) {
  const auto cell_of = [](const Eigen::Vector3f& point) {
    const Eigen::Vector3i cell = (point / 0.02F).array().floor().cast<int>();
    return Cell{cell.x(), cell.y(), cell.z()};
  };
  std::map<Cell, std::int32_t> cells;
  for (const Eigen::Vector3f& point : points) cells[cell_of(point)] = tanglebin::null_label;
  std::int32_t tubes = 0;
  for (const auto& [cell, label] : cells) {
    if (label == tanglebin::null_label) spread(cells, cell, ++tubes);
  }
  std::vector<std::int32_t> labels;
  labels.reserve(points.size());
  for (const Eigen::Vector3f& point : points) labels.push_back(cells[cell_of(point)]);
  return labels;
}

// The algorithm sees the points on tubes only; those on the bin have label 0.
double micro_recall(const std::string& file) {
  const tanglebin::PointCloud cloud = tanglebin::read_cloud(std::filesystem::path(file));
  const std::vector<std::int32_t> labels = tanglebin::truth_labels(cloud, file);
  std::vector<Eigen::Vector3f> points;
  std::vector<std::int32_t> truth;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (labels[i] <= tanglebin::bin_label) continue;
    points.push_back(cloud.points[i]);
    truth.push_back(labels[i]);
  }
  return tanglebin::score(truth, label_points(points)).micro_recall;
}

}  // namespace

int main(int argc, char** argv) try {
  for (const std::string& file : std::vector<std::string>(argv + 1, argv + argc))
    std::cout << file << ": micro-recall " << micro_recall(file) << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
