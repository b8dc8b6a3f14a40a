#include "tanglebin/io/configuration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <istream>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <ostream>
#include <set>
#include <string_view>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/expect.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/cloud_input.hpp"

namespace tanglebin {
namespace {

// How far an edge may deviate from its nodes. The published files have six digits, so their edges are off by
// up to 2 µm, 0.005° and 1e-6.
constexpr double length_tolerance = 1e-4;                         // m
constexpr double angle_tolerance = 0.5 * std::numbers::pi / 180;  // rad
constexpr double unit_tolerance = 1e-4;                           // of a quaternion's norm

constexpr std::string_view tube_fields = "id nodes edges ends";
constexpr std::string_view flat_ends = "flat";
constexpr std::string_view node_fields = "id x y z radius";
constexpr std::string_view edge_fields = "name n1 n2 order radius cx cy cz qw qx qy qz length";

/// Reads the file line by line and its fields by index, and throws errors with their position.
class LineReader {
public:
  LineReader(std::istream& in, const std::string& name) : in_(in), name_(name), input_(in, name) {}

  /// Advances to the next line, which must have the fields listed in `layout`.
  void expect_line(const std::string& what, std::string_view layout) {
    const std::size_t count = words_of(layout).size();
    expect_fields(what, count, count,
                  fmt::format("{} {}: {}", count, count == 1 ? "field" : "fields", layout));
  }

  /// The same, but the last of them may be missing.
  void expect_line_with_option(const std::string& what, std::string_view layout) {
    const std::size_t count = words_of(layout).size();
    expect_fields(what, count - 1, count, fmt::format("{} or {} fields: {}", count - 1, count, layout));
  }

  bool has(std::size_t index) const { return index < fields_.size(); }

  /// Expects only empty lines after the last tube.
  void expect_end(int tubes) {
    while (next_line())
      if (!fields_.empty())
        fail("", excerpt(fields_[0]), fmt::format("the end of the file after tube {} of {}", tubes, tubes));
  }

  std::string_view text(std::size_t index) const { return fields_[index]; }

  int whole_number(std::size_t index, const std::string& field, int least) const {
    const auto value = to_number<int>(fields_[index]);
    if (!value || *value < least)
      fail(field, excerpt(fields_[index]),
           fmt::format("a whole number from {} to {}", least, std::numeric_limits<int>::max()));
    return *value;
  }

  double real_number(std::size_t index, const std::string& field) const {
    const auto value = to_number<double>(fields_[index]);
    if (!value || !std::isfinite(*value)) fail(field, excerpt(fields_[index]), "a finite number");
    return *value;
  }

  double positive_number(std::size_t index, const std::string& field) const {
    const double value = real_number(index, field);
    if (!(value > 0)) fail(field, excerpt(fields_[index]), "a positive number");
    return value;
  }

  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError({name_, line_, field}, found, expected);
  }

private:
  void expect_fields(const std::string& what, std::size_t least, std::size_t most,
                     const std::string& expected) {
    if (!next_line()) fail(what, "the end of the file", expected);
    if (fields_.size() >= least && fields_.size() <= most) return;
    if (fields_.empty()) fail(what, "an empty line", expected);
    fail(what, fmt::format("{} fields from {} on", fields_.size(), excerpt(fields_[0])), expected);
  }

  bool next_line() {
    ++line_;
    fields_.clear();
    const std::optional<std::string_view> text = input_.next_line();
    if (in_.bad()) throw InputError({name_, 0, ""}, "cannot be read");
    if (text) words_of(*text, fields_);
    return text.has_value();
  }

  std::istream& in_;
  const std::string& name_;
  std::size_t line_ = 0;
  cloud_format::CloudInput input_;
  std::vector<std::string_view> fields_;
};

/// Reads one tube.
class TubeReader {
public:
  explicit TubeReader(LineReader& lines) : lines_(lines) {}

