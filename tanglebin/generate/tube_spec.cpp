#include "tanglebin/generate/tube_spec.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/mass_properties.hpp"

namespace tanglebin {
namespace {

// More than any tube needs, few enough that a mistyped number does not fill the memory.
constexpr int most_cylinders = 1000;

void expect(bool holds, const std::string& field, const std::string& found, const std::string& expected) {
  if (!holds) throw InputError({"", 0, field}, found, expected);
}

void expect_positive(double value, const std::string& field) {
  expect(std::isfinite(value) && value > 0, field, fmt::format("{}", value), "a positive number");
}

double degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}

void expect_angle(double radians, const std::string& field) {
  expect(radians >= 0 && radians <= std::numbers::pi, field, fmt::format("{:.6g}°", degrees(radians)),
         "an angle from 0 to 180°");
}

void validate_mass(const TubeSpec& spec, const std::string& where) {
  if (spec.density == 0) {
    expect_positive(spec.mass, where + ".mass");
    return;
  }
  expect_positive(spec.density, where + ".density");
  expect(spec.mass == 0, where + ".mass", fmt::format("{}", spec.mass), "0, because there is a density");
}

void validate_sizes(const SegmentSpec& segment, const std::string& where) {
  expect_positive(segment.length, where + "length");
  expect_positive(segment.cylinder_length_min, where + "cylinder_length_min");
  expect(segment.cylinders_min >= 1, where + "cylinders_min", fmt::format("{}", segment.cylinders_min),
         "at least 1");
  expect(segment.cylinders_max >= segment.cylinders_min && segment.cylinders_max <= most_cylinders,
         where + "cylinders_max", fmt::format("{}", segment.cylinders_max),
         fmt::format("from cylinders_min, {}, to {}", segment.cylinders_min, most_cylinders));
  const double shortest = segment.cylinders_max * segment.cylinder_length_min;
  // Three times 0.1 m is a rounding error more than 0.3 m.
  expect(shortest <= segment.length * (1 + 1e-9), where + "cylinders_max",
         fmt::format("{} cylinders of at least {} m, which make {} m", segment.cylinders_max,
                     segment.cylinder_length_min, shortest),
         fmt::format("no more than the length, {} m", segment.length));
}

void validate_bends(const SegmentSpec& segment, const std::string& where) {
  expect_angle(segment.bend_max, where + "bend_max");
  expect_angle(segment.bend_min, where + "bend_min");
  expect(segment.bend_min <= segment.bend_max, where + "bend_min",
         fmt::format("{:.6g}°", degrees(segment.bend_min)),
         fmt::format("at most bend_max, {:.6g}°", degrees(segment.bend_max)));
}

// Segments may be drawn in their order only where each starts at a node that is there already and ends at a
// new one: then they make a tree.
void validate_nodes(const SegmentSpec& segment, const std::string& where, std::set<int>& reached, int nodes) {
  expect(reached.contains(segment.from), where + "from", fmt::format("node {}", segment.from),
         reached.size() == 1 ? "node 1, where the first segment starts"
                             : "node 1 or the end of an earlier segment");
  expect(segment.to >= 1 && segment.to <= nodes, where + "to", fmt::format("node {}", segment.to),
         fmt::format("a node from 2 to {}, one more than the segments", nodes));
  expect(reached.insert(segment.to).second, where + "to",
         fmt::format("node {}, which closes a loop", segment.to), "a node that no earlier segment reaches");
}

}  // namespace

double mass_of(const Tube& tube, const TubeSpec& spec) {
  return spec.density == 0 ? spec.mass : spec.density * mass_properties(tube).volume;
}

void validate(const TubeSpec& spec, const std::string& where) {
  expect_positive(spec.radius, where + ".radius");
  validate_mass(spec, where);
  expect(!spec.segments.empty(), where + ".segment", "none", "at least one segment");
  const int nodes = static_cast<int>(spec.segments.size()) + 1;
  std::set<int> reached{1};
  for (std::size_t i = 0; i < spec.segments.size(); ++i) {
    const std::string place =
        spec.segments.size() == 1 ? where + "." : fmt::format("{}.segment[{}].", where, i);
    validate_nodes(spec.segments[i], place, reached, nodes);
    validate_sizes(spec.segments[i], place);
    validate_bends(spec.segments[i], place);
  }
}

}  // namespace tanglebin
