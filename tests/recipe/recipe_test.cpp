#include "tanglebin/recipe/recipe.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/files/toml_table.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tests/recipe/recipes.hpp"

namespace tanglebin {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;

const std::string smallest =
    "[[set]]\n"
    "name = \"A\"\n"
    "tubes = [1, 10]\n"
    "[set.tube]\n"
    "radius = 0.0125\n"
    "mass = 0.5\n"
    "length = 0.5\n"
    "bend_max_deg = 30\n";

const std::string tree =
    "[[set]]\n"
    "name = \"C\"\n"
    "tubes = [1]\n"
    "[set.tube]\n"
    "radius = 0.0125\n"
    "mass = 0.75\n"
    "[[set.tube.segment]]\n"
    "from = 1\n"
    "to = 2\n"
    "length = 0.3\n"
    "bend_max_deg = 20\n"
    "[[set.tube.segment]]\n"
    "from = 1\n"
    "to = 3\n"
    "length = 0.1\n"
    "cylinders_min = 2\n"
    "cylinders_max = 5\n"
    "bend_max_deg = 20\n";

// What is said of the smallest recipe (or another) after one change of its text.
std::string complaint_after(const std::string& old_text, const std::string& new_text,
                            std::string text = smallest) {
  const std::size_t place = text.find(old_text);
  EXPECT_NE(place, std::string::npos) << "the example has no " << old_text;
  return complaint(text.replace(place, old_text.size(), new_text));
}

// How many settings a struct has, so that none is forgotten in the recipe.
struct AnySetting {
  template <typename Value>
  operator Value() const;
};
template <typename Struct, typename... Settings>
constexpr std::size_t settings() {
  if constexpr (requires { Struct{Settings{}..., AnySetting{}}; })
    return settings<Struct, Settings..., AnySetting>();
  else
    return sizeof...(Settings);
}

// The keys of a section of a written recipe.
std::vector<std::string> keys(const std::string& text, const std::string& section) {
  std::istringstream in(text.substr(text.find("[" + section + "]\n")));
  std::vector<std::string> result;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line) && !line.empty()) result.push_back(line.substr(0, line.find(' ')));
  return result;
}

TEST(Recipe, ASetIsEnough) {
  const Recipe recipe = read(smallest);

  EXPECT_EQ(recipe.seed, 0U);
  EXPECT_EQ(recipe.attempts, 100);
  EXPECT_EQ(recipe.bin.length, bin_preset("paper").length);
  EXPECT_EQ(recipe.camera.fx, camera_preset("paper").fx);
  EXPECT_EQ(recipe.settle.step, SettleSettings{}.step);
  EXPECT_TRUE(recipe.output.bin_points);
  EXPECT_FALSE(recipe.output.pcds);
  ASSERT_EQ(recipe.sets.size(), 1U);
  EXPECT_EQ(recipe.sets[0].name, "A");
  EXPECT_THAT(recipe.sets[0].tubes, ElementsAre(1, 10));
  EXPECT_EQ(recipe.sets[0].cases, 20);
  const TubeSpec& spec = recipe.sets[0].kinds[0];
  EXPECT_EQ(spec.radius, 0.0125);
  EXPECT_EQ(spec.mass, 0.5);
  ASSERT_EQ(spec.segments.size(), 1U);
  EXPECT_EQ(spec.segments[0].from, 1);
  EXPECT_EQ(spec.segments[0].to, 2);
  EXPECT_EQ(spec.segments[0].length, 0.5);
  EXPECT_EQ(spec.segments[0].cylinders_min, 5);
  EXPECT_EQ(spec.segments[0].cylinders_max, 10);
  EXPECT_EQ(spec.segments[0].cylinder_length_min, 0.02);
  EXPECT_EQ(spec.segments[0].bend_min, 0.0);
  EXPECT_EQ(spec.segments[0].bend_max, 30 * degree);
}

TEST(Recipe, WritesNumbersOfAnySizeAsTomlHasThem) {
  EXPECT_EQ(real_text(1), "1.0");
  EXPECT_EQ(real_text(-0.0), "-0.0");
  EXPECT_EQ(real_text(0.25), "0.25");
  EXPECT_EQ(real_text(1e-5), "1e-05");
  for (int exponent = -20; exponent <= 20; ++exponent) {
    Recipe recipe = read(smallest);
    recipe.camera.fx = std::pow(10, exponent);
    recipe.camera.pose.translation().x() = -std::pow(10, exponent);
    const Recipe again = read(write(recipe));
    EXPECT_EQ(again.camera.fx, recipe.camera.fx);
    EXPECT_EQ(again.camera.pose.translation(), recipe.camera.pose.translation());
  }
}

TEST(Recipe, TakesCommentsInAnyLanguage) {
  EXPECT_EQ(read("seed = 3  # größer als 2, ≥ 3\n" + smallest).seed, 3U);
}

TEST(Recipe, ReadsTreesOfSegments) {
  const Recipe recipe = read(tree);

  const std::vector<SegmentSpec>& segments = recipe.sets.at(0).kinds.at(0).segments;
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[1].from, 1);
  EXPECT_EQ(segments[1].to, 3);
  EXPECT_EQ(segments[1].length, 0.1);
  EXPECT_EQ(segments[1].cylinders_max, 5);
  EXPECT_EQ(segments[1].bend_max, 20 * degree);
}

const std::string two_kinds =
    "[[set]]\nname = \"M\"\ntubes = [4]\n"
    "[[set.tube]]\nradius = 0.008\nmass = 0.2\nlength = 0.4\nbend_max_deg = 30\n"
    "[[set.tube]]\nradius = 0.0125\nmass = 0.5\n"
    "[[set.tube.segment]]\nfrom = 1\nto = 2\nlength = 0.3\nbend_max_deg = 30\n"
    "[[set.tube.segment]]\nfrom = 2\nto = 3\nlength = 0.2\nbend_max_deg = 30\n";

TEST(Recipe, ReadsSeveralKindsOfTubesForOneBin) {
  const Recipe recipe = read(two_kinds);
  const std::vector<TubeSpec>& kinds = recipe.sets.at(0).kinds;
  ASSERT_EQ(kinds.size(), 2U);
  EXPECT_EQ(kinds[0].radius, 0.008);
  EXPECT_EQ(kinds[0].segments.size(), 1U);
  EXPECT_EQ(kinds[1].radius, 0.0125);
  EXPECT_EQ(kinds[1].segments.size(), 2U);
  EXPECT_EQ(write(read(write(recipe))), write(recipe));
}

TEST(Recipe, SaysWhichKindOfTubesIsNone) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = two_kinds;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(complaint(with("radius = 0.0125", "radius = -1")),
            "r.toml:10: set[0].tube[1].radius: found -1, expected a positive number");
  EXPECT_EQ(complaint(with("length = 0.4", "length = 4.0")).find("r.toml:7: set[0].tube[0].length"), 0U);
  EXPECT_EQ(complaint("[[set]]\nname = \"M\"\ntubes = [4]\ntube = []\n"),
            "r.toml:4: set[0].tube: found none, expected at least one [[set.tube]]");
}

TEST(Recipe, ATubesMassMayFollowFromItsDensity) {
  std::string text = smallest;
  text.replace(text.find("mass = 0.5"), 10, "density = 1200");
  const Recipe recipe = read(text);
  EXPECT_EQ(recipe.sets[0].kinds[0].density, 1200);
  EXPECT_EQ(recipe.sets[0].kinds[0].mass, 0);
  EXPECT_EQ(read(write(recipe)), recipe);
  EXPECT_EQ(difference(read(smallest), recipe), "set[0].tube.density: it has nothing, this one 1200.0");
}

TEST(Recipe, SaysWhatIsWrongWithADensity) {
  EXPECT_EQ(complaint_after("mass = 0.5", "density = -1"),
            "r.toml:6: set[0].tube.density: found -1, expected a positive number");
  EXPECT_EQ(complaint_after("mass = 0.5", "density = 0"),
            "r.toml:6: set[0].tube.density: found 0, expected a positive number");
  EXPECT_EQ(complaint_after("mass = 0.5", "mass = 0.5\ndensity = 1200"),
            "r.toml:7: set[0].tube.density: cannot be combined with mass");
  EXPECT_EQ(complaint_after("mass = 0.5\n", ""), "r.toml:4: set[0].tube.mass: is missing");
}

