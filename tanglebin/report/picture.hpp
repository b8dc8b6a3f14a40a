#pragma once

#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/report/shading.hpp"
#include "tanglebin/report/view.hpp"

namespace tanglebin {

/// A shaded picture of tubes in label_colors() and of the bin, whose walls on the viewer's side are as of
/// glass. Throws InputError with `name` for tubes beyond farthest_in_picture, or for a view that is none.
Picture picture_of_tubes(const std::vector<Tube>& tubes, const Bin& bin, const View& view,
                         const std::string& name);

/// A shaded picture of a cloud as a surface: in label_colors() where it has labels, else in its own colours,
/// else coloured by height (z). Points that are NaN are left out. Throws InputError with `name` for a cloud
/// without points or with one beyond farthest_in_picture, or for a view that is none.
Picture picture_of_cloud(const PointCloud& cloud, const View& view, const std::string& name);

}  // namespace tanglebin
