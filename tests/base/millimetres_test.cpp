#include "tanglebin/base/millimetres.hpp"

#include <gtest/gtest.h>

namespace tanglebin {
namespace {

TEST(HintOfMillimetres, IsWhatToWriteForALengthThatIsTooLarge) {
  EXPECT_EQ(hint_of_millimetres(8, 1), "; for 8 mm write 0.008");
  EXPECT_EQ(hint_of_millimetres(12.5, 1), "; for 12.5 mm write 0.0125");
}

TEST(HintOfMillimetres, IsNothingForWhatIsNoMistakenUnit) {
  EXPECT_EQ(hint_of_millimetres(0.6, 0.5), "");
  EXPECT_EQ(hint_of_millimetres(1e300, 1), "") << "too large in millimetres, too";
  EXPECT_EQ(hint_of_millimetres(1001, 1), "");
}

}  // namespace
}  // namespace tanglebin
