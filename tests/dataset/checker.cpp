#include "tests/dataset/checker.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace checker {
namespace {

using Eigen::Vector3d;

constexpr double overlap_max = 0.0003;
constexpr double length_tolerance = 1e-6;     // of a tube, and of a cylinder against its nodes
constexpr double shortness_tolerance = 1e-8;  // files are rounded to nanometres
constexpr double bend_tolerance_deg = 1e-4;

struct Cylinder {
  int from;
  int to;
  int order;
  Vector3d a;  // where its nodes are
  Vector3d b;
  Vector3d centre;  // and what the file says besides
  Eigen::Quaterniond rotation;
  double length;
};

struct Chain {
  int id = 0;
  std::vector<double> radii;  // of all nodes and cylinders
  std::vector<Cylinder> cylinders;
};

// Reading: numbers one after the other, whatever the lines.

template <typename Value>
Value next(std::istream& in, const std::string& what) {
  Value value{};
  if (!(in >> value)) throw std::runtime_error("no " + what);
  return value;
}

Vector3d next_point(std::istream& in, const std::string& what) {
  const auto x = next<double>(in, what);
  const auto y = next<double>(in, what);
  const auto z = next<double>(in, what);
  return {x, y, z};
}

Cylinder read_cylinder(std::istream& in, const std::map<int, Vector3d>& nodes, std::vector<double>& radii) {
  next<std::string>(in, "name of a cylinder");
  Cylinder cylinder{};
  cylinder.from = next<int>(in, "first node of a cylinder");
  cylinder.to = next<int>(in, "second node of a cylinder");
  if (!nodes.contains(cylinder.from) || !nodes.contains(cylinder.to)) {
    throw std::runtime_error(fmt::format("no node {} or {}", cylinder.from, cylinder.to));
  }
  cylinder.a = nodes.at(cylinder.from);
  cylinder.b = nodes.at(cylinder.to);
  cylinder.order = next<int>(in, "order of a cylinder");
  radii.push_back(next<double>(in, "radius of a cylinder"));
  cylinder.centre = next_point(in, "centre of a cylinder");
  cylinder.rotation.w() = next<double>(in, "rotation of a cylinder");
  cylinder.rotation.vec() = next_point(in, "rotation of a cylinder");
  cylinder.length = next<double>(in, "length of a cylinder");
  return cylinder;
}

Chain read_chain(std::istream& in) {
  Chain chain;
  chain.id = next<int>(in, "tube");
  const int nodes = next<int>(in, "number of nodes");
  const int cylinders = next<int>(in, "number of cylinders");
  if (cylinders < 1) throw std::runtime_error("no cylinders");
  std::map<int, Vector3d> positions;
  for (int i = 0; i < nodes; ++i) {
    const int id = next<int>(in, "node");
    positions[id] = next_point(in, "position of a node");
    chain.radii.push_back(next<double>(in, "radius of a node"));
  }
  for (int i = 0; i < cylinders; ++i) chain.cylinders.push_back(read_cylinder(in, positions, chain.radii));
  std::ranges::sort(chain.cylinders, {}, &Cylinder::order);
  return chain;
}

std::vector<Chain> read_chains(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot be opened");
  in.imbue(std::locale::classic());
  std::vector<Chain> chains;
  const int count = next<int>(in, "number of tubes");
  for (int i = 0; i < count; ++i) chains.push_back(read_chain(in));
  std::string rest;
  if (in >> rest) throw std::runtime_error("more than its tubes: " + rest);
  return chains;
}

// Measuring.

// The least value between a and b of a function that is convex along the way: it is next to the best of some
// equidistant points. Look there again, closer.
template <typename Function>
double least_between(const Vector3d& a, const Vector3d& b, const Function& function) {
  constexpr int steps = 16;
  double least = std::numeric_limits<double>::infinity();
  double best = 0;
  double low = 0;
  double high = 1;
  while (high - low > 1e-10) {
    const double step = (high - low) / steps;
    for (int i = 0; i <= steps; ++i) {
      const double t = low + step * i;
      const double value = function(a + t * (b - a));
      if (value < least) {
        least = value;
        best = t;
      }
    }
    low = std::max(0.0, best - step);
    high = std::min(1.0, best + step);
  }
  return least;
}

double distance(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double share = along.dot(point - a) / along.squaredNorm();
  if (!(share > 0)) return (point - a).norm();  // or a is b
  if (share > 1) return (point - b).norm();
  return (point - a).cross(along).norm() / along.norm();
}

double distance(const Cylinder& first, const Cylinder& second) {
  return least_between(first.a, first.b, [&](const Vector3d& p) { return distance(p, second.a, second.b); });
}

// Of two tubes, as the spheres along their centre lines are.
double overlap(const Chain& first, const Chain& second, double radius) {
  double deepest = 0;
  for (const Cylinder& one : first.cylinders) {
    for (const Cylinder& other : second.cylinders) {
      deepest = std::max(deepest, 2 * radius - distance(one, other));
    }
  }
  return deepest;
}

double depth_in_floor(const Chain& chain, double radius) {
  double deepest = 0;
  for (const Cylinder& cylinder : chain.cylinders) {
    deepest = std::max(deepest, radius - std::min(cylinder.a.z(), cylinder.b.z()));
  }
  return deepest;
}

// The wall across the axis (0: x, 1: y) on the side (−1 or 1).
double depth_in_wall(const Chain& chain, const CheckerBin& bin, int axis, double side, double radius) {
  const Eigen::Vector2d inside(bin.length / 2, bin.width / 2);
  const auto distance_from_wall = [&](const Vector3d& point) {
    const double inwards = inside[axis] - side * point[axis];
    const double outwards = -inwards - bin.wall;
    const double beside = std::abs(point[1 - axis]) - inside[1 - axis] - bin.wall;
    const double vertical = std::max(point.z() - bin.rim, -point.z());
    const Vector3d gaps(std::max(inwards, outwards), beside, vertical);
    return gaps.cwiseMax(0).norm();
  };
  double deepest = 0;
  for (const Cylinder& cylinder : chain.cylinders) {
    deepest = std::max(deepest, radius - least_between(cylinder.a, cylinder.b, distance_from_wall));
  }
  return deepest;
}

// The mean of the centre line.
Vector3d centre(const Chain& chain) {
  Vector3d sum = Vector3d::Zero();
  double length = 0;
  for (const Cylinder& cylinder : chain.cylinders) {
    const double weight = (cylinder.b - cylinder.a).norm();
    sum += weight * (cylinder.a + cylinder.b) / 2;
    length += weight;
  }
  return sum / length;
}

double bend_deg(const Cylinder& before, const Cylinder& after) {
  const Vector3d u = before.b - before.a;
  const Vector3d v = after.b - after.a;
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
}

// Judging.

class Judge {
public:
  Judge(const CheckerBin& bin, const CheckerTube& expected) : bin_(bin), expected_(expected) {}

