#pragma once

#include <string_view>

namespace tanglebin {

/// What happens to a pixel whose footprint straddles an edge.
enum class Edges {
  keep,  ///< nothing: the pixel is the ray through its centre
  drop,  ///< the pixel is lost
  mix,  ///< it becomes a mixed pixel: the mean of the depths that it sees, weighted by signal, with the label
        ///< of the surface that it sees most of
};

/// The errors of a real scanner, as terms that can be switched on one by one (docs/sensor.md). By default all
/// are off, and the scanner is ideal.
struct Sensor {
  // Noise, for any scanner
  double sigma = 0.0;    ///< m, standard deviation of the range, along the ray; 0: off
  double dropout = 0.0;  ///< fraction of pixels lost at random; 0: off
  /// Of the range noise `sigma` in one pixel with that in the pixel below it; 0: off. It falls off
  /// geometrically down the column.
  double column_correlation = 0.0;

  // A pixel is an area
  Edges edges = Edges::keep;  ///< keep: off
  double footprint = 1.0;     ///< pixels, side of the square that a pixel covers
  int sub_rays = 3;           ///< along each side of the footprint
  double edge_jump = 0.005;   ///< m, difference in depth within a footprint that counts as an edge

  // The projector is beside the camera along its x axis, and tilted towards the point of the optical axis at
  // the working distance. Its image is like the camera's.
  bool shadows = false;           ///< points that the projector cannot see are lost
  double baseline = 0.2;          ///< m, from camera to projector; negative if that is on the image's left
  double working_distance = 2.0;  ///< m, along the optical axis

  // The returned signal
  bool signal = false;    ///< false: the signal-to-noise ratio is 1 everywhere
  double snr = 2.0;       ///< of a matt white surface at the working distance that faces camera and projector
  double snr_min = 0.15;  ///< pixels below this are lost
  double snr_max = 2.5;   ///< pixels above this are lost (saturation)
  double albedo_min = 0.35;  ///< each tube's diffuse reflectance is drawn between these
  double albedo_max = 0.65;
  double gloss_min = 0.1;  ///< each tube's highlight, in units of `snr`, is drawn between these
  double gloss_max = 1.0;
  double shininess = 60.0;  ///< exponent of the highlight (Phong)
  double bin_albedo = 0.4;  ///< the bin's
  double bin_gloss = 0.05;  ///< the bin's

  // Disparity noise, in camera pixels, at a signal-to-noise ratio of 1
  double disparity_sigma = 0.0;  ///< px; 0: off

  // Smooth calibration error along the ray
  double trueness = 0.0;           ///< m, standard deviation; 0: off
  double trueness_length = 400.0;  ///< pixels, correlation length

  /// Axial and lateral noise of the Kinect (Nguyen, Izadi and Lovell 2012)
  bool kinect_noise = false;

  // What is done to the image of depths at last
  double quantization = 0.0;  ///< m, step of the depth along the optical axis; 0: off
  int fill = 0;               ///< pixels, the longest gap in a row that is filled; 0: off
  int median = 0;             ///< pixels, side of the window of a median filter, odd; 0: off

  bool operator==(const Sensor&) const = default;
};

/// True if no term is on.
bool is_ideal(const Sensor& sensor);

/// The errors of a preset scanner, by the names of camera_preset() (docs/sensor.md). "paper": none.
/// "gaussian": range noise of 0.5 mm, 2 % drop-outs, edges dropped. "zivid-one-plus-l": all terms of
/// structured light. "kinect-v1": the noise of Nguyen, Izadi and Lovell. "phoxi": fitted to real scans of
/// bars. Throws InputError for any other name.
Sensor sensor_preset(std::string_view name);

/// Throws InputError naming the invalid field under `scanner`, and the remedy.
void validate(const Sensor& sensor);

}  // namespace tanglebin
