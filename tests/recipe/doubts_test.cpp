#include "tanglebin/recipe/doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace tanglebin {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> doubts_about(const std::string& text) {
  const std::string set =
      "[[set]]\nname = \"A\"\ntubes = [1, 20]\n[set.tube]\nradius = 0.0125\nmass = 0.5\nlength = 0.5\n"
      "bend_max_deg = 30\n";
  std::istringstream in(text + set);
  return doubts(read_recipe(in, "r.toml"));
}

TEST(Doubts, ThereAreNoneAboutThePapersBinAndScanners) {
  for (const std::string preset : {"paper", "gaussian", "zivid-one-plus-l", "kinect-v1"})
    EXPECT_THAT(doubts_about("[scanner]\npreset = \"" + preset + "\"\n"), IsEmpty()) << preset;
}

TEST(Doubts, AboutACameraThatMissesPartOfTheRim) {
  EXPECT_THAT(doubts_about("[scanner]\nhfov_deg = 15\n"),
              ElementsAre("scanner: part of the bin's rim is out of the camera's view"));
  EXPECT_THAT(doubts_about("[scanner]\nposition = [0, 0, 0.1]\nlook_at = [0, 0, 1]\n"),
              ElementsAre("scanner: part of the bin's rim is out of the camera's view"));
}

TEST(Doubts, AboutACameraBelowTheFloor) {
  EXPECT_THAT(doubts_about("[scanner]\nlook_at = [0, 0, 0]\ndistance = 2\ntilt_deg = 180\n"),
              ElementsAre("scanner: the camera is 2 m below the bin's floor"));
}

TEST(Doubts, AboutWhatIsTooFarForDepthImages) {
  const std::string scanner = "[scanner]\nhfov_deg = 20\nposition = [0, 0, 6.6]\nlook_at = [0.05, 0, 0]\n";
  EXPECT_THAT(doubts_about(scanner), IsEmpty());
  EXPECT_THAT(doubts_about("[output]\ndepths = true\n" + scanner),
              ElementsAre("scanner: the bin is up to 6.602 m from the camera; depth images have no more than "
                          "6.5535 m"));
}

TEST(Doubts, AboutTubesOfFewPixels) {
  EXPECT_THAT(
      doubts_about("[[scanner]]\nname = \"near\"\n[[scanner]]\nname = \"far\"\nposition = [0, 0, 10]\n"),
      ElementsAre("scanner far: a tube of set A on the floor is only 3.4 pixels across"));
}

TEST(Doubts, AboutMoreTubesThanTheBinHolds) {
  EXPECT_THAT(doubts_about("[bin]\nwidth = 0.2\nheight = 0.1\n"),
              ElementsAre("set A: 20 tubes have 45 % of the bin's volume; a heap fills up to about 33 %"));
}

TEST(Doubts, AboutTubesHeavierThanMetal) {
  const std::string heavy =
      "[[set]]\nname = \"grams\"\ntubes = [2]\n[set.tube]\nradius = 0.0125\nmass = 500\nlength = "
      "0.5\nbend_max_deg = 30\n";
  EXPECT_THAT(
      doubts_about(heavy),
      ElementsAre("set grams: a tube has 2.04e+06 kg/m³, more than the densest metal, 2.26e+04 kg/m³"));
}

TEST(Doubts, NotAboutManyTubesOnAPlate) {
  EXPECT_THAT(doubts_about("[bin]\nwidth = 0.2\nheight = 0.001\n"), IsEmpty());
}

}  // namespace
}  // namespace tanglebin
