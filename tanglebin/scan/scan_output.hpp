#pragma once

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/cloud/images.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

/// Which surfaces become points.
enum class CloudOf { tubes, tubes_and_bin };

/// Optional properties of the points, in addition to label and colour.
struct PointProperties {
  bool normals = false;
  bool intensities = false;  ///< 1 if the scanner does not model the signal
  bool mixed = false;

  bool operator==(const PointProperties&) const = default;
};

/// The unordered cloud of a scan, in pixel order, labelled and coloured with label_colors(). Throws
/// InputError naming `tubes` unless that is at least the largest label.
PointCloud cloud_from_scan(const Scan& scan, CloudOf what, int tubes, const PointProperties& properties = {});

/// The organized cloud of the whole image. Pixels without a point are NaN, null, of intensity 0 and not
/// mixed. Throws InputError as cloud_from_scan() does.
PointCloud organized_cloud_from_scan(const Scan& scan, CloudOf what, int tubes,
                                     const PointProperties& properties = {});

/// Depth and labels of the whole image.
DepthImage depth_image(const Scan& scan);
LabelImage label_image(const Scan& scan);

}  // namespace tanglebin
