#pragma once

#include <string_view>

namespace tanglebin {

/// What becomes of a pixel whose footprint straddles an edge.
enum class Edges {
  keep,  ///< nothing: a pixel is the ray through its centre
  drop,  ///< it is lost
  mix,   ///< it is a flying pixel: the mean of the depths that it sees, weighted by their signals
};

/// How a scanner falls short of the ideal one: terms that can be switched on one by one (docs/sensor.md). As
/// it stands nothing is on, and the scanner is ideal.
struct Sensor {
  // Noise of any scanner
  double sigma = 0.0;    ///< m, standard deviation of the range, along the ray; 0: off
  double dropout = 0.0;  ///< share of pixels that are lost at random; 0: off

  // A pixel is an area
  Edges edges = Edges::keep;  ///< keep: off
  double footprint = 1.0;     ///< pixels, side of the square that a pixel sees
  int sub_rays = 3;           ///< along either side of the footprint
  double edge_jump = 0.005;   ///< m, difference in depth within a footprint that makes an edge

  // The projector, beside the camera along the camera's x axis, tilted towards the point of the optical axis
  // at the working distance; its image is the camera's
  bool shadows = false;           ///< what the projector cannot see is lost
  double baseline = 0.2;          ///< m, from camera to projector
  double working_distance = 2.0;  ///< m, along the optical axis

  // The signal that comes back
  bool signal = false;       ///< false: the signal-to-noise ratio is 1 everywhere
  double snr = 2.0;          ///< of a matt white surface at the working distance that faces both ways
  double snr_min = 0.15;     ///< a pixel is lost below
  double snr_max = 2.5;      ///< a pixel is lost above: saturation
  double albedo_min = 0.35;  ///< each tube's diffuse reflectance is drawn between these
  double albedo_max = 0.65;
  double gloss_min = 0.1;  ///< each tube's highlight, in units of `snr`, is drawn between these
  double gloss_max = 1.0;
  double shininess = 60.0;  ///< exponent of the highlight (Phong)
  double bin_albedo = 0.4;  ///< the bin's
  double bin_gloss = 0.05;  ///< the bin's

  // Noise of the disparity, in pixels of the camera, at a signal-to-noise ratio of 1
  double disparity_sigma = 0.0;  ///< px; 0: off

  // A smooth error of calibration, along the ray
  double trueness = 0.0;           ///< m, standard deviation; 0: off
  double trueness_length = 400.0;  ///< pixels over which it changes

  /// Axial and lateral noise of the Kinect (Nguyen, Izadi and Lovell 2012)
  bool kinect_noise = false;

  bool operator==(const Sensor&) const = default;
};

/// Is no term switched on?
bool is_ideal(const Sensor& sensor);

/// How the scanner of this name (camera_preset()) falls short of the ideal one (docs/sensor.md).
/// "paper": not at all. "gaussian": range noise of 0.5 mm, 2 % drop-outs, edges dropped. "zivid-one-plus-l":
/// all terms of structured light. "kinect-v1": Nguyen, Izadi and Lovell's noise.
/// Throws InputError for another name.
Sensor sensor_preset(std::string_view name);

/// Throws InputError naming the field under `scanner` that makes no sense, and the remedy.
void validate(const Sensor& sensor);

}  // namespace tanglebin