  /// `ids` holds the ids of earlier tubes; adds this tube's.
  Tube read(const std::string& what, std::set<int>& ids) {
    lines_.expect_line_with_option(what, tube_fields);
    tube_.id = lines_.whole_number(0, "tube id", 1);
    if (!ids.insert(tube_.id).second) fail_again("tube id", tube_.id);
    const int nodes = lines_.whole_number(1, "number of nodes", 2);
    const int edges = lines_.whole_number(2, "number of edges", 1);
    if (edges != nodes - 1)
      lines_.fail("number of edges", fmt::format("{}", edges),
                  fmt::format("{}, one less than the tree's {} nodes", nodes - 1, nodes));
    if (lines_.has(3) && lines_.text(3) != flat_ends)
      lines_.fail("ends", excerpt(lines_.text(3)), fmt::format("{}, or nothing for round ends", flat_ends));
    tube_.flat_ends = lines_.has(3);
    // Reserves no memory, because the count may be wrong.
    for (int i = 1; i <= nodes; ++i) read_node(fmt::format("node {} of {}", i, nodes));
    boost::disjoint_sets_with_storage<> components(tube_.nodes.size());
    for (int i = 1; i <= edges; ++i) read_edge(fmt::format("edge {} of {}", i, edges), components);
    return std::move(tube_);
  }

private:
  void read_node(const std::string& what) {
    lines_.expect_line(what, node_fields);
    const int id = lines_.whole_number(0, "node id", 1);
    const auto [known, is_new] = indices_.emplace(id, tube_.nodes.size());
    if (!is_new) fail_again("node id", id);
    tube_.nodes.push_back({id, read_point(1, {"x", "y", "z"})});
    const double radius = lines_.positive_number(4, "radius");
    if (tube_.nodes.size() == 1) tube_.radius = radius;
    expect_radius(radius);
  }

  void read_edge(const std::string& what, boost::disjoint_sets_with_storage<>& components) {
    lines_.expect_line(what, edge_fields);
    const Edge edge{
        .from = read_end(1, "n1"), .to = read_end(2, "n2"), .order = lines_.whole_number(3, "order", 1)};
    const EdgeFrame frame{.centre = read_point(5, {"cx", "cy", "cz"}),
                          .rotation = {lines_.real_number(8, "qw"), lines_.real_number(9, "qx"),
                                       lines_.real_number(10, "qy"), lines_.real_number(11, "qz")},
                          .length = lines_.positive_number(12, "length")};
    expect_radius(lines_.positive_number(4, "radius"));
    expect_name(edge);
    if (components.find_set(edge.from) == components.find_set(edge.to))
      lines_.fail("n1 n2", fmt::format("{} {}, which closes a loop", id(edge.from), id(edge.to)),
                  "edges that form a tree");
    components.union_set(edge.from, edge.to);
    expect_agreement(edge, frame);
    tube_.edges.push_back(edge);
  }

  std::size_t read_end(std::size_t index, const std::string& field) const {
    const auto node = indices_.find(lines_.whole_number(index, field, 1));
    if (node == indices_.end())
      lines_.fail(field, excerpt(lines_.text(index)), fmt::format("the id of a node of tube {}", tube_.id));
    return node->second;
  }

  Eigen::Vector3d read_point(std::size_t index, const std::array<const char*, 3>& fields) const {
    return {lines_.real_number(index, fields[0]), lines_.real_number(index + 1, fields[1]),
            lines_.real_number(index + 2, fields[2])};
  }

  void expect_radius(double radius) const {
    if (radius != tube_.radius)
      lines_.fail("radius", fmt::format("{}", radius),
                  fmt::format("{}, the radius of tube {}", tube_.radius, tube_.id));
  }

  void expect_name(const Edge& edge) const {
    const std::string name = fmt::format("e_{}_{}", id(edge.from), id(edge.to));
    if (lines_.text(0) != name) lines_.fail("name", excerpt(lines_.text(0)), excerpt(name));
  }

