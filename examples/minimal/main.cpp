// Draws three tubes, places them in the paper's bin and scans them.
#include <iostream>
#include <numbers>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/generate/generate.hpp"
#include "tanglebin/scan/scanner.hpp"

int main() {
  tanglebin::TubeSpec spec;  // 0.5 m long, of 5 to 10 cylinders
  spec.segments.front().bend_max = std::numbers::pi / 6;

  tanglebin::Rng rng(1);
  std::vector<tanglebin::Tube> tubes;
  for (int id = 1; id <= 3; ++id) {
    tanglebin::Tube tube = tanglebin::draw_tube(rng, spec, id);
    const Eigen::Vector3d in_bin(0, 0.1 * (id - 2), 0.1);
    tanglebin::transform(tube,
                         Eigen::Isometry3d(Eigen::Translation3d(in_bin - tanglebin::bounds(tube).center())));
    tubes.push_back(tube);
  }

  const tanglebin::Scan scan =
      tanglebin::scan(tubes, tanglebin::bin_preset("paper"), tanglebin::camera_preset("paper"));
  int points = 0;
  for (const tanglebin::Pixel& pixel : scan.pixels) {
    if (pixel.label > tanglebin::bin_label) ++points;
  }
  std::cout << points << " points on " << tubes.size() << " tubes\n";
}
