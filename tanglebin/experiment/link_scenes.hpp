#pragma once

#include <vector>

#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/model/axis/links/links.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// The fragments of one kind of tube that the axis method finds in a cloud, and all links that it considers,
/// however unlikely.
struct LinkScene {
  TubeKind kind;
  std::vector<Fragment> fragments;
  std::vector<Link> links;
  std::vector<bool> is_true;  ///< for each link, whether a tube really has it
  RangeImage seen;
};

/// What a scanner's cloud of a case in the dataset shows, for each kind of tube. A link is true if most
/// points of both fragments are on one tube, the fragments face each other along it, and no other fragment of
/// the tube is in between. Throws InputError as read_seen_case() does.
std::vector<LinkScene> link_scenes(const Dataset& dataset, const SeenCase& seen);

}  // namespace tanglebin
