#include "tanglebin/generate/tube_spec.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tanglebin/base/expect.hpp"
#include "tanglebin/generate/bar.hpp"
#include "tanglebin/generate/generate.hpp"
#include "tanglebin/geometry/mass_properties.hpp"

namespace tanglebin {
namespace {

// More than any tube needs, few enough that a mistyped number does not fill the memory.
constexpr int most_cylinders = 1000;

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
    expect(spec.mass >= lightest_tube && spec.mass <= heaviest_tube, where + ".mass",
           fmt::format("{} kg", spec.mass), fmt::format("{} to {} kg", lightest_tube, heaviest_tube));
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
  expect_angle(segment.bend_max, where + "bend_max_deg");
  expect_angle(segment.bend_min, where + "bend_min_deg");
  expect(segment.bend_min <= segment.bend_max, where + "bend_min_deg",
         fmt::format("{:.6g}°", degrees(segment.bend_min)),
         fmt::format("at most bend_max_deg, {:.6g}°", degrees(segment.bend_max)));
}

// Where the tube goes round a corner closer to a flat end, the sphere at that corner would stand out of it.
void expect_straight_end(double length, double radius, const std::string& field) {
  expect(length >= radius, field, fmt::format("{}", length),
         fmt::format("at least the radius, {} m, because the ends are flat", radius));
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

void validate_segments(const TubeSpec& spec, const std::string& where) {
  expect(!spec.segments.empty(), where + ".segment", "none", "at least one segment");
  const int nodes = static_cast<int>(spec.segments.size()) + 1;
  std::set<int> reached{1};
  for (std::size_t i = 0; i < spec.segments.size(); ++i) {
    const std::string place =
        spec.segments.size() == 1 ? where + "." : fmt::format("{}.segment[{}].", where, i);
    validate_nodes(spec.segments[i], place, reached, nodes);
    validate_sizes(spec.segments[i], place);
    validate_bends(spec.segments[i], place);
    if (spec.flat_ends)
      expect_straight_end(spec.segments[i].cylinder_length_min, spec.radius, place + "cylinder_length_min");
  }
}

void validate_arc(const Piece& arc, double radius, const std::string& where) {
  expect_angle(arc.bend, where + ".bend_deg");
  expect(std::isfinite(arc.twist), where + ".twist_deg", fmt::format("{}", arc.twist), "a finite angle");
  expect(std::isfinite(arc.bend_radius) && arc.bend_radius >= radius, where + ".bend_radius",
         fmt::format("{}", arc.bend_radius), fmt::format("at least the bar's radius, {} m", radius));
}

void validate_pieces(const TubeSpec& spec, const std::string& where) {
  double cylinders = 0;
  for (std::size_t i = 0; i < spec.pieces.size(); ++i) {
    const Piece& piece = spec.pieces[i];
    const std::string place = fmt::format("{}.piece[{}]", where, i);
    if (piece.length != 0 || piece.bend == 0) {
      expect_positive(piece.length, place + ".length");
      expect(piece.bend == 0, place + ".bend_deg", fmt::format("{:.6g}°", degrees(piece.bend)),
             "0, because the piece is straight");
    } else {
      validate_arc(piece, spec.radius, place);
    }
    cylinders += chords_of(piece);
    expect(cylinders <= most_cylinders, place, fmt::format("{} cylinders up to here", cylinders),
           fmt::format("at most {} in a bar", most_cylinders));
  }
  if (spec.flat_ends) {
    expect_straight_end(spec.pieces.front().length, spec.radius, where + ".piece[0].length");
    expect_straight_end(spec.pieces.back().length, spec.radius,
                        fmt::format("{}.piece[{}].length", where, spec.pieces.size() - 1));
  }
  expect(!passes_through_itself(straight_up_bar(spec, 1)), where + ".piece",
         "a bar that passes through itself", "smaller bends or longer pieces");
}

}  // namespace

double mass_of(const Tube& tube, const TubeSpec& spec) {
  return spec.density == 0 ? spec.mass : spec.density * mass_properties(tube).volume;
}

std::vector<Segment> segments_of(const TubeSpec& spec) {
  if (spec.pieces.empty()) return {spec.segments.begin(), spec.segments.end()};
  Segment bar{.from = 1, .to = 2, .length = 0};
  for (const Piece& piece : spec.pieces) bar.length += length_of(piece);
  return {bar};
}

void validate(const TubeSpec& spec, const std::string& where) {
  expect_positive(spec.radius, where + ".radius");
  validate_mass(spec, where);
  if (spec.pieces.empty()) {
    validate_segments(spec, where);
    return;
  }
  expect(spec.segments.empty(), where + ".segment", fmt::format("{} segments", spec.segments.size()),
         "none, because there are pieces");
  validate_pieces(spec, where);
}

}  // namespace tanglebin