TEST(Recipe, KindsHaveWeights) {
  std::string text = two_kinds;
  text.replace(text.find("radius = 0.008"), 0, "weight = 3\n");
  EXPECT_EQ(complaint(text), "r.toml:10: set[0].tube[1].weight: is missing");
  text.replace(text.find("radius = 0.0125"), 0, "weight = 1.5\n");
  const Recipe recipe = read(text);
  EXPECT_THAT(recipe.sets[0].weights, ElementsAre(3, 1.5));
  EXPECT_EQ(read(write(recipe)), recipe);
  EXPECT_EQ(complaint_after("weight = 1.5", "weight = 0", text),
            "r.toml:11: set[0].tube[1].weight: found 0, expected more than 0 and at most 1000000");
  EXPECT_EQ(complaint_after("weight = 1.5", "weight = { min = 1, max = 2 }", text),
            "r.toml:11: set[0].tube[1].weight: found a random number, expected a fixed one");
}

TEST(Recipe, CloudsMayBeLeftOut) {
  const Recipe recipe = read("[output]\nplys = false\n" + smallest);
  EXPECT_FALSE(recipe.output.plys);
  EXPECT_THAT(write(recipe), HasSubstr("plys = false\n"));
  EXPECT_EQ(read(write(recipe)), recipe);
  EXPECT_EQ(difference(read(smallest), recipe), "output.plys: it has nothing, this one false");
}

TEST(Recipe, AWrittenOneSaysWhichFrictionCounts) {
  EXPECT_THAT(write(read(smallest)),
              HasSubstr("friction = 100.0  # of tubes on the bin, if less than settle.friction\n"));
}

TEST(Recipe, OverridesAPreset) {
  const Recipe recipe = read(
      "seed = 7\nattempts = 3\n[bin]\npreset = \"published\"\nheight = 1\n"
      "[settle]\nstep = 0.001\niterations = 20\n[output]\npcds = true\n" +
      smallest);
  EXPECT_EQ(recipe.seed, 7U);
  EXPECT_EQ(recipe.attempts, 3);
  EXPECT_EQ(recipe.bin.length, 0.8);
  EXPECT_EQ(recipe.bin.height, 1.0);
  EXPECT_EQ(recipe.settle.step, 0.001);
  EXPECT_EQ(recipe.settle.iterations, 20);
  EXPECT_TRUE(recipe.output.pcds);
}

TEST(Recipe, AnotherImageSizeKeepsThePresetsFieldOfView) {
  const Camera preset = camera_preset("paper");
  const Camera camera = read("[scanner]\nwidth = 960\nheight = 600\n" + smallest).camera;
  EXPECT_EQ(camera.width, 960);
  EXPECT_EQ(camera.height, 600);
  EXPECT_DOUBLE_EQ(std::atan(camera.width / camera.fx), std::atan(preset.width / preset.fx));
  EXPECT_EQ(camera.fx, camera.fy);
  EXPECT_EQ(camera.cx, 479.5);
  EXPECT_EQ(camera.cy, 299.5);
}

TEST(Recipe, TellsTheLensInThreeWays) {
  EXPECT_EQ(read("[scanner]\nhfov_deg = 90\n" + smallest).camera.fx,
            focal_length_from_hfov(1920, 90 * degree));
  EXPECT_EQ(read("[scanner]\nfocal_length_px = 2000\n" + smallest).camera.fy, 2000.0);
  const Camera camera = read("[scanner]\nfx = 1000\nfy = 1001\ncx = 900.5\ncy = 601\n" + smallest).camera;
  EXPECT_EQ(camera.fx, 1000.0);
  EXPECT_EQ(camera.fy, 1001.0);
  EXPECT_EQ(camera.cx, 900.5);
  EXPECT_EQ(camera.cy, 601.0);
}

