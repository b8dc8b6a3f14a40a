#pragma once

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin::test {

/// small_recipe()'s six cases on disk, seen by a camera fine enough to model tubes.
class SmallDataset {
public:
  SmallDataset() {
    Recipe recipe = small_recipe();
    recipe.camera = downward_camera(480, 300, focal_length_from_hfov(480, 1.22), {0, 0, 2});
    generate_dataset(recipe, cases(recipe), directory_.path(), 1);
  }

  Dataset read() const { return read_dataset(directory_.path()); }
  std::filesystem::path operator/(const std::string& name) const { return directory_ / name; }

private:
  TemporaryDirectory directory_;
};

}  // namespace tanglebin::test