  // An edge's centre, length and rotation repeat what its nodes say.
  void expect_agreement(const Edge& edge, const EdgeFrame& frame) const {
    const auto [midpoint, rotation, length] = frame_of(tube_, edge);
    const Eigen::Vector3d along = tube_.nodes[edge.to].position - tube_.nodes[edge.from].position;
    if (!((frame.centre - midpoint).norm() <= length_tolerance))
      lines_.fail(
          "cx cy cz", point(frame.centre),
          fmt::format("the midpoint of nodes {} and {}, {}", id(edge.from), id(edge.to), point(midpoint)));
    if (!(std::abs(frame.length - length) <= length_tolerance))
      lines_.fail("length", fmt::format("{}", frame.length),
                  fmt::format("the distance of nodes {} and {}, {:.6g}", id(edge.from), id(edge.to), length));
    if (!(std::abs(frame.rotation.norm() - 1) <= unit_tolerance))
      lines_.fail("qw qx qy qz", fmt::format("a quaternion of norm {:.6g}", frame.rotation.norm()),
                  "a unit quaternion");
    // A direction is only as accurate as its end points.
    const Eigen::Vector3d turned = frame.rotation * Eigen::Vector3d::UnitZ() * length;
    if (!((turned - along).norm() <= std::max(length_tolerance, angle_tolerance * length)))
      lines_.fail("qw qx qy qz", fmt::format("a rotation of +z onto {}", point(turned / length)),
                  fmt::format("the direction from node {} to node {}, {}", id(edge.from), id(edge.to),
                              point(along / length)));
  }

  [[noreturn]] void fail_again(const std::string& field, int id) const {
    lines_.fail(field, fmt::format("{} twice", id), "distinct ids");
  }

  int id(std::size_t node) const { return tube_.nodes[node].id; }

  static std::string point(const Eigen::Vector3d& p) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
  }

  LineReader& lines_;
  Tube tube_;
  std::map<int, std::size_t> indices_;  // of nodes, by id
};

void write_tube(fmt::memory_buffer& text, const Tube& tube) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{} {} {}", tube.id, tube.nodes.size(), tube.edges.size());
  if (tube.flat_ends) fmt::format_to(out, " {}", flat_ends);
  fmt::format_to(out, "\n");
  for (const Node& node : tube.nodes) {
    const Eigen::Vector3d& p = node.position;
    fmt::format_to(out, "{} {} {} {} {}\n", node.id, p.x(), p.y(), p.z(), tube.radius);
  }
  for (const Edge& edge : tube.edges) {
    const int from = tube.nodes[edge.from].id;
    const int to = tube.nodes[edge.to].id;
    const EdgeFrame frame = frame_of(tube, edge);
    fmt::format_to(out, "e_{}_{} {} {} {} {} ", from, to, from, to, edge.order, tube.radius);
    const Eigen::Vector3d& c = frame.centre;
    const Eigen::Quaterniond& q = frame.rotation;
    for (const double value : {c.x(), c.y(), c.z(), q.w(), q.x(), q.y(), q.z()})
      fmt::format_to(out, "{} ", to_billionth(value));
    fmt::format_to(out, "{}\n", to_billionth(frame.length));
  }
}

void expect_distinct_ids(const std::vector<Tube>& tubes) {
  std::set<int> ids;
  for (const Tube& tube : tubes) {
    expect(ids.insert(tube.id).second, "id", fmt::format("{} twice", tube.id), "distinct ids");
  }
}

}  // namespace

std::vector<Tube> read_configuration(std::istream& in, const std::string& name) {
  LineReader lines(in, name);
  lines.expect_line("number of tubes", "tubes");
  const int count = lines.whole_number(0, "number of tubes", 0);
  std::vector<Tube> tubes;
  std::set<int> ids;
  for (int i = 1; i <= count; ++i)
    tubes.push_back(TubeReader(lines).read(fmt::format("tube {} of {}", i, count), ids));
  lines.expect_end(count);
  return tubes;
}

std::vector<Tube> read_configuration(const std::filesystem::path& file) {
  std::ifstream in = open_input(file);
  return read_configuration(in, file.string());
}

void write_configuration(std::ostream& out, const std::vector<Tube>& tubes) {
  validate(tubes);
  expect_distinct_ids(tubes);
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}\n", tubes.size());
  for (const Tube& tube : tubes) write_tube(text, tube);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace tanglebin