TEST(Recipe, PlacesTheScannerAnywhere) {
  // A quarter turn about x, in few digits: the camera looks along -y.
  const Camera camera =
      read("[scanner]\nposition = [0, 1.5, 0.25]\nrotation_wxyz = [0.7071, 0.7071, 0, 0]\n" + smallest)
          .camera;
  EXPECT_EQ(camera.pose.translation(), Eigen::Vector3d(0, 1.5, 0.25));
  EXPECT_TRUE((camera.pose.linear() * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(camera.pose.linear().isUnitary(1e-15)) << "although the quaternion's norm is not quite 1";

  const Camera turned =
      read("[scanner]\nrotation_matrix = [[0, 1, 0], [1, 0, 0], [0, 0, -1]]\n" + smallest).camera;
  EXPECT_EQ(turned.pose.linear() * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
  EXPECT_EQ(turned.pose.translation(), camera_preset("paper").pose.translation());
}

TEST(Recipe, PlacesTheScannerAboutWhatItLooksAt) {
  const auto camera = [](const std::string& place) {
    return read("[scanner]\nlook_at = [0.1, 0, 0.1]\n" + place + smallest).camera;
  };
  const Camera above = camera("distance = 1.5\n");
  EXPECT_TRUE(above.pose.translation().isApprox(Eigen::Vector3d(0.1, 0, 1.6)));
  const Camera tilted = camera("distance = 2\ntilt_deg = 30\nazimuth_deg = 90\n");
  EXPECT_TRUE(tilted.pose.translation().isApprox(Eigen::Vector3d(0.1, 1, 0.1 + std::sqrt(3))));
  EXPECT_TRUE((tilted.pose * Eigen::Vector3d(0, 0, 2)).isApprox(Eigen::Vector3d(0.1, 0, 0.1)));
  EXPECT_TRUE(tilted.pose.linear().col(0).isApprox(Eigen::Vector3d::UnitX()));
}

TEST(Recipe, SaysWhyTheScannerHasNoPlaceAboutWhatItLooksAt) {
  EXPECT_EQ(complaint("[scanner]\ndistance = 1\n" + smallest), "r.toml:1: scanner.look_at: is missing");
  EXPECT_EQ(complaint("[scanner]\nlook_at = [0, 0, 0]\ntilt_deg = 10\n" + smallest),
            "r.toml:1: scanner.distance: is missing");
  EXPECT_EQ(complaint("[scanner]\nlook_at = [0, 0, 0]\nposition = [0, 0, 1]\ndistance = 1\n" + smallest),
            "r.toml:4: scanner.distance: cannot be combined with position");
  EXPECT_EQ(complaint("[scanner]\nlook_at = [0, 0, 0]\ndistance = 0\n" + smallest),
            "r.toml:3: scanner.distance: found 0, expected a positive number");
  EXPECT_EQ(complaint("[scanner]\nlook_at = [0, 0, 0]\ndistance = 1\ntilt_deg = 181\n" + smallest),
            "r.toml:4: scanner.tilt_deg: found 181, expected an angle from 0 to 180");
}

const std::string shared_tube = "[tube]\nradius = 0.0125\nmass = 0.5\nlength = 0.5\nbend_max_deg = 30\n";

TEST(SharedTube, StandsInForWhatAKindDoesNotSay) {
  const Recipe shared =
      read(shared_tube + "[[set]]\nname = \"A\"\ntubes = [1]\n" +
           "[[set]]\nname = \"B\"\ntubes = [1]\n[set.tube]\nbend_max_deg = 45\n" +
           "[[set]]\nname = \"C\"\ntubes = [1]\n[[set.tube]]\n[[set.tube]]\nradius = 0.008\n");
  const TubeSpec& tube = shared.sets[0].kinds[0];
  EXPECT_EQ(tube, read(smallest).sets[0].kinds[0]);
  EXPECT_EQ(shared.sets[1].kinds[0].radius, tube.radius);
  EXPECT_EQ(shared.sets[1].kinds[0].segments[0].bend_max, 45 * degree);
  EXPECT_EQ(shared.sets[2].kinds[0], tube);
  EXPECT_EQ(shared.sets[2].kinds[1].radius, 0.008);
  EXPECT_EQ(shared.sets[2].kinds[1].segments, tube.segments);
  EXPECT_EQ(read(write(shared)), shared) << "the written recipe spells it out";
}

TEST(SharedTube, GivesWayToWhatAKindSaysInAnotherWay) {
  const Recipe recipe = read(shared_tube + tree.substr(0, tree.find("mass")) + "density = 1000\n" +
                             tree.substr(tree.find("[[set.tube.segment]]")));
  EXPECT_EQ(recipe.sets[0].kinds[0].density, 1000);
  EXPECT_EQ(recipe.sets[0].kinds[0].segments.size(), 2U);
  const std::string shared_tree =
      "[tube]\nradius = 0.0125\nmass = 0.75\n[[tube.segment]]\nfrom = 1\nto = 2\nlength = 0.3\nbend_max_deg "
      "= 20\n";
  EXPECT_EQ(read(shared_tree + smallest).sets[0].kinds[0].segments[0].length, 0.5);
  EXPECT_EQ(read(shared_tree + "[[set]]\nname = \"A\"\ntubes = [1]\n").sets[0].kinds[0].segments[0].length,
            0.3);
}

TEST(SharedTube, MayHaveNumbersThatAreDrawnForEachSet) {
  const std::string text = "[tube]\nradius = { min = 0.008, max = 0.01 }\nmass = 0.5\nlength = 0.5\n" +
                           std::string("bend_max_deg = 30\n[[set]]\nname = \"A\"\ntubes = [1]\n") +
                           "[[set]]\nname = \"B\"\ntubes = [1]\n";
  const Recipe recipe = read(text);
  ASSERT_EQ(recipe.random.size(), 2U);
  EXPECT_EQ(recipe.random[1].path, "set[1].tube.radius");
  EXPECT_EQ(read(write(recipe)), recipe);
}

TEST(SharedTube, IsWhereItsErrorsAre) {
  const std::string set = "[[set]]\nname = \"A\"\ntubes = [1]\n";
  EXPECT_EQ(complaint("[tube]\nradius = 0.01\nmas = 0.5\n" + set),
            "r.toml:3: tube: unknown key 'mas', did you mean 'mass'?");
  EXPECT_EQ(complaint("tube = 3\n" + set), "r.toml:1: tube: found 3, expected a table [tube]");
  EXPECT_EQ(complaint("[tube]\nradius = true\n" + set),
            "r.toml:2: set[0].tube.radius: found true, expected a number");
  EXPECT_EQ(complaint("[tube]\nradius = 0.01\nmass = -1\nlength = 0.5\nbend_max_deg = 3\n" + set),
            "r.toml:3: set[0].tube.mass: found -1, expected a positive number");
  EXPECT_EQ(complaint("[tube]\nradius = 0.01\nmass = 1\ndensity = 1\n" + set),
            "r.toml:4: set[0].tube.density: cannot be combined with mass");
  EXPECT_EQ(complaint("[tube]\nradius = 0.01\n" + set), "r.toml:1: set[0].tube.mass: is missing");
  EXPECT_EQ(complaint("[tube]\nradius = { min = 2, max = 1 }\n" + set),
            "r.toml:2: set[0].tube.radius: found min = 2 and max = 1, expected min to be at most max");
  EXPECT_EQ(complaint("[tube]\nweight = 1\n" + set).find("r.toml:2: tube: unknown key 'weight'"), 0U);
}

TEST(Recipe, WritesEverySettingThatThereIs) {
  const std::string text = write(read(smallest));

  EXPECT_EQ(keys(text, "bin").size(), settings<Bin>());
  EXPECT_EQ(keys(text, "settle").size(), settings<SettleSettings>())
      << "a setting has no line in settle_fields (recipe_fields.hpp)";
  EXPECT_EQ(keys(text, "output").size(), settings<OutputSettings>() - 3)
      << "properties have keys of their own; clouds are only mentioned where they are left out, occlusions "
         "where they are written";
  EXPECT_EQ(keys(write(read(tree)), "[set.tube.segment]").size(),
            settings<Segment>() + settings<SegmentSpec>() - 1)
      << "a setting has no line in segment_fields (recipe_fields.hpp)";
  EXPECT_THAT(keys(text, "scanner"),
              ElementsAre("width", "height", "fx", "fy", "cx", "cy", "position", "rotation_matrix"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("preset =")));
}

TEST(Recipe, OneWordChoosesBetweenTheIdealScannerAndABelievableOne) {
  EXPECT_EQ(read(smallest).sensor, Sensor{});
  EXPECT_EQ(read("[scanner]\npreset = \"paper\"\n" + smallest).sensor, Sensor{});
  const Recipe zivid = read("[scanner]\npreset = \"zivid-one-plus-l\"\n" + smallest);
  EXPECT_EQ(zivid.sensor, sensor_preset("zivid-one-plus-l"));
  EXPECT_EQ(zivid.camera.fx, 2730.0);
}

TEST(Recipe, SwitchesTheTermsOfAScannerOneByOne) {
  const Sensor sensor =
      read("[scanner]\nsigma = 0.0002\ndropout = 0.05\nedges = \"drop\"\nsub_rays = 2\n" + smallest).sensor;
  EXPECT_EQ(sensor, (Sensor{.sigma = 0.0002, .dropout = 0.05, .edges = Edges::drop, .sub_rays = 2}));
  Sensor no_shadows = sensor_preset("zivid-one-plus-l");
  no_shadows.shadows = false;
  EXPECT_EQ(read("[scanner]\npreset = \"zivid-one-plus-l\"\nshadows = false\n" + smallest).sensor,
            no_shadows);
  EXPECT_EQ(complaint("[scanner]\nedges = \"blur\"\n" + smallest),
            "r.toml:2: scanner.edges: found 'blur', expected \"keep\", \"drop\" or \"mix\"");
  EXPECT_THAT(complaint("[scanner]\n\nbaseline = 0\n" + smallest),
              HasSubstr("r.toml:3: scanner.baseline: found 0, expected a distance in metres other than 0"));
}

TEST(Recipe, WritesEveryTermOfAScannerThatIsNotIdeal) {
  const Recipe zivid = read("[scanner]\npreset = \"zivid-one-plus-l\"\nbaseline = 0.3\n" + smallest);
  const std::string text = write(zivid);
  constexpr std::size_t of_the_image = 4;
  EXPECT_EQ(keys(text, "scanner").size(), 8 + settings<Sensor>() - of_the_image)
      << "a setting has no line in sensor_fields (recipe_fields.hpp)";
  EXPECT_EQ(read(text).sensor, zivid.sensor);
  const Recipe phoxi = read("[scanner]\npreset = \"phoxi\"\n" + smallest);
  EXPECT_EQ(keys(write(phoxi), "scanner").size(), 8 + settings<Sensor>());
  EXPECT_EQ(read(write(phoxi)).sensor, sensor_preset("phoxi"));
}

TEST(Recipe, TheCommandLineSetsWhatARecipesScannerHas) {
  const Scanner scanner = scanner_with("paper", {"scanner.sigma=0.0002", "scanner.edges=drop"}, "--set");
  EXPECT_EQ(scanner.sensor, (Sensor{.sigma = 0.0002, .edges = Edges::drop}));
  EXPECT_EQ(scanner.camera.fx, camera_preset("paper").fx);
  EXPECT_EQ(scanner_with(scanner, {"scanner.sigma=0.0001"}, "--set").sensor,
            (Sensor{.sigma = 0.0001, .edges = Edges::drop}));
  const auto said = [](const std::string& setting) {
    return test::complaint([&] { scanner_with("paper", {"scanner.sigma=0.0002", setting}, "--set"); });
  };
  EXPECT_THAT(said("scanner.baseline=0"), HasSubstr("--set: scanner.baseline: found 0"));
  EXPECT_THAT(said("scanner.focal_length_px=0"), HasSubstr("--set: scanner.focal_length_px: found 0"));
  EXPECT_THAT(said("scanner.basline=0.1"), HasSubstr("did you mean 'baseline'?"));
  EXPECT_THAT(said("bin.length=1"), HasSubstr("unknown key 'bin'"));
  EXPECT_THAT(said("scanner.name=left"), HasSubstr("unknown key 'name'"));
  EXPECT_THAT(said("scanner.edges=Mix"), HasSubstr("found 'Mix', expected \"keep\", \"drop\" or \"mix\""));
  EXPECT_THAT(said("scanner.dropout=1mm"), HasSubstr("--set: Error while parsing"));
  EXPECT_THAT(said("scanner.dropout=much"),
              HasSubstr("--set: scanner.dropout: found 'much', expected a number"));
  EXPECT_THAT(said("scanner.dropout=inf"), HasSubstr("scanner.dropout: found inf, expected a finite number"));
  EXPECT_THAT(said("scanner.shadows=yes"), HasSubstr("expected true or false"));
  EXPECT_EQ(said("scanner.shadows=true"), "none");
  EXPECT_THAT(said("scanner.dropout=\xC3\xA9"), HasSubstr("--set: found"))
      << "a character that TOML has not there";
  EXPECT_THAT(said("scanner.edges=m\xC3\xAFx"), HasSubstr("found 'm\xC3\xAFx'"));
}

TEST(Recipe, TheOneScannerOfARecipeNeedsNoName) {
  EXPECT_THAT(complaint("[scanner]\nname = \"left\"\n" + smallest),
              HasSubstr("r.toml:2: scanner: unknown key 'name'"));
}

const std::string two_scanners =
    "[[scanner]]\nname = \"above\"\n[[scanner]]\nname = \"beside\"\npreset = \"zivid-one-plus-l\"\n"
    "position = [0, 1, 1.5]\nlook_at = [0, 0, 0.1]\n";

TEST(Recipe, HasSeveralScannersAndPosesForOneScene) {
  const Recipe recipe = read(two_scanners + smallest);
  EXPECT_EQ(recipe.scanner_name, "above");
  EXPECT_EQ(recipe.sensor, Sensor{});
  ASSERT_EQ(recipe.further_scanners.size(), 1U);
  const Scanner& beside = recipe.further_scanners[0];
  EXPECT_EQ(beside.name, "beside");
  EXPECT_EQ(beside.sensor, sensor_preset("zivid-one-plus-l"));
  const Eigen::Vector3d target(0, 0, 0.1);
  EXPECT_TRUE((*project(beside.camera, target)).isApprox(Eigen::Vector2d(959.5, 599.5)));
  EXPECT_TRUE(beside.camera.pose.linear().col(0).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_EQ(write(read(write(recipe))), write(recipe));
}

TEST(Recipe, SaysWhichOfSeveralScannersIsWrong) {
  EXPECT_THAT(complaint(two_scanners + "baseline = 0\n" + smallest),
              HasSubstr("r.toml:8: scanner[1].baseline: found 0"));
  EXPECT_THAT(complaint_after("\"beside\"", "\"above\"", two_scanners + smallest),
              HasSubstr("r.toml:4: scanner[1].name: found 'above' twice"));
  EXPECT_THAT(complaint_after("\"beside\"", "\"plys\"", two_scanners + smallest),
              HasSubstr("scanner[1].name: found 'plys', expected a name that no other folder has"));
  EXPECT_THAT(complaint("[[scanner]]\npreset = \"paper\"\n" + smallest),
              HasSubstr("scanner[0].name: is missing"));
  EXPECT_THAT(complaint("[scanner]\nlook_at = [1, 0, 2]\n" + smallest),
              HasSubstr("along the world's x axis"));
  EXPECT_THAT(complaint("[scanner]\nlook_at = [0, 0, 2]\n" + smallest), HasSubstr("from a point to itself"));
}

TEST(Recipe, WritesThePropertiesOfPointsWhereAnyIsAskedFor) {
  EXPECT_THAT(write(read(smallest)), ::testing::Not(HasSubstr("normals")));
  const Recipe recipe = read("[output]\nintensities = true\n" + smallest);
  EXPECT_EQ(recipe.output.properties, (PointProperties{.intensities = true}));
  EXPECT_EQ(read(write(recipe)).output.properties, recipe.output.properties);
  EXPECT_EQ(keys(write(recipe), "output").size(), 5 + settings<PointProperties>());
}

TEST(Recipe, WritesDegreesAsAPersonWould) {
  for (int degrees = 0; degrees <= 180; ++degrees) {
    Recipe recipe = read(smallest);
    recipe.sets[0].kinds[0].segments[0].bend_max = degrees * degree;
    EXPECT_THAT(write(recipe), HasSubstr("bend_max_deg = " + std::to_string(degrees) + ".0\n"));
  }
}

// Real numbers that use all their digits.
double any_real(double low, double high) {
  constexpr auto steps = std::int64_t{1} << 52;
  const auto step = *rc::gen::noShrink(rc::gen::resize(100, rc::gen::inRange<std::int64_t>(0, steps)));
  return low + (high - low) * static_cast<double>(step) / static_cast<double>(steps);
}

Camera any_camera() {
  Camera camera;
  camera.width = *rc::gen::inRange(1, 5000);
  camera.height = *rc::gen::inRange(1, 5000);
  camera.fx = any_real(1, 5000);
  camera.fy = any_real(1, 5000);
  camera.cx = any_real(-100, 5000);
  camera.cy = any_real(-100, 5000);
  const Eigen::Quaterniond rotation(any_real(0.1, 1), any_real(-1, 1), any_real(-1, 1), any_real(-1, 1));
  camera.pose.linear() = rotation.normalized().toRotationMatrix();
  camera.pose.translation() = Eigen::Vector3d(any_real(-5, 5), any_real(-5, 5), any_real(-5, 5));
  return camera;
}

// An angle as read_recipe() gives it.
double any_angle(double low_degrees, double high_degrees) {
  return (*rc::gen::arbitrary<bool>() ? std::floor(any_real(low_degrees, high_degrees))
                                      : any_real(low_degrees, high_degrees)) *
         degree;
}

TubeSpec any_kind() {
  TubeSpec spec;
  spec.radius = any_real(0.001, 0.1);
  if (*rc::gen::arbitrary<bool>()) {
    spec.mass = any_real(0.001, 10);
  } else {
    spec.mass = 0;
    spec.density = any_real(1, 10000);
  }
  spec.segments.clear();
  if (*rc::gen::arbitrary<bool>()) {
    spec.radius = any_real(0.001, 0.01);
    spec.flat_ends = *rc::gen::arbitrary<bool>();
    spec.pieces = {
        {.length = any_real(0.1, 0.5)},
        {.bend = any_angle(1, 90), .bend_radius = any_real(0.02, 1), .twist = any_angle(-180, 180)},
        {.length = any_real(0.1, 0.5)}};
    return spec;
  }
  const int segments = *rc::gen::inRange(1, 5);
  for (int to = 2; to <= segments + 1; ++to) {
    SegmentSpec segment;
    segment.from = *rc::gen::inRange(1, to);
    segment.to = to;
    segment.length = any_real(0.1, 1);
    segment.cylinders_max = *rc::gen::inRange(1, 20);
    segment.cylinders_min = *rc::gen::inRange(1, segment.cylinders_max + 1);
    segment.cylinder_length_min = segment.length / 20 * any_real(0.01, 1);
    segment.bend_min = any_angle(0, 30);
    segment.bend_max = any_angle(30, 180);
    spec.segments.push_back(segment);
  }
  return spec;
}

SetRecipe any_set(const std::string& name) {
  SetRecipe set;
  set.name = name;
  if (*rc::gen::arbitrary<bool>()) {
    set.tubes = *rc::gen::nonEmpty(rc::gen::unique<std::vector<int>>(rc::gen::inRange(1, 1000)));
  } else {
    const int fewest = *rc::gen::inRange(1, 1000);
    set.drawn_tubes =
        RandomNumber{static_cast<double>(fewest), static_cast<double>(*rc::gen::inRange(fewest, 1000)), {}};
  }
  set.cases = *rc::gen::inRange(1, 1000);
  const int kinds = *rc::gen::inRange(1, 4);
  set.kinds.clear();
  const bool by_weight = *rc::gen::arbitrary<bool>();
  for (int i = 0; i < kinds; ++i) {
    set.kinds.push_back(any_kind());
    if (by_weight) set.weights.push_back(any_real(0.001, 100));
  }
  return set;
}

Sensor any_sensor() {
  Sensor sensor =
      sensor_preset(*rc::gen::element("paper", "gaussian", "zivid-one-plus-l", "kinect-v1", "phoxi"));
  sensor.sigma = *rc::gen::arbitrary<bool>() ? any_real(0, 0.01) : sensor.sigma;
  sensor.edges = *rc::gen::element(Edges::keep, Edges::drop, Edges::mix);
  return sensor;
}

PointProperties any_properties() {
  return {*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>()};
}

Recipe any_recipe() {
  Recipe recipe;
  recipe.seed = static_cast<std::uint64_t>(
      *rc::gen::inRange<std::int64_t>(0, std::numeric_limits<std::int64_t>::max()));
  recipe.attempts = *rc::gen::inRange(1, 1'000'000);
  recipe.bin = {any_real(1, 3), any_real(1, 3), any_real(1, 3), any_real(0.001, 1), any_real(0.1, 1000)};
  recipe.camera = any_camera();
  recipe.sensor = any_sensor();
  if (*rc::gen::arbitrary<bool>()) {
    recipe.scanner_name = "left";
    recipe.further_scanners = {{"right", any_camera(), any_sensor()}, {"above", any_camera(), any_sensor()}};
  }
  recipe.settle.step = SettleSettings{}.step * any_real(0.5, 1);
  recipe.output = {*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(),
                   *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(),
                   *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(),
                   *rc::gen::arbitrary<bool>(), any_properties()};
  // Names that end in different letters share no folder.
  recipe.sets.push_back(any_set("A"));
  if (*rc::gen::arbitrary<bool>()) recipe.sets.push_back(any_set("set-b_2x"));
  return recipe;
}

// Makes a number random, or not; it is the lowest that can be drawn.
void maybe_random(Recipe& recipe, const std::string& path, double lowest, bool per_tube = false) {
  const double more = lowest + any_real(0.01, 0.1);
  const std::vector<RandomNumber> numbers{{.min = lowest, .max = more, .per_tube = per_tube},
                                          {.one_of = {more, lowest, more}, .per_tube = per_tube},
                                          {.min = lowest,
                                           .max = more,
                                           .mean = any_real(lowest, more),
                                           .sigma = any_real(0.001, 0.01),
                                           .per_tube = per_tube}};
  const auto choice = *rc::gen::inRange<std::size_t>(0, numbers.size() + 1);
  if (choice < numbers.size()) recipe.random.push_back({path, numbers[choice]});
}

void maybe_random_pose(Recipe& recipe, const std::string& scanner, const Eigen::Isometry3d& pose) {
  if (*rc::gen::arbitrary<bool>()) return;
  const Eigen::Vector3d position = pose.translation();
  recipe.random.push_back({scanner + ".position[0]", RandomNumber{position.x(), position.x() + 1, {}}});
  recipe.random.push_back({scanner + ".position[1]", position.y()});
  recipe.random.push_back({scanner + ".position[2]", RandomNumber{0, 0, {position.z()}}});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const std::string element = fmt::format("{}.rotation_matrix[{}][{}]", scanner, row, column);
      const double number = pose.linear()(row, column);
      if (row == column) {
        recipe.random.push_back({element, RandomNumber{0, 0, {number}}});
      } else {
        recipe.random.push_back({element, number});
      }
    }
  }
}

void maybe_random_kind(Recipe& recipe, const std::string& path, const TubeSpec& kind) {
  const bool per_tube = *rc::gen::arbitrary<bool>();
  if (kind.density == 0) {
    maybe_random(recipe, path + ".mass", kind.mass, per_tube);
  } else {
    maybe_random(recipe, path + ".density", kind.density, per_tube);
  }
  if (!kind.pieces.empty()) {
    maybe_random(recipe, path + ".piece[0].length", kind.pieces[0].length, per_tube);
    maybe_random(recipe, path + ".piece[1].bend_radius", kind.pieces[1].bend_radius, per_tube);
  }
  for (std::size_t i = 0; i < kind.segments.size(); ++i) {
    if (*rc::gen::arbitrary<bool>()) continue;
    const SegmentSpec& segment = kind.segments[i];
    const std::string place = kind.segments.size() == 1 ? path : fmt::format("{}.segment[{}]", path, i);
    recipe.random.push_back(
        {place + ".cylinders_min",
         RandomNumber{
             static_cast<double>(segment.cylinders_min), static_cast<double>(segment.cylinders_max), {}}});
  }
}

// A recipe with random numbers in all tables, in the order in which they are written.
Recipe any_random_recipe() {
  Recipe recipe = any_recipe();
  maybe_random(recipe, "bin.friction", recipe.bin.friction);
  const std::vector<Scanner> all = scanners(recipe);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string scanner = all.size() == 1 ? "scanner" : fmt::format("scanner[{}]", i);
    maybe_random(recipe, scanner + ".cx", all[i].camera.cx);
    maybe_random_pose(recipe, scanner, all[i].camera.pose);
    if (all[i].sensor != Sensor{}) maybe_random(recipe, scanner + ".trueness", all[i].sensor.trueness);
  }
  maybe_random(recipe, "settle.gravity", recipe.settle.gravity);
  if (*rc::gen::arbitrary<bool>()) recipe.random.push_back({"settle.iterations", RandomNumber{50, 60, {}}});
  for (std::size_t i = 0; i < recipe.sets.size(); ++i) {
    const std::vector<TubeSpec>& kinds = recipe.sets[i].kinds;
    const std::string tube = fmt::format("set[{}].tube", i);
    for (std::size_t k = 0; k < kinds.size(); ++k)
      maybe_random_kind(recipe, kinds.size() == 1 ? tube : fmt::format("{}[{}]", tube, k), kinds[k]);
  }
  return recipe;
}

RC_GTEST_PROP(RecipeProperty, WhatIsWrittenReadsBackAsTheSameValue, ()) {
  const Recipe recipe = any_recipe();
  RC_ASSERT(read(write(recipe)) == recipe);
}

RC_GTEST_PROP(RecipeProperty, RandomNumbersReadBackAsTheSameValue, ()) {
  const Recipe recipe = any_random_recipe();
  const Recipe again = read(write(recipe));
  RC_ASSERT(difference(again, recipe) == std::nullopt);
  RC_ASSERT(again == recipe);
  const CaseId id{"A", 3, 1};
  RC_ASSERT(draw(again, id) == draw(recipe, id));
  RC_ASSERT(resolve(again, id, draw(again, id)) == resolve(recipe, id, draw(recipe, id)));
}

RC_GTEST_PROP(RecipeProperty, DegreesComeBackAsTheSameRadians, ()) {
  Recipe recipe = read(smallest);
  const double radians = any_real(0, 180) * degree;
  recipe.sets[0].kinds[0].segments[0].bend_max = radians;
  RC_ASSERT(read(write(recipe)).sets[0].kinds[0].segments[0].bend_max == radians);
}

TEST(Recipe, AnAngleThatNoDegreesGiveIsWrittenAsTheNearest) {
  Recipe recipe = read(smallest);
  double radians = 1.2;
  for (int i = 0; i < 100; ++i) {
    radians = std::nextafter(radians, 2.0);
    recipe.sets[0].kinds[0].segments[0].bend_max = radians;
    EXPECT_DOUBLE_EQ(read(write(recipe)).sets[0].kinds[0].segments[0].bend_max, radians);
  }
}

TEST(Recipe, AResolvedOneIsTheSameAsWhatItCameFrom) {
  const Recipe recipe = read(
      "seed = 9223372036854775807\n[scanner]\nhfov_deg = 71.3\n"
      "rotation_wxyz = [0.1, 0.9, 0.3, -0.3]\n" +
      tree);
  EXPECT_EQ(read(write(recipe)), recipe);
}

TEST(Recipe, OnesInTheRepositoryAreWhatTheySay) {
  const auto file = [](const char* name) {
    return std::filesystem::path(TANGLEBIN_SOURCE) / "recipes" / name;
  };
  EXPECT_EQ(cases(read_recipe(file("set-a.toml"))).size(), 320U);
  EXPECT_EQ(cases(read_recipe(file("set-b.toml"))).size(), 320U);
  EXPECT_EQ(cases(read_recipe(file("set-c.toml"))).size(), 250U);
  EXPECT_EQ(cases(read_recipe(file("mixed.toml"))).size(), 60U);
  EXPECT_EQ(cases(read_recipe(file("crowded.toml"))).size(), 50U);
  EXPECT_EQ(cases(read_recipe(file("varied.toml"))).size(), 200U);
  const Recipe bars = read_recipe(file("bars.toml"));
  EXPECT_EQ(cases(bars).size(), 700U);
  EXPECT_NEAR(segments_of(bars.sets.at(0).kinds.at(0))[0].length, 0.244, 0.007);
  EXPECT_NEAR(segments_of(bars.sets.at(1).kinds.at(0))[0].length, 0.214, 0.007);
  const Recipe paper = read_recipe(file("paper.toml"));
  EXPECT_EQ(cases(paper).size(), 640U);
  EXPECT_EQ(paper.sets.at(0).kinds.at(0).segments.at(0).bend_max, 30 * degree);
  EXPECT_EQ(paper.sets.at(1).kinds.at(0).segments.at(0).bend_max, 45 * degree);
  // The same seed gives the same scenes in the recipe of one set and in that of both.
  EXPECT_EQ(paper.sets[0].kinds[0], read_recipe(file("set-a.toml")).sets.at(0).kinds.at(0));
  EXPECT_EQ(paper.sets[1].kinds[0], read_recipe(file("set-b.toml")).sets.at(0).kinds.at(0));
  EXPECT_EQ(paper.seed, read_recipe(file("set-a.toml")).seed);
}

const std::string bar =
    "[[set]]\n"
    "name = \"B\"\n"
    "tubes = [3]\n"
    "[set.tube]\n"
    "radius = 0.006\n"
    "density = 2700\n"
    "ends = \"flat\"\n"
    "piece = [\n"
    "  { length = 0.05 },\n"
    "  { bend_deg = { min = 90, max = 110 }, bend_radius = 0.02 },\n"
    "  { length = { one_of = [0.06, 0.08], per = \"tube\" } },\n"
    "  { bend_deg = 90, bend_radius = 0.02, twist_deg = 180 },\n"
    "  { length = 0.05 },\n"
    "]\n";

TEST(RecipeOfBars, HasPiecesWithNumbersOfTheirOwn) {
  const Recipe recipe = read(bar);
  const TubeSpec& spec = recipe.sets[0].kinds[0];
  EXPECT_TRUE(spec.flat_ends);
  EXPECT_TRUE(spec.segments.empty());
  ASSERT_EQ(spec.pieces.size(), 5U);
  EXPECT_EQ(spec.pieces[0], (Piece{.length = 0.05}));
  EXPECT_EQ(spec.pieces[3], (Piece{.bend = 90 * degree, .bend_radius = 0.02, .twist = 180 * degree}));
  const CaseId id{"B", 3, 1};
  const Recipe drawn = resolve(recipe, id, draw(recipe, id));
  std::set<double> bends;
  for (int tube = 1; tube <= 3; ++tube) {
    const TubeSpec& kind = kind_of(drawn.sets[0], tube);
    bends.insert(kind.pieces[1].bend);
    EXPECT_TRUE(kind.pieces[2].length == 0.06 || kind.pieces[2].length == 0.08);
  }
  EXPECT_EQ(bends.size(), 1U) << "drawn for the scene";
  EXPECT_GE(*bends.begin(), 90 * degree);
  EXPECT_LE(*bends.begin(), 110 * degree);
}

TEST(RecipeOfBars, ReadsBackAsTheSameValue) {
  const Recipe recipe = read(bar);
  EXPECT_EQ(read(write(recipe)), recipe);
  EXPECT_THAT(write(recipe), HasSubstr("[[set.tube.piece]]\nlength = 0.05\n"));
  EXPECT_THAT(write(recipe), HasSubstr("ends = \"flat\"\n"));
}

TEST(RecipeOfBars, InheritsAllButTheShape) {
  const std::string chain_by_default =
      "[tube]\nradius = 0.006\nmass = 1\nlength = 0.5\nbend_max_deg = 30\nends = \"flat\"\n";
  const TubeSpec spec =
      read(chain_by_default + "[[set]]\nname = \"B\"\ntubes = [3]\n[[set.tube.piece]]\nlength = 0.2\n")
          .sets[0]
          .kinds[0];
  EXPECT_EQ(spec.pieces.size(), 1U);
  EXPECT_EQ(spec.mass, 1);
  EXPECT_TRUE(spec.flat_ends);
}

TEST(RecipeOfBars, NamesWhatIsWrongWithAPiece) {
  EXPECT_THAT(complaint_after("{ length = 0.05 },\n]", "{ length = 0.05, bend_deg = 3 },\n]", bar),
              HasSubstr("set[0].tube.piece[4].bend_deg"));
  EXPECT_THAT(complaint_after("{ length = 0.05 },\n]", "{ bend_deg = 3 },\n]", bar),
              HasSubstr("set[0].tube.piece[4].bend_radius"));
  EXPECT_THAT(complaint_after("{ length = 0.05 },\n]", "{ lenght = 0.05 },\n]", bar), HasSubstr("length"));
  EXPECT_THAT(complaint_after("bend_deg = 90, bend_radius = 0.02", "bend_deg = 90, bend_radius = 0.002", bar),
              HasSubstr("set[0].tube.piece[3].bend_radius: found 0.002, expected at least the bar's radius"));
  EXPECT_THAT(complaint_after("bend_deg = 90", "bend_deg = 0", bar),
              HasSubstr("set[0].tube.piece[3].bend_deg: found 0, expected more than 0"));
  EXPECT_THAT(complaint_after("\"flat\"", "\"cut\"", bar),
              HasSubstr("set[0].tube.ends: found 'cut', expected \"round\" or \"flat\""));
  EXPECT_THAT(complaint_after("density = 2700\n", "density = 2700\nbend_max_deg = 30\n", bar),
              HasSubstr("piece"));
  EXPECT_THAT(complaint_after("radius = 0.006\n", "radius = 0.006\nlength = 0.5\n", bar), HasSubstr("piece"));
}

TEST(RecipeOfBars, APieceLongerThanTheBinIsRefused) {
  EXPECT_THAT(complaint_after("{ length = 0.05 },\n]", "{ length = 0.9 },\n]", bar),
              HasSubstr("set[0].tube.piece[4].length: found a straight piece of up to 0.9 m"));
}

TEST(RecipeFormat, IsTheFirstThingThatIsWritten) {
  const std::string text = write(read(smallest));
  EXPECT_THAT(text, ::testing::MatchesRegex("#[^\n]*\nformat = 1\nseed = 0\n.*"));
}

TEST(RecipeFormat, MayBeLeftOut) {
  EXPECT_EQ(read("format = 1\n" + smallest), read(smallest));
}

TEST(RecipeFormat, ThatIsLaterIsSaidBeforeAnythingElse) {
  EXPECT_EQ(complaint("# later\nformat = 2\nnew_key = { one_of = 3 }\n" + smallest),
            "r.toml:2: this recipe's format is 2; this version of Tanglebin reads up to 1");
  EXPECT_THAT(complaint("format = 9223372036854775807\n"), HasSubstr("format is 9223372036854775807;"));
  EXPECT_EQ(complaint("format = 0\n" + smallest), "r.toml:1: format: found 0, expected at least 1");
  EXPECT_THAT(complaint("format = -1\n" + smallest),
              HasSubstr("r.toml:1: format: found -1, expected a whole"));
  EXPECT_THAT(complaint("format = \"1\"\n" + smallest),
              HasSubstr("r.toml:1: format: found '1', expected a whole number"));
  EXPECT_THAT(complaint("format = { one_of = [1] }\n" + smallest),
              HasSubstr("r.toml:1: format: found a table, expected a whole number"));
}

TEST(RecipeDifference, NamesTheFirstSettingAndBothValues) {
  const Recipe recipe = read(smallest + tree);
  const auto against = [&](const auto& change) {
    Recipe other = recipe;
    change(other);
    return difference(recipe, other).value_or("none");
  };
  EXPECT_EQ(against([](Recipe&) {}), "none");
  EXPECT_EQ(against([](Recipe& other) { other.sets[0].kinds[0].segments[0].bend_max = 45 * degree; }),
            "set[0].tube.bend_max_deg: it has 30.0, this one 45.0");
  EXPECT_EQ(against([](Recipe& other) { other.sets[1].kinds[0].segments[1].to = 4; }),
            "set[1].tube.segment[1].to: it has 3, this one 4");
  EXPECT_EQ(against([](Recipe& other) {
              other.sets[0].tubes = {1, 2};
            }),
            "set[0].tubes: it has [1, 10], this one [1, 2]");
  EXPECT_EQ(against([](Recipe& other) { other.sets.pop_back(); }),
            "set[1].name: it has \"C\", this one nothing");
  EXPECT_EQ(against([](Recipe& other) { other.camera.pose.translation().z() = 3; }),
            "scanner.position: it has [0.0, 0.0, 2.0], this one [0.0, 0.0, 3.0]");
  EXPECT_EQ(against([](Recipe& other) { other.sensor.sigma = 0.001; }),
            "scanner.sigma: it has nothing, this one 0.001");
  EXPECT_EQ(against([](Recipe& other) {
              other.random = {{"bin.friction", RandomNumber{1, 2, {}}}};
            }),
            "bin.friction: it has 100.0, this one { min = 1.0, max = 2.0 }");
}

TEST(RecipeDifference, IsNoMatterOfSpelling) {
  const std::string text = "[bin]\nheight = { min = 1, max = 2.0 }\n";
  EXPECT_EQ(read(text + smallest), read(smallest + "[bin]\nheight = { max = 2, min = 1.0 }\n"));
}

TEST(RecipeDifference, IsNoneForAnAngleThatHasNoDegreesAndWasWritten) {
  Recipe recipe = read(smallest);
  for (double radians = 1.2; radians < 1.2 + 1e-14; radians = std::nextafter(radians, 2.0)) {
    recipe.sets[0].kinds[0].segments[0].bend_max = radians;
    EXPECT_EQ(difference(read(write(recipe)), recipe), std::nullopt);
  }
}

TEST(Cases, AreInTheRecipesOrder) {
  Recipe recipe = read("[[set]]\nname = \"B\"\ntubes = [10, 2]\ncases = 2\n" +
                       smallest.substr(smallest.find("[set.tube]")) + smallest);
  recipe.sets[1].cases = 1;
  EXPECT_THAT(cases(recipe), ElementsAre(CaseId{"B", 10, 1}, CaseId{"B", 10, 2}, CaseId{"B", 2, 1},
                                         CaseId{"B", 2, 2}, CaseId{"A", 1, 1}, CaseId{"A", 10, 1}));
  EXPECT_EQ(folder_name("A", 10), "A10");
}

TEST(RecipeErrors, NameAFileThatIsMissing) {
  EXPECT_EQ(test::complaint([] { read_recipe(std::filesystem::path("/nowhere/r.toml")); }),
            "/nowhere/r.toml: cannot be opened: No such file or directory");
}

TEST(RecipeErrors, NameAFolderThatIsNoFile) {
  EXPECT_THROW(read_recipe(std::filesystem::temp_directory_path()), InputError);
}

TEST(RecipeErrors, NameTheLineThatIsNotToml) {
  EXPECT_THAT(complaint("seed = 1\nattempts = = 2\n"), HasSubstr("r.toml:2: "));
  EXPECT_THAT(complaint("seed = 1\nseed = 2\n"), HasSubstr("r.toml:2: "));
  EXPECT_THAT(complaint("seed = \"\n"), HasSubstr("r.toml:1: "));
  EXPECT_THAT(complaint("\n[[[set]]\n"), HasSubstr("r.toml:2: ")) << "found by fuzzing";
  EXPECT_THAT(complaint("seed = 1 \xC3\xA9\n"), HasSubstr("r.toml:1: ")) << "found by fuzzing";
  EXPECT_THAT(complaint("seed =t\n"),
              ::testing::AllOf(HasSubstr("r.toml:1: "), ::testing::Not(HasSubstr("\n"))))
      << "found by fuzzing";
}

TEST(RecipeErrors, GuessWhatAnUnknownKeyMeans) {
  EXPECT_EQ(complaint("sead = 1\n" + smallest), "r.toml:1: unknown key 'sead', did you mean 'seed'?");
  EXPECT_EQ(complaint("[bin]\nhieght = 1\n" + smallest),
            "r.toml:2: bin: unknown key 'hieght', did you mean 'height'?");
  EXPECT_EQ(complaint("[scanner]\nhfov = 1\n" + smallest),
            "r.toml:2: scanner: unknown key 'hfov', did you mean 'hfov_deg'?");
  EXPECT_EQ(complaint("[settle]\ntime_limt = 1\n" + smallest),
            "r.toml:2: settle: unknown key 'time_limt', did you mean 'time_limit'?");
  EXPECT_EQ(complaint_after("tubes =", "tube_counts = 3\ntubes ="),
            "r.toml:3: set[0]: unknown key 'tube_counts', expected one of name, tubes, cases, tube");
  EXPECT_EQ(complaint_after("bend_max_deg", "bend_max"),
            "r.toml:8: set[0].tube: unknown key 'bend_max', did you mean 'bend_max_deg'?");
  EXPECT_EQ(complaint_after("to = 3", "too = 3", tree),
            "r.toml:14: set[0].tube.segment[1]: unknown key 'too', did you mean 'to'?");
  EXPECT_EQ(complaint("[output]\nply = true\n" + smallest),
            "r.toml:2: output: unknown key 'ply', did you mean 'plys'?");
  EXPECT_EQ(complaint("\"a\\nb\" = 1\n" + smallest),
            "r.toml:1: unknown key 'a\\x0ab', expected one of format, seed, attempts, bin, scanner, settle, "
            "output, tube, set");
}

TEST(RecipeErrors, NameWhatIsMissing) {
  EXPECT_EQ(complaint(""), "r.toml: set: found none, expected at least one [[set]]");
  EXPECT_EQ(complaint_after("name = \"A\"\n", ""), "r.toml:1: set[0].name: is missing");
  EXPECT_EQ(complaint_after("tubes = [1, 10]\n", ""), "r.toml:1: set[0].tubes: is missing");
  EXPECT_EQ(complaint("[[set]]\nname = \"A\"\ntubes = [1]\n"), "r.toml:1: set[0].tube: is missing");
  EXPECT_EQ(complaint_after("radius = 0.0125\n", ""), "r.toml:4: set[0].tube.radius: is missing");
  EXPECT_EQ(complaint_after("bend_max_deg = 30\n", ""), "r.toml:4: set[0].tube.bend_max_deg: is missing");
  EXPECT_EQ(complaint_after("to = 3\n", "", tree), "r.toml:12: set[0].tube.segment[1].to: is missing");
}

TEST(RecipeErrors, NameAValueOfTheWrongType) {
  EXPECT_EQ(complaint("seed = \"7\"\n" + smallest), "r.toml:1: seed: found '7', expected a whole number");
  EXPECT_EQ(complaint("attempts = 1.0\n" + smallest),
            "r.toml:1: attempts: found 1.0, expected a whole number");
  EXPECT_EQ(complaint("[bin]\nlength = true\n" + smallest),
            "r.toml:2: bin.length: found true, expected a number");
  EXPECT_EQ(complaint("[bin]\nlength = 1979-05-27\n" + smallest),
            "r.toml:2: bin.length: found a date or time, expected a number");
  EXPECT_EQ(complaint("[bin]\npreset = 1\n" + smallest), "r.toml:2: bin.preset: found 1, expected a string");
  EXPECT_EQ(complaint("bin = 1\n" + smallest), "r.toml:1: bin: found 1, expected a table [bin]");
  EXPECT_EQ(complaint("[output]\nworlds = 1\n" + smallest),
            "r.toml:2: output.worlds: found 1, expected true or false");
  EXPECT_EQ(complaint_after("[1, 10]", "10"),
            "r.toml:3: set[0].tubes: found 10, expected an array of whole numbers");
  EXPECT_EQ(complaint_after("[1, 10]", "[1, 2.5]"),
            "r.toml:3: set[0].tubes: found 2.5, expected a whole number");
  EXPECT_EQ(complaint("set = {}\n"), "r.toml:1: set: found a table, expected an array of tables [[set]]");
  EXPECT_EQ(complaint("set = [1]\n"), "r.toml:1: set: found 1, expected an array of tables [[set]]");
  EXPECT_EQ(complaint("[scanner]\nposition = [1, 2]\n" + smallest),
            "r.toml:2: scanner.position: found an array of 2, expected an array of 3 numbers");
  EXPECT_EQ(complaint("[scanner]\nrotation_matrix = [[1, 0, 0], [0, 1, 0]]\n" + smallest),
            "r.toml:2: scanner.rotation_matrix: found an array of 2, expected an array of 3 rows");
  EXPECT_EQ(complaint("[scanner]\nrotation_matrix = [1, 0, 0]\n" + smallest),
            "r.toml:2: scanner.rotation_matrix: found 1, expected an array of 3 numbers");
}

TEST(RecipeErrors, NameANumberOutOfItsRange) {
  EXPECT_EQ(complaint("seed = -1\n" + smallest),
            "r.toml:1: seed: found -1, expected a whole number from 0 to 9223372036854775807");
  EXPECT_THAT(complaint("seed = 9223372036854775808\n" + smallest), HasSubstr("r.toml:1: "));
  EXPECT_EQ(complaint("attempts = 0\n" + smallest), "r.toml:1: attempts: found 0, expected at least 1");
  EXPECT_EQ(complaint("attempts = 3000000000\n" + smallest),
            "r.toml:1: attempts: found 3000000000, expected a whole number from -2147483648 to 2147483647");
  EXPECT_EQ(complaint("[bin]\nlength = inf\n" + smallest),
            "r.toml:2: bin.length: found inf, expected a finite number");
  EXPECT_EQ(complaint("[bin]\nlength = nan\n" + smallest),
            "r.toml:2: bin.length: found nan, expected a finite number");
  EXPECT_THAT(complaint("[bin]\nlength = 1\nwidth = -1\n" + smallest),
              HasSubstr("r.toml:3: bin.width: found -1"));
  EXPECT_THAT(complaint("[scanner]\nwidth = 0\n" + smallest), HasSubstr("r.toml:2: scanner.width: found 0"));
  EXPECT_THAT(complaint("[scanner]\nwidth = -2147483648\n" + smallest),
              HasSubstr("r.toml:2: scanner.width: found"));
  EXPECT_EQ(
      complaint("[scanner]\nwidth = 65535\nheight = 65535\n" + smallest),
      "r.toml:2: scanner.width: found 65535 x 65535 pixels, expected an image of at most 67108864 pixels "
      "(8192 x 8192)");
  EXPECT_EQ(complaint("[scanner]\nhfov_deg = 180\n" + smallest),
            "r.toml:2: scanner.hfov_deg: found 180, expected an angle between 0 and 180");
  EXPECT_EQ(complaint("[scanner]\nfocal_length_px = -5\n" + smallest),
            "r.toml:2: scanner.focal_length_px: found -5, expected a positive number of pixels");
  EXPECT_EQ(complaint("[scanner]\nrotation_wxyz = [0, 0, 0, 0]\n" + smallest),
            "r.toml:2: scanner.rotation_wxyz: found a quaternion of norm 0, expected a unit quaternion");
  EXPECT_THAT(complaint("[scanner]\nrotation_matrix = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]\n" + smallest),
              HasSubstr("r.toml:1: scanner."))
      << "a mirror image is no rotation";
  EXPECT_THAT(complaint("[settle]\nerp = 0.2\nstep = -1\n" + smallest),
              HasSubstr("r.toml:3: settle.step: found -1"));
  EXPECT_EQ(complaint("[settle]\nstep = 1e-12\n" + smallest),
            "r.toml:2: settle.step: found 1e-12, expected at least a millionth of settle.time_limit");
}

TEST(RecipeErrors, NameTheTubeThatCannotBeDrawn) {
  EXPECT_EQ(complaint_after("radius = 0.0125", "radius = -1"),
            "r.toml:5: set[0].tube.radius: found -1, expected a positive number");
  EXPECT_EQ(complaint_after("bend_max_deg = 30", "bend_max_deg = 181"),
            "r.toml:8: set[0].tube.bend_max_deg: found 181°, expected an angle from 0 to 180°");
  EXPECT_EQ(complaint_after("bend_max_deg = 30", "bend_max_deg = 30\nbend_min_deg = 45"),
            "r.toml:9: set[0].tube.bend_min_deg: found 45°, expected at most bend_max_deg, 30°");
  EXPECT_EQ(
      complaint_after("cylinders_max = 5", "cylinders_max = 6", tree),
      "r.toml:17: set[0].tube.segment[1].cylinders_max: found 6 cylinders of at least 0.02 m, which make "
      "0.12 m, expected no more than the length, 0.1 m");
  EXPECT_EQ(complaint_after("from = 1\nto = 3", "from = 4\nto = 3", tree),
            "r.toml:13: set[0].tube.segment[1].from: found node 4, expected node 1 or the end of an earlier "
            "segment");
}

TEST(RecipeErrors, NameASetWithoutCases) {
  EXPECT_EQ(complaint_after("[1, 10]", "[]"),
            "r.toml:3: set[0].tubes: found none, expected at least one number of tubes");
  EXPECT_EQ(complaint_after("[1, 10]", "[0]"),
            "r.toml:3: set[0].tubes: found 0, expected a number of tubes from 1 to 1000");
  EXPECT_EQ(complaint_after("[1, 10]", "[1001]"),
            "r.toml:3: set[0].tubes: found 1001, expected a number of tubes from 1 to 1000");
  EXPECT_EQ(complaint_after("[1, 10]", "[1, 2, 1]"),
            "r.toml:3: set[0].tubes: found 1 twice, expected different numbers");
  EXPECT_EQ(complaint_after("[1, 10]", "[1]\ncases = 0"),
            "r.toml:4: set[0].cases: found 0, expected at least 1");
}

TEST(RecipeErrors, CountTheCasesBeforeTheyFillTheMemory) {
  EXPECT_EQ(complaint_after("[1, 10]", "[1, 10]\ncases = 2000000000"),
            "r.toml:4: set[0].cases: found 4000000000 cases in total, expected at most 1000000");
}

TEST(RecipeErrors, NameASetThatIsNoFolder) {
  const std::string expected = ", expected 1 to 64 letters, digits, '-' and '_'";
  EXPECT_EQ(complaint_after("\"A\"", "\"\""), "r.toml:2: set[0].name: found ''" + expected);
  EXPECT_EQ(complaint_after("\"A\"", "\"../A\""), "r.toml:2: set[0].name: found '../A'" + expected);
  EXPECT_EQ(complaint_after("\"A\"", "\"a b\""), "r.toml:2: set[0].name: found 'a b'" + expected);
  EXPECT_EQ(complaint_after("\"A\"", "\"Ä\""), "r.toml:2: set[0].name: found 'Ä'" + expected);
  EXPECT_THAT(complaint_after("\"A\"", "\"" + std::string(65, 'x') + "\""), HasSubstr(expected));
}

TEST(RecipeErrors, NameSetsThatShareAFolder) {
  EXPECT_EQ(complaint(smallest + smallest), "r.toml:10: set[1].name: found 'A' twice, expected unique names");
  const auto with = [](const std::string& set) { return set + smallest.substr(smallest.find("[set.tube]")); };
  EXPECT_EQ(complaint(with("[[set]]\nname = \"A\"\ntubes = [1, 11]\n") +
                      with("[[set]]\nname = \"A1\"\ntubes = [1]\n")),
            "r.toml:11: set[1].tubes: found 1, whose folder A11 also belongs to set 'A', expected different "
            "folders");
}

TEST(RecipeErrors, NameKeysThatContradictEachOther) {
  EXPECT_EQ(complaint("[scanner]\nhfov_deg = 60\nfocal_length_px = 2000\n" + smallest),
            "r.toml:3: scanner.focal_length_px: cannot be combined with hfov_deg");
  EXPECT_EQ(complaint("[scanner]\nfx = 2000\nhfov_deg = 60\nfy = 2000\n" + smallest),
            "r.toml:2: scanner.fx: cannot be combined with hfov_deg");
  EXPECT_EQ(complaint("[scanner]\nfx = 2000\n" + smallest), "r.toml:1: scanner.fy: is missing");
  EXPECT_EQ(complaint("[scanner]\nrotation_wxyz = [1, 0, 0, 0]\nrotation_matrix = []\n" + smallest),
            "r.toml:3: scanner.rotation_matrix: cannot be combined with rotation_wxyz");
  EXPECT_EQ(complaint_after("mass = 0.75", "mass = 0.75\nlength = 1", tree),
            "r.toml:7: set[0].tube.length: cannot be combined with segment");
}

TEST(RecipeErrors, NameAnUnknownPreset) {
  EXPECT_THAT(complaint("[bin]\npreset = \"big\"\n" + smallest), HasSubstr("r.toml:2: bin"));
  EXPECT_THAT(complaint("[scanner]\npreset = \"big\"\n" + smallest), HasSubstr("r.toml:2: scanner"));
}

TEST(RecipeErrors, NameABinSmallerThanATube) {
  EXPECT_EQ(complaint("[bin]\nlength = 0.3\nwidth = 0.2\nheight = 0.1\n" + smallest),
            "r.toml:11: set[0].tube.length: found a straight piece of up to 0.42 m, expected at most "
            "0.334477 m, the longest that fits in the bin");
  EXPECT_EQ(
      complaint_after("radius = 0.0125", "radius = 0.2"),
      "r.toml:5: set[0].tube.radius: found a tube 0.4 m thick, expected less than the 0.37 m between the "
      "bin's walls");
  EXPECT_THAT(complaint_after("bend_max_deg = 30", "bend_max_deg = 0"), "none");
  EXPECT_EQ(complaint_after("length = 0.5\nbend_max_deg = 30", "length = 0.7\nbend_max_deg = 0"),
            "r.toml:7: set[0].tube.length: found a straight piece of up to 0.7 m, expected at most "
            "0.652131 m, the longest that fits in the bin");
}

TEST(RecipeErrors, AreFoundAfterAChangeToo) {
  Recipe recipe = read(smallest);
  EXPECT_NO_THROW(validate(recipe));
  recipe.seed = std::numeric_limits<std::uint64_t>::max();
  EXPECT_THROW(validate(recipe), InputError) << "no TOML file can hold that seed";
  recipe.seed = 1;
  recipe.sets.clear();
  EXPECT_THROW(validate(recipe), InputError);
}

}  // namespace
}  // namespace tanglebin
