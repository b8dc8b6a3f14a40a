#include "tanglebin/report/published_figures.hpp"

#include <gtest/gtest.h>

namespace tanglebin {
namespace {

// Read from the paper a second time.
TEST(PublishedFigures, HaveTheCornersOfTable1AndSomeInBetween) {
  EXPECT_EQ(published_generation_time("A", 1), 3.13);
  EXPECT_EQ(published_generation_time("B", 1), 2.68);
  EXPECT_EQ(published_generation_time("A", 20), 28.10);
  EXPECT_EQ(published_generation_time("B", 20), 25.02);
  EXPECT_EQ(published_generation_time("A", 10), 14.20);
  EXPECT_EQ(published_generation_time("B", 5), 8.90);
  EXPECT_EQ(published_generation_time("A", 13), 14.53);
}

TEST(PublishedFigures, HaveTheCornersOfTable2AndSomeInBetween) {
  EXPECT_EQ(published_modelling_time("A", 1, 0.1), 0.19);
  EXPECT_EQ(published_modelling_time("A", 20, 0.1), 0.78);
  EXPECT_EQ(published_modelling_time("A", 1, 1.0), 0.32);
  EXPECT_EQ(published_modelling_time("A", 20, 1.0), 3.66);
  EXPECT_EQ(published_modelling_time("A", 10, 0.9), 1.54);
  EXPECT_EQ(published_modelling_time("A", 15, 0.5), 1.69);
}

TEST(PublishedFigures, FindARatioThatWasCountedUpInSteps) {
  EXPECT_EQ(published_modelling_time("A", 10, 0.1 + 0.1 + 0.1), 0.85);
}

// Section 6.2 says of its own Table 2: +68.4 % from 1 to 5 tubes and +50.0 % from 5 to 10, at ratio 0.1.
TEST(PublishedFigures, AgreeWithWhatThePaperSaysOfThem) {
  const double one = published_modelling_time("A", 1, 0.1).value();
  const double five = published_modelling_time("A", 5, 0.1).value();
  const double ten = published_modelling_time("A", 10, 0.1).value();
  EXPECT_NEAR(five / one, 1.684, 0.0005);
  EXPECT_NEAR(ten / five, 1.500, 0.0005);
}

TEST(PublishedFigures, HaveWhatTheTextStatesOfFigure8) {
  EXPECT_EQ(published_micro_recall("B", 1), 0.867);
  EXPECT_NEAR(published_micro_recall("B", 2).value(), 0.90, 0.005);
  EXPECT_NEAR(published_micro_recall("B", 10).value(), 0.83, 0.005);
}

TEST(PublishedFigures, AreNoneForWhatThePaperDoesNotPrint) {
  EXPECT_FALSE(published_generation_time("A", 16).has_value());
  EXPECT_FALSE(published_generation_time("C", 1).has_value());
  EXPECT_FALSE(published_modelling_time("B", 1, 0.1).has_value());
  EXPECT_FALSE(published_modelling_time("A", 2, 0.1).has_value());
  EXPECT_FALSE(published_modelling_time("A", 1, 0.15).has_value());
  EXPECT_FALSE(published_micro_recall("A", 1).has_value());
  EXPECT_FALSE(published_micro_recall("B", 3).has_value());
}

}  // namespace
}  // namespace tanglebin
