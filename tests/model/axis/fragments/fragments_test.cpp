#include "tanglebin/model/axis/fragments/fragments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using testing::Each;
using testing::Field;
using testing::Ge;
using testing::IsEmpty;
using testing::SizeIs;

using test::radius;

// Votes along an axis, with the normals of the upper half of the surface around it.
void add_axis(AxisVotes& votes, const Vector3d& from, const Vector3d& to) {
  constexpr int along = 200;
  constexpr int around = 7;
  const Vector3d way = (to - from).normalized();
  const Vector3d side = way.cross(Vector3d::UnitZ()).normalized();
  const Vector3d up = side.cross(way);
  for (int i = 0; i <= along; ++i) {
    for (int j = 1; j < around; ++j) {
      const double angle = std::numbers::pi * j / around;
      votes.votes.push_back((from + (to - from) * i / along).cast<float>());
      votes.normals.push_back((std::cos(angle) * side + std::sin(angle) * up).cast<float>());
    }
  }
}

std::vector<Fragment> fragments_of(const AxisVotes& votes, bool with_branches = false) {
  return find_fragments(votes, radius, with_branches, {});
}

// Of a tube that has 50 votes on a radius of length, ten more in one place elsewhere.
TEST(Fragments, OfADenseCloudAreNoSpecks) {
  const auto with_speck = [](int votes_of_speck) {
    AxisVotes votes;
    for (int i = 0; i < 5; ++i) add_axis(votes, {-0.1, 0.02, 0.05}, {0.1, 0.02, 0.05});
    for (int i = 0; i < votes_of_speck; ++i) {
      votes.votes.emplace_back(0.001F * static_cast<float>(i % 3), -0.1F, 0.05F);
      votes.normals.emplace_back(0, 0.6F, 0.8F);
    }
    return fragments_of(votes);
  };
  EXPECT_THAT(with_speck(10), SizeIs(1));
  EXPECT_THAT(with_speck(40), SizeIs(2));
}

TEST(Fragments, EndWhereTheVotesEndAndPointOutwards) {
  const Vector3d from(-0.1, 0.02, 0.05);
  const Vector3d to(0.1, -0.03, 0.08);
  AxisVotes votes;
  add_axis(votes, from, to);
  const std::vector<Fragment> found = fragments_of(votes);
  ASSERT_THAT(found, SizeIs(1));
  const Fragment& fragment = found[0];
  EXPECT_EQ(fragment.points.size(), votes.votes.size());
  EXPECT_NEAR(fragment.length, (to - from).norm(), 0.006);
  ASSERT_THAT(fragment.ends, SizeIs(2));
  const bool starts_at_from =
      (fragment.ends[0].position - from).norm() < (fragment.ends[0].position - to).norm();
  const FragmentEnd& first = fragment.ends[starts_at_from ? 0 : 1];
  const FragmentEnd& last = fragment.ends[starts_at_from ? 1 : 0];
  const Vector3d way = (to - from).normalized();
  EXPECT_LT((first.position - from).norm(), 0.002);
  EXPECT_LT((last.position - to).norm(), 0.002);
  EXPECT_LT((first.outward + way).norm(), 0.02);
  EXPECT_LT((last.outward - way).norm(), 0.02);
}

// So short that its centre line has one node.
TEST(Fragments, HaveEndsWhereNoVoteIsInReach) {
  AxisVotes votes;
  add_axis(votes, {-0.1, 0.02, 0.05}, {0.1, 0.02, 0.05});
  FragmentSettings settings;
  settings.end_length = 0;
  const std::vector<Fragment> fragments = find_fragments(votes, radius, false, settings);
  ASSERT_THAT(fragments, SizeIs(1));
  ASSERT_THAT(fragments[0].ends, SizeIs(2));
  for (const FragmentEnd& end : fragments[0].ends) {
    EXPECT_NEAR(std::abs(end.position.x()), 0.1, radius);
    EXPECT_NEAR(end.outward.norm(), 1, 1e-9);
  }
}

TEST(Fragments, OfOneNodeHaveAnEndOnEitherSide) {
  AxisVotes votes;
  add_axis(votes, {-0.003, 0, 0.05}, {0.003, 0, 0.05});
  const std::vector<Fragment> found = fragments_of(votes);
  ASSERT_THAT(found, SizeIs(1));
  ASSERT_THAT(found[0].nodes, SizeIs(1));
  ASSERT_THAT(found[0].ends, SizeIs(2));
  const auto& [first, second] = std::tie(found[0].ends[0], found[0].ends[1]);
  EXPECT_EQ(first.outward, -second.outward);
  EXPECT_NEAR((first.position - second.position).norm(), 0.006, 0.002);
  EXPECT_GT((first.position - second.position).dot(first.outward), 0);
}

