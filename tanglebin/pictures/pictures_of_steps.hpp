#pragma once

#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/paper/paper_method.hpp"
#include "tanglebin/pictures/shading.hpp"

namespace tanglebin {

/// A picture with a file name, without extension.
struct NamedPicture {
  std::string name;
  Picture picture;
};

/// The result of each step of the paper's method (as in the figures of its Section 4), seen from nearly
/// above: "1-filtered" shows the points by height, "2-segmented" a colour for each cluster and black for
/// points in none, "3-fitted" the cylinders, "4-joined" and "5-labelled" a colour for each tube and black for
/// null. A step without a result has no picture. `cloud` is the modelled cloud; `name` is for messages.
std::vector<NamedPicture> pictures_of_steps(const PointCloud& cloud, const PaperModel& steps,
                                            const Support& support, double radius, const std::string& name);

/// The same for the axis method: "1-filtered", "2-votes" with a colour for each fragment and black for votes
/// in none, "3-joined" and "4-labelled".
std::vector<NamedPicture> pictures_of_steps(const PointCloud& cloud, const AxisModel& steps,
                                            const Support& support, const std::string& name);

}  // namespace tanglebin