  void judge_number(std::size_t found, int tubes) {
    what_ = "file";
    expect(static_cast<int>(found) == tubes, fmt::format("{} tubes, not {}", found, tubes));
  }

  void judge_tube(const Chain& chain) {
    what_ = fmt::format("tube {}", chain.id);
    judge_sizes(chain);
    judge_structure(chain);
    judge_bends(chain);
    judge_place(chain);
  }

  void judge_pair(const Chain& first, const Chain& second) {
    what_ = fmt::format("tubes {} and {}", first.id, second.id);
    const double depth = overlap(first, second, expected_.radius);
    expect(depth <= overlap_max, fmt::format("overlap by {:.3f} mm", 1e3 * depth));
  }

  std::vector<std::string> faults() { return std::move(faults_); }

private:
  // A comparison with something that is not a number does not hold, and so is a fault.
  void expect(bool holds, const std::string& otherwise) {
    if (!holds) faults_.push_back(what_ + ": " + otherwise);
  }

  void judge_sizes(const Chain& chain) {
    for (const double radius : chain.radii) {
      expect(radius == expected_.radius, fmt::format("a radius of {}, not {}", radius, expected_.radius));
    }
    double length = 0;
    for (const Cylinder& cylinder : chain.cylinders) {
      const double part = (cylinder.b - cylinder.a).norm();
      expect(part >= expected_.cylinder_min - shortness_tolerance,
             fmt::format("cylinder {} is {:.6f} m long, less than {}", cylinder.order, part,
                         expected_.cylinder_min));
      length += part;
    }
    expect(std::abs(length - expected_.length) <= length_tolerance,
           fmt::format("{:.7f} m long, not {}", length, expected_.length));
  }

