#include "tanglebin/calibrate/learn_links_once.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tanglebin/base/error.hpp"
#include "tanglebin/model/axis/settings/link_weights.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

// Of the learned weights one is what ships. Links to junctions were not learned: the scenes have no trees.
TEST(LearnedLinks, TakeThePlaceOfThoseOfTheStartEvenIfTheyAreTheDefault) {
  const Parameters start = {{"axis.link.weights.chain_ends.gap", -5},
                            {"axis.link.weights.junction.gap", -7},
                            {"axis.vote.floor_margin", 0.4}};
  const Parameters learned = {{"axis.link.weights.chain_ends.gap", learned_weights.chain_ends[2]},
                              {"axis.link.weights.chain_ends.hidden", -0.25}};
  EXPECT_THAT(with_links(start, learned),
              ElementsAre(Pair("axis.link.weights.chain_ends.hidden", -0.25),
                          Pair("axis.link.weights.junction.gap", -7), Pair("axis.vote.floor_margin", 0.4)));
}

/// Ends a process that writes to a file with SIGXFSZ.
class NoFileMayGrow {
public:
  NoFileMayGrow() {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit none{.rlim_cur = 0, .rlim_max = before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &none);
  }
  ~NoFileMayGrow() { setrlimit(RLIMIT_FSIZE, &before_); }
  NoFileMayGrow(const NoFileMayGrow&) = delete;
  NoFileMayGrow& operator=(const NoFileMayGrow&) = delete;

private:
  rlimit before_{};
};

TEST(LearnedLinks, AWorkerThatCrashesEndsTheCalibrationWithItsReason) {
  const test::SmallDataset directory;
  const Dataset dataset = directory.read();
  const test::TemporaryDirectory work;
  const NoFileMayGrow every_worker_crashes;
  EXPECT_THAT([&] { learn_links_once(dataset, {cases(dataset).front()}, work / "links.toml", {}); },
              testing::ThrowsMessage<SystemError>(AllOf(
                  HasSubstr("links.toml: cannot learn the weights of links: its worker was ended by signal"),
                  HasSubstr("the second time"))));
}

}  // namespace
}  // namespace tanglebin
