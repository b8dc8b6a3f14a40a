#include "tanglebin/geometry/support.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/millimetres.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/geometry/rigid.hpp"

namespace tanglebin {

std::string name_of(Support::Shape shape) {
  switch (shape) {
    case Support::Shape::bin:
      return "bin";
    case Support::Shape::plane:
      return "plane";
    case Support::Shape::nothing:
      break;
  }
  return "nothing";
}

Support::Shape shape_named(const std::string& name) {
  for (const auto shape : {Support::Shape::bin, Support::Shape::plane, Support::Shape::nothing}) {
    if (name_of(shape) == name) return shape;
  }
  throw InputError({.file = "", .line = 0, .field = "support.shape"}, excerpt(name), "bin, plane or nothing");
}

std::vector<Eigen::AlignedBox3d> solid_parts(const Support& support) {
  constexpr double thickness = 0.02;
  constexpr double far = std::numeric_limits<double>::infinity();
  switch (support.shape) {
    case Support::Shape::bin: {
      const auto parts = boxes(support.bin);
      return {parts.begin(), parts.end()};
    }
    case Support::Shape::plane:
      return {{Eigen::Vector3d(-far, -far, -thickness), Eigen::Vector3d(far, far, 0)}};
    case Support::Shape::nothing:
      break;
  }
  return {};
}

std::vector<Eigen::AlignedBox3d> surely_solid_parts(const Support& support) {
  Support widest = support;
  widest.bin.length += 2 * support.margin;
  widest.bin.width += 2 * support.margin;
  std::vector<Eigen::AlignedBox3d> parts = solid_parts(widest);
  for (Eigen::AlignedBox3d& part : parts) part.translate(Eigen::Vector3d(0, 0, -support.margin));
  return parts;
}

bool holds_only_tubes(const Support& support) {
  return support.shape == Support::Shape::bin && support.margin == 0;
}

void validate(const Support& support) {
  if (support.shape == Support::Shape::bin) validate(support.bin);
  if (!is_rigid(support.pose))
    throw InputError({.file = "", .line = 0, .field = "support.pose"}, "a matrix that is no rigid motion",
                     "finite numbers: a rotation, and a position in metres");
  constexpr double most = 0.1;
  if (!(support.margin >= 0 && support.margin <= most))
    throw InputError({.file = "", .line = 0, .field = "support.margin"}, fmt::format("{} m", support.margin),
                     fmt::format("0 to {} m{}", most, hint_of_millimetres(support.margin, most)));
}

}  // namespace tanglebin
