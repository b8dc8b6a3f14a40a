#include "tanglebin/calibrate/search.hpp"

#include <exception>
#include <nlopt.hpp>

namespace tanglebin {
namespace {

/// The function, and what it threw: NLopt is C and lets nothing through.
struct Guarded {
  const std::function<double(const CubePoint&)>& value;
  std::exception_ptr thrown{};
};

double call(const std::vector<double>& point, std::vector<double>& /*gradient*/, void* data) {
  auto& guarded = *static_cast<Guarded*>(data);
  try {
    return guarded.value(point);
  } catch (...) {
    guarded.thrown = std::current_exception();
    throw nlopt::forced_stop();
  }
}

}  // namespace

void search_cube(const CubeSearch& search, const std::function<double(const CubePoint&)>& value) {
  Guarded guarded{value};
  nlopt::opt optimizer(nlopt::LN_SBPLX, static_cast<unsigned>(search.start.size()));
  optimizer.set_lower_bounds(0);
  optimizer.set_upper_bounds(1);
  optimizer.set_initial_step(search.step);
  optimizer.set_xtol_abs(search.finest);
  optimizer.set_maxeval(search.most);
  optimizer.set_max_objective(call, &guarded);
  CubePoint point = search.start;
  double greatest = 0;
  try {
    optimizer.optimize(point, greatest);
  } catch (const nlopt::forced_stop&) {
    std::rethrow_exception(guarded.thrown);
  } catch (const nlopt::roundoff_limited&) {
    // It cannot get finer: this is the end as well.
  }
}

}  // namespace tanglebin
