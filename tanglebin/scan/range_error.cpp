#include "tanglebin/scan/range_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "tanglebin/scan/terms.hpp"

namespace tanglebin {
namespace {

constexpr double right_angle = std::numbers::pi / 2;
constexpr double steepest = 85 * std::numbers::pi / 180;  // limit of the data that Nguyen et al. fitted

// A sum of waves with random direction, length and phase approaches a Gaussian process. Its covariance is
// exp(−d² / 2 length²) if the wave vectors are normal with standard deviation 1 / length (Rahimi and Recht
// 2007).
constexpr std::size_t waves = 8;

struct Wave {
  double u, v;  // rad / pixel
  double phase;
};

std::array<Wave, waves> draw_waves(double length, std::uint64_t seed) {
  const CounterRandom random = random_of(seed, Term::trueness);
  std::array<Wave, waves> result{};
  std::uint64_t counter = 0;
  for (Wave& wave : result) {
    wave.u = random.normal(counter++) / length;
    wave.v = random.normal(counter++) / length;
    wave.phase = 2 * std::numbers::pi * random.uniform(counter++);
  }
  return result;
}

// An autoregressive process of first order down each column, standard normal in every pixel.
std::vector<double> draw_columns(double correlation, const Camera& camera, const PixelWindow& window,
                                 std::uint64_t seed) {
  const CounterRandom random = random_of(seed, Term::range_noise);
  const double innovation = std::sqrt(1 - correlation * correlation);
  const auto width = static_cast<std::size_t>(window.width);
  std::vector<double> values(width * static_cast<std::size_t>(window.height));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t row = static_cast<std::uint64_t>(window.top) + i / width;
    const std::uint64_t column = static_cast<std::uint64_t>(window.left) + i % width;
    const double white = random.normal(row * static_cast<std::uint64_t>(camera.width) + column);
    values[i] = i < width ? white : correlation * values[i - width] + innovation * white;
  }
  return values;
}

}  // namespace

double disparity_depth_sigma(const Sensor& sensor, const Camera& camera, double depth, double snr) {
  return depth * depth / (camera.fx * std::abs(sensor.baseline)) * sensor.disparity_sigma / snr;
}

double kinect_axial_sigma(double depth, double incidence) {
  const double angle = std::min(incidence, steepest);
  const double steepness = angle / (right_angle - angle);
  const double beyond = depth - 0.4;
  return 0.0012 + 0.0019 * beyond * beyond + 0.0001 / std::sqrt(depth) * steepness * steepness;
}

double kinect_lateral_sigma(double incidence) {
  const double angle = std::min(incidence, steepest);
  return 0.8 + 0.035 * angle / (right_angle - angle);
}

std::vector<float> trueness_errors(const Sensor& sensor, const PixelWindow& window, std::uint64_t seed) {
  const double amplitude = sensor.trueness * std::sqrt(2.0 / waves);
  const auto width = static_cast<std::size_t>(window.width);
  std::vector<float> errors(width * static_cast<std::size_t>(window.height));
  const std::array<Wave, waves> all = draw_waves(sensor.trueness_length, seed);
  for (int row = 0; row < window.height; ++row) {
    float* const first = errors.data() + static_cast<std::size_t>(row) * width;
    std::array<std::complex<double>, waves> values;
    std::array<std::complex<double>, waves> steps;
    for (std::size_t k = 0; k < waves; ++k) {
      values[k] =
          std::polar(amplitude, all[k].u * window.left + all[k].v * (window.top + row) + all[k].phase);
      steps[k] = std::polar(1.0, all[k].u);
    }
    for (std::size_t column = 0; column < width; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < waves; ++k) {
        const double real = values[k].real();
        const double imaginary = values[k].imag();
        sum += real;
        values[k] = {real * steps[k].real() - imaginary * steps[k].imag(),
                     real * steps[k].imag() + imaginary * steps[k].real()};
      }
      first[column] = static_cast<float>(sum);
    }
  }
  return errors;
}

RangeNoise::RangeNoise(const Sensor& sensor, const Camera& camera, const PixelWindow& window,
                       std::uint64_t seed)
    : sensor_(sensor),
      camera_(camera),
      range_(sensor.sigma > 0 ? draw_columns(sensor.column_correlation, camera, window, seed)
                              : std::vector<double>{}),
      disparity_(random_of(seed, Term::disparity)),
      kinect_(random_of(seed, Term::kinect_axial)) {}

double RangeNoise::draw(std::uint64_t pixel, std::size_t place, double depth, double incidence, double snr,
                        double axial_cosine) const {
  double error = 0;
  if (sensor_.sigma > 0) error += sensor_.sigma * range_[place];
  if (sensor_.disparity_sigma > 0) {
    error += disparity_depth_sigma(sensor_, camera_, depth, snr) / axial_cosine * disparity_.normal(pixel);
  }
  if (sensor_.kinect_noise) {
    error += kinect_axial_sigma(depth, incidence) / axial_cosine * kinect_.normal(pixel);
  }
  return error;
}

}  // namespace tanglebin
