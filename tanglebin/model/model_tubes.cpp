#include "tanglebin/model/model_tubes.hpp"

#include <fmt/core.h>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/model/model_with_steps.hpp"
#include "tanglebin/model/paper/paper_method.hpp"

namespace tanglebin {

std::vector<Method> methods() {
  return {Method::paper, Method::axis};
}

std::string name_of(Method method) {
  switch (method) {
    case Method::paper:
      return "paper";
    case Method::axis:
      return "axis";
  }
  return {};
}

Method method_named(const std::string& name) {
  std::string names;
  for (const Method method : methods()) {
    if (name_of(method) == name) return method;
    names += (names.empty() ? "" : ", ") + name_of(method);
  }
  throw InputError({"", 0, "method"}, excerpt(name), "one of " + names);
}

void expect_available(Method method) {
  if (method == Method::paper) expect_paper_method();
}

void validate(const KnownScene& known, const ModelSettings& settings) {
  validate(known);
  expect_available(settings.method);
  if (!(settings.ratio > 0 && settings.ratio <= 1)) {
    throw InputError({"", 0, "downsample"}, fmt::format("{}", settings.ratio),
                     "a ratio above 0 and at most 1");
  }
  if (settings.method == Method::paper && known.kinds.size() > 1)
    throw InputError({"", 0, "method"}, "the paper's method handles a single radius; use --method axis");
}

Model model_tubes(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                  const std::function<void()>& at_step) {
  return model_with_steps(
      cloud, known, settings, [](const MethodRun&) {}, at_step);
}

}  // namespace tanglebin
