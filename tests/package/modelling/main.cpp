// Models a cloud of no points: no tubes.
#include "tanglebin/model/model_tubes.hpp"

int main() {
  const tanglebin::KnownScene scene{.support = {.bin = tanglebin::bin_preset("paper")},
                                    .camera = tanglebin::camera_preset("paper")};
  return tanglebin::model_tubes({}, scene).tubes.empty() ? 0 : 1;
}
