#pragma once

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/cloud/images.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

/// Which pixels of a scan become points.
enum class CloudOf { tubes, tubes_and_bin };

/// Which optional properties the points of a scan get beside label and colour.
struct PointProperties {
  bool normals = false;
  bool intensities = false;  ///< 1 where the scanner knows no signal
  bool mixed = false;

  bool operator==(const PointProperties&) const = default;
};

/// The unordered cloud of a scan, in the order of its pixels, labelled and coloured with label_colors().
PointCloud cloud_from_scan(const Scan& scan, CloudOf what, int tubes, const PointProperties& properties = {});

/// The organized cloud of the whole image: NaN, null, intensity 0 and not mixed where a pixel has no point.
PointCloud organized_cloud_from_scan(const Scan& scan, CloudOf what, int tubes,
                                     const PointProperties& properties = {});

/// The depths and the labels of the whole image.
DepthImage depth_image(const Scan& scan);
LabelImage label_image(const Scan& scan);

}  // namespace tanglebin
