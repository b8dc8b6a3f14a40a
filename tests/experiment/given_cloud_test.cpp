#include "tanglebin/experiment/given_cloud.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "tanglebin/experiment/modelled.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tests/experiment/small_dataset.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using test::SmallDataset;
using testing::HasSubstr;

class GivenCloudOfACase : public testing::Test {
protected:
  SeenPoints seen(double ratio) const {
    return seen_points(data_.cloud, known_, ratio, model_seed(settings_, id_));
  }

  SmallDataset directory_;
  Dataset dataset_ = directory_.read();
  ExperimentSettings settings_{.ratios = {0.4}, .model = {.seed = 5}};
  CaseId id_{"A", 3, 1};
  CaseData data_ = read_case(dataset_, id_);
  KnownScene known_ = known_scene(recipe_of(dataset_, id_), id_);
};

TEST_F(GivenCloudOfACase, IsScoredOnThePointsThatOurMethodsAreScoredOn) {
  for (const double ratio : {0.4, 1.0}) {
    const SeenPoints points = seen(ratio);
    for (const Method method : methods()) {
      const Model model = model_case(known_, data_, {name_of(method), id_, ratio}, settings_);
      EXPECT_EQ(points.scored, model.filtered) << name_of(method);
    }
    EXPECT_TRUE(std::ranges::includes(points.given, points.scored));
  }
}

TEST_F(GivenCloudOfACase, HasTheSharesOfTubesAndBinThatTheRatioSays) {
  const SeenPoints some = seen(0.4);
  const SeenPoints all = seen(1);
  EXPECT_EQ(all.given.size(), data_.cloud.points.size());
  EXPECT_NEAR(static_cast<double>(some.given.size()) / static_cast<double>(all.given.size()), 0.4, 0.01);
  EXPECT_GT(some.given.size(), some.scored.size());
}

// The bytes of both formats.
std::string bytes_of_given(const PointCloud& cloud, const SeenPoints& seen) {
  std::ostringstream bytes;
  const PointCloud given = given_cloud(cloud, seen);
  write_ply(bytes, given);
  write_pcd(bytes, given);
  return bytes.str();
}

TEST_F(GivenCloudOfACase, IsTheSameWhateverTheTruth) {
  PointCloud other = data_.cloud;
  for (std::int32_t& label : other.labels) label = 1 - label;
  other.colors.assign(other.points.size(), Color{1, 2, 3});
  other.normals.assign(other.points.size(), Eigen::Vector3f::UnitZ());
  other.mixed.assign(other.points.size(), 1);
  for (const double ratio : {0.4, 1.0}) {
    const std::string bytes = bytes_of_given(data_.cloud, seen(ratio));
    EXPECT_EQ(bytes, bytes_of_given(other, seen(ratio)));
    EXPECT_EQ(bytes.find("property int label"), std::string::npos);
    EXPECT_EQ(bytes.find("property uchar"), std::string::npos);
  }
}

TEST_F(GivenCloudOfACase, KeepsWhatAScannerMeasures) {
  PointCloud cloud = data_.cloud;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) cloud.intensities.push_back(static_cast<float>(i));
  cloud.viewpoint = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 2));
  const SeenPoints points = seen(0.4);
  const PointCloud given = given_cloud(cloud, points);
  EXPECT_EQ(given.intensities.back(), static_cast<float>(points.given.back()));
  EXPECT_EQ(given.points.back(), cloud.points[points.given.back()]);
  EXPECT_TRUE(given.viewpoint.has_value());
  EXPECT_EQ(given.height, 1U);
}

TEST_F(GivenCloudOfACase, LabelsInItsOrderAreAsManyAsItsPoints) {
  const PointCloud cloud = given_cloud(data_.cloud, seen(0.4));
  const std::vector<std::int32_t> labels(cloud.points.size(), 7);
  EXPECT_EQ(labels_of_points(cloud, labels, "out.npy"), labels);
  EXPECT_THAT(complaint([&] {
                labels_of_points(cloud, std::vector<std::int32_t>{1, 2}, "out.npy");
              }),
              HasSubstr("out.npy: found 2 labels, expected "));
}

}  // namespace
}  // namespace tanglebin
