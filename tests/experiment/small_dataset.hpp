#pragma once

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin::test {

/// small_recipe() with a camera fine enough to model tubes, at `x` metres from the bin's centre.
inline Recipe finely_seen_recipe(double x = 0) {
  Recipe recipe = small_recipe();
  recipe.camera = downward_camera(480, 300, focal_length_from_hfov(480, 1.22), {x, 0, 2});
  return recipe;
}

/// A recipe's cases on disk.
class SmallDataset {
public:
  explicit SmallDataset(const Recipe& recipe = finely_seen_recipe()) {
    generate_dataset(recipe, cases(recipe), directory_.path(), 1);
  }

  Dataset read() const { return read_dataset(directory_.path()); }
  std::filesystem::path operator/(const std::string& name) const { return directory_ / name; }

private:
  TemporaryDirectory directory_;
};

}  // namespace tanglebin::test