TEST(Fragments, OfTubesThatTouchAreTwo) {
  AxisVotes votes;
  add_axis(votes, {-0.1, 0, 0.05}, {0.1, 0, 0.05});
  add_axis(votes, {-0.1, 2 * radius, 0.05}, {0.1, 2 * radius, 0.05});
  EXPECT_THAT(fragments_of(votes), SizeIs(2));
}

// A slit between two others, a millimetre long: the votes say nothing of its direction, the normals do.
TEST(Fragments, OfASlitKnowTheirDirectionFromTheNormals) {
  AxisVotes votes;
  const Vector3d way = Vector3d(1, 1, 0).normalized();
  add_axis(votes, -0.0005 * way + Vector3d(0, 0, 0.05), 0.0005 * way + Vector3d(0, 0, 0.05));
  const std::vector<Fragment> found = fragments_of(votes);
  ASSERT_THAT(found, SizeIs(1));
  ASSERT_THAT(found[0].ends, SizeIs(2));
  for (const FragmentEnd& end : found[0].ends) EXPECT_GT(std::abs(end.outward.dot(way)), 0.99);
  EXPECT_LT(found[0].ends[0].outward.dot(found[0].ends[1].outward), -0.99);
}

// A tube that leans a little away from the sensor above: of its cap each vote is its centre, and the normals
// go all ways that the sensor sees.
TEST(Fragments, OfACapGoOnAwayFromItsNormals) {
  const Vector3d centre(0.05, 0, 0.1);
  const Vector3d axis = Vector3d(0.1, 0.05, 1).normalized();
  const Vector3d side = axis.cross(Vector3d::UnitX()).normalized();
  AxisVotes votes;
  constexpr int rings = 10;
  constexpr int around = 30;
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double polar = std::numbers::pi / 2 * i / rings;
      const double azimuth = 2 * std::numbers::pi * j / around;
      votes.votes.push_back(centre.cast<float>());
      votes.normals.push_back(
          (std::cos(polar) * axis + std::sin(polar) * (Eigen::AngleAxisd(azimuth, axis) * side))
              .cast<float>());
    }
  }
  const std::vector<Fragment> found = fragments_of(votes);
  ASSERT_THAT(found, SizeIs(1));
  ASSERT_THAT(found[0].ends, SizeIs(2));
  for (const FragmentEnd& end : found[0].ends) EXPECT_GT(std::abs(end.outward.dot(axis)), 0.999);
}

TEST(Fragments, BranchWhereTubesDo) {
  AxisVotes votes;
  add_axis(votes, {-0.1, 0, 0.05}, {0.1, 0, 0.05});
  add_axis(votes, {0, 0, 0.05}, {0, 0.1, 0.05});
  const std::vector<Fragment> tree = fragments_of(votes, true);
  ASSERT_THAT(tree, SizeIs(1));
  EXPECT_THAT(tree[0].ends, SizeIs(3));
  EXPECT_NEAR(tree[0].length, 0.3, 0.02);
  // Chains do not branch, so these are three.
  const std::vector<Fragment> chains = fragments_of(votes, false);
  ASSERT_THAT(chains, SizeIs(3));
  for (const Fragment& chain : chains) EXPECT_THAT(chain.ends, SizeIs(2));
}

TEST(Fragments, AreThin) {
  // The votes of a plane are a plane.
  AxisVotes votes;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      votes.votes.emplace_back(0.001F * static_cast<float>(i), 0.001F * static_cast<float>(j), 0.05F);
      votes.normals.emplace_back(0, 0, 1);
    }
  }
  EXPECT_THAT(fragments_of(votes), IsEmpty());
}

