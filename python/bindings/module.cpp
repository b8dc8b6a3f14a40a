#include "bindings.hpp"
#include "tanglebin/dataset/versions.hpp"

namespace tanglebin::python {

// In the order in which they use each other's classes.
PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = versions().at("tanglebin");
  bind_errors(module);
  bind_geometry(module);
  bind_cloud(module);
  bind_simulation(module);
  bind_recipe(module);
  bind_scene(module);
  bind_model(module);
  bind_score(module);
  bind_dataset(module);
  bind_experiment(module);
  bind_calibrate(module);
  bind_index(module);
}

}  // namespace tanglebin::python
