// Models a scan, a cloud or a depth image, and prints its tubes: model_a_scan SCAN SCENE.toml
#include <iostream>

#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scene/read_measurement.hpp"
#include "tanglebin/scene/read_scene.hpp"
#include "tanglebin/scene/resolve_scene.hpp"

int main(int argc, char** argv) try {
  if (argc != 3) throw std::invalid_argument("usage: model_a_scan SCAN SCENE.toml");
  const tanglebin::Scene told = tanglebin::read_scene(std::filesystem::path(argv[2]));
  const auto measured = tanglebin::read_measurement(std::filesystem::path(argv[1]), told);
  const auto scan = tanglebin::resolve(measured.scene, measured.cloud);

  const tanglebin::Model model = tanglebin::model_tubes(scan.cloud, scan.known);
  for (const tanglebin::Finding& finding : model.findings) std::cerr << finding.message << '\n';
  if (model.is_refused()) return 1;
  for (std::size_t i = 0; i < model.tubes.size(); ++i) {
    const tanglebin::TubeEvidence& evidence = model.evidence[i];
    std::cout << "tube " << model.tubes[i].id << ": " << evidence.length << " m, " << evidence.points
              << " points, confidence " << evidence.confidence << '\n';
    for (const tanglebin::Node& node : model.tubes[i].nodes)
      std::cout << "  " << node.position.transpose() << '\n';
  }
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