// Two tubes of 0.2 m in a line, whose ends touch. Hardly a patch fits on the joint.
TEST(Fragments, LongerThanATubeAreCutWhereTwoTubesTouch) {
  AxisVotes votes;
  for (int i = 0; i < 2; ++i) {
    add_axis(votes, {-0.2, 0, 0.05}, {-0.006, 0, 0.05});
    add_axis(votes, {0.006, 0, 0.05}, {0.2, 0, 0.05});
    add_axis(votes, {-0.1, 0.1, 0.05}, {0.1, 0.1, 0.05});
  }
  for (int i = 0; i < 10; ++i) {
    votes.votes.emplace_back(i % 2 == 0 ? -0.002F : 0.002F, 0.0F, 0.05F);
    votes.normals.emplace_back(0, 0.6F, 0.8F);
  }
  const std::vector<Fragment> found = fragments_of(votes);
  ASSERT_THAT(found, SizeIs(2));
  const auto cut_for = [&](double length_max) {
    std::vector<Fragment> cut = found;
    const bool is_cut = cut_too_long(cut, votes, radius, length_max, {});
    EXPECT_EQ(is_cut, cut.size() > found.size());
    return cut;
  };
  const std::vector<Fragment> cut = cut_for(0.206);
  ASSERT_THAT(cut, SizeIs(3));
  std::size_t points = 0;
  for (const Fragment& fragment : cut) {
    EXPECT_NEAR(fragment.length, 0.195, 0.01);
    ASSERT_THAT(fragment.ends, SizeIs(2));
    for (const FragmentEnd& end : fragment.ends) {
      EXPECT_NEAR(std::abs(end.outward.x()), 1, 0.01);
      EXPECT_LT((end.position - fragment.nodes[end.node]).norm(), 0.4 * radius);
    }
    points += fragment.points.size();
  }
  EXPECT_GE(points, votes.votes.size() - 10) << "only the joint is left out";
  EXPECT_THAT(cut_for(0.18), SizeIs(2)) << "both parts would be too long";
  EXPECT_THAT(cut_for(0.35), SizeIs(2)) << "the length may be wrong by so much";
}

TEST(Fragments, LongerThanATubeStayWholeWithoutAWeakPlace) {
  AxisVotes votes;
  add_axis(votes, {-0.2, 0, 0.05}, {0.2, 0, 0.05});
  std::vector<Fragment> found = fragments_of(votes);
  EXPECT_FALSE(cut_too_long(found, votes, radius, 0.25, {}));
  EXPECT_THAT(found, SizeIs(1));
}

// Its votes are a disc one radius inside.
TEST(Fragments, OfAFlatEndGoOnAwayFromIt) {
  const Vector3d outward = Vector3d(0.3, -0.1, 1).normalized();
  const Vector3d side = outward.unitOrthogonal();
  const Vector3d inside(0.1, 0, 0.15);
  AxisVotes votes;
  for (int i = 0; i < 400; ++i) {
    const double angle = 2.4 * i;  // a sunflower's seeds
    const double way = 0.8 * radius * std::sqrt(i / 400.0);
    const Vector3d place = std::cos(angle) * side + std::sin(angle) * outward.cross(side);
    votes.votes.push_back((inside + way * place).cast<float>());
    votes.normals.push_back(outward.cast<float>());
  }
  const std::vector<Fragment> found = fragments_of(votes);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].length, radius, 1e-9);
  ASSERT_THAT(found[0].ends, SizeIs(2));
  EXPECT_LT((found[0].ends[0].outward - outward).norm(), 0.01);
  EXPECT_LT((found[0].ends[0].position - inside - radius * outward).norm(), 0.1 * radius);
  EXPECT_LT((found[0].ends[1].outward + outward).norm(), 0.01);
  EXPECT_LT((found[0].ends[1].position - inside).norm(), 0.1 * radius);
}

TEST(Fragments, OfAHandfulOfVotesAreNone) {
  AxisVotes votes;
  for (int i = 0; i < FragmentSettings{}.points_min - 1; ++i) {
    votes.votes.emplace_back(0.001F * static_cast<float>(i), 0, 0.05F);
    votes.normals.emplace_back(0, 0, 1);
  }
  EXPECT_THAT(fragments_of(votes), IsEmpty());
  EXPECT_THAT(fragments_of({}), IsEmpty());
}

TEST(Fragments, AreTheLargestWhereThereAreTooMany) {
  std::vector<Fragment> fragments;
  for (const std::size_t points : {5U, 9U, 7U, 9U, 6U}) {
    fragments.push_back({.points = {}, .nodes = {}, .parents = {}, .ends = {}, .length = 0});
    fragments.back().points.resize(points);
  }
  EXPECT_EQ(keep_largest(fragments, 5), 0U);
  EXPECT_THAT(fragments, SizeIs(5));
  EXPECT_EQ(keep_largest(fragments, 3), 2U);
  EXPECT_THAT(fragments, Each(Field(&Fragment::points, SizeIs(Ge(7U)))));
  EXPECT_THAT(fragments, SizeIs(3));
}

}  // namespace
}  // namespace tanglebin
