#include "tanglebin/base/stride.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>

namespace tanglebin {
namespace {

TEST(SamplingStride, TakesEverythingIfThatIsWanted) {
  EXPECT_EQ(sampling_stride(0, 1), 1U);
  EXPECT_EQ(sampling_stride(99, 100), 1U);
}

RC_GTEST_PROP(SamplingStride, TakesNoMoreThanWantedAndNotManyFewer, ()) {
  const auto wanted = *rc::gen::inRange<std::size_t>(1, 5'000);
  const auto items = *rc::gen::inRange<std::size_t>(1, 3'000'000);
  const std::size_t taken = (items + sampling_stride(items, wanted) - 1) / sampling_stride(items, wanted);
  RC_ASSERT(taken <= wanted);
  RC_ASSERT(2 * (taken + 1) > std::min(items, wanted));  // there is a prime from n to 2n
}

// As of a cloud in which every eighth point stands for nothing measured.
RC_GTEST_PROP(SamplingStride, ShowsWhatRepeatsInItsProportion, ()) {
  const auto period = *rc::gen::inRange<std::size_t>(2, 400);
  const auto phase = *rc::gen::inRange<std::size_t>(0, period);
  const auto items = *rc::gen::inRange<std::size_t>(2'000'000, 3'000'000);
  const std::size_t stride = sampling_stride(items, 5'000);
  std::size_t taken = 0;
  std::size_t in_phase = 0;
  for (std::size_t i = 0; i < items; i += stride, ++taken) in_phase += i % period == phase ? 1 : 0;
  RC_ASSERT(in_phase == taken / period || in_phase == taken / period + 1);
}

}  // namespace
}  // namespace tanglebin