  void judge_structure(const Chain& chain) {
    int node = 1;
    int order = 1;
    for (const Cylinder& cylinder : chain.cylinders) {
      expect(cylinder.order == order++ && cylinder.from == node,
             fmt::format("cylinder {} does not go on from node {}", cylinder.order, node));
      node = cylinder.to;
      const Vector3d along = cylinder.b - cylinder.a;
      const Vector3d said = cylinder.rotation * Vector3d(0, 0, cylinder.length);
      expect((said - along).norm() <= length_tolerance &&
                 (cylinder.centre - (cylinder.a + cylinder.b) / 2).norm() <= length_tolerance,
             fmt::format("cylinder {} contradicts its nodes", cylinder.order));
    }
    expect(node == 2, fmt::format("ends at node {}, not 2", node));
  }

  void judge_bends(const Chain& chain) {
    for (std::size_t i = 1; i < chain.cylinders.size(); ++i) {
      const double bend = bend_deg(chain.cylinders[i - 1], chain.cylinders[i]);
      expect(bend >= expected_.bend_min_deg - bend_tolerance_deg &&
                 bend <= expected_.bend_max_deg + bend_tolerance_deg,
             fmt::format("bend {} is {:.4f}°, not {} to {}°", i, bend, expected_.bend_min_deg,
                         expected_.bend_max_deg));
    }
  }

  void judge_place(const Chain& chain) {
    const double in_floor = depth_in_floor(chain, expected_.radius);
    expect(in_floor <= overlap_max, fmt::format("{:.3f} mm in the floor", 1e3 * in_floor));
    for (const int axis : {0, 1}) {
      for (const double side : {-1.0, 1.0}) {
        const double in_wall = depth_in_wall(chain, bin_, axis, side, expected_.radius);
        expect(in_wall <= overlap_max, fmt::format("{:.3f} mm in the wall at {}{}", 1e3 * in_wall,
                                                   side < 0 ? '-' : '+', axis == 0 ? 'x' : 'y'));
      }
    }
    const Vector3d middle = centre(chain);
    expect(std::abs(middle.x()) < bin_.length / 2 && std::abs(middle.y()) < bin_.width / 2,
           fmt::format("its centre, ({:.4f}, {:.4f}), is not between the walls", middle.x(), middle.y()));
  }

  CheckerBin bin_;
  CheckerTube expected_;
  std::string what_;  // is judged
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> faults_of(const std::string& configuration_file, const CheckerBin& bin,
                                   const CheckerTube& tube, int tubes) {
  std::vector<Chain> chains;
  try {
    chains = read_chains(configuration_file);
  } catch (const std::runtime_error& error) {
    return {configuration_file + ": " + error.what()};
  }
  Judge judge(bin, tube);
  judge.judge_number(chains.size(), tubes);
  for (auto chain = chains.begin(); chain != chains.end(); ++chain) {
    judge.judge_tube(*chain);
    for (auto other = std::next(chain); other != chains.end(); ++other) judge.judge_pair(*chain, *other);
  }
  return judge.faults();
}

}  // namespace checker
