#pragma once

#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/pictures/shading.hpp"
#include "tanglebin/pictures/view.hpp"

namespace tanglebin {

/// A shaded picture of tubes, in label_colors(), in their bin, whose walls on the viewer's side are
/// transparent, or on the part of a plane that is under them. Throws InputError with `name` for tubes beyond
/// farthest_in_picture, for no tube and no bin, or for an invalid view.
Picture picture_of_tubes(const std::vector<Tube>& tubes, const Support& support, const View& view,
                         const std::string& name);

/// A shaded picture of a cloud as a surface, coloured by label_colors() if it has labels, or else by its own
/// colours, or else by height (z). NaN points are left out. Throws InputError with `name` for a cloud without
/// points, for points beyond farthest_in_picture, or for an invalid view.
Picture picture_of_cloud(const PointCloud& cloud, const View& view, const std::string& name);

}  // namespace tanglebin
