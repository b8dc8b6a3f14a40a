#include "tanglebin/dataset/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tanglebin/base/error.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

CaseRecord example_record() {
  return {{"A", 10, 3},
          0xfedcba9876543210U,  // more than a double holds
          1.25,
          0.000125,
          4321,
          {{17, 0.5, "a tube left the \"bin\"\t"}},
          {{"A10/plys/3.ply", 99, "abc"}, {"A10/tube_configurations/3.txt", 7, "def"}}};
}

TEST(Manifest, ACaseIsALineOfJson) {
  EXPECT_EQ(to_json(example_record()),
            R"({"set":"A","tubes":10,"case":3,"seed":"fedcba9876543210","simulated":1.25,)"
            R"("largest_overlap":0.000125,"points":4321,)"
            R"("rejected":[{"seed":"0000000000000011","simulated":0.5,"fault":"a tube left the \"bin\"\t"}],)"
            R"("files":[{"path":"A10/plys/3.ply","bytes":99,"sha256":"abc"},)"
            R"({"path":"A10/tube_configurations/3.txt","bytes":7,"sha256":"def"}]})");
}

TEST(Manifest, ACaseReadsBackAsItWas) {
  const std::string line = to_json(example_record());
  EXPECT_EQ(to_json(case_record(line, "manifest.jsonl", 1)), line);
}

TEST(Manifest, WhatWasDrawnForATubeStandsInItsPlace) {
  CaseRecord record = example_record();
  record.drawn = {
      {"bin.height", 0.2}, {"set[0].tube", 1, 1}, {"set[0].tube[1].radius", 0.01, 1}, {"set[0].tube", 0, 3}};
  const std::string line = to_json(record);
  EXPECT_THAT(
      line,
      testing::HasSubstr(
          R"("drawn":{"bin.height":0.2},)"
          R"("drawn_tubes":[{"set[0].tube":1.0,"set[0].tube[1].radius":0.01},{},{"set[0].tube":0.0}],)"));
  EXPECT_EQ(case_record(line, "manifest.jsonl", 1).drawn, record.drawn);
  EXPECT_EQ(to_json(case_record(line, "manifest.jsonl", 1)), line);
}

TEST(Manifest, WhatWasDrawnForATubeIsANumber) {
  CaseRecord record = example_record();
  record.drawn = {{"set[0].tube.radius", 0.01, 1}};
  std::string line = to_json(record);
  line.replace(line.find("0.01}"), 4, "true");
  EXPECT_THAT(test::complaint([&] { case_record(line, "manifest.jsonl", 12); }),
              testing::StartsWith("manifest.jsonl:12: drawn_tubes[0].set[0].tube.radius: found"));
}

TEST(Manifest, TimesReadBackAsTheyWere) {
  const TimesRecord times{{"A", 10, 3}, {0.001, 0.25, 0.0125, 0.003}, 64.5};
  const std::string line = to_json(times);
  EXPECT_EQ(line,
            R"({"set":"A","tubes":10,"case":3,"generate":0.001,"settle":0.25,"scan":0.0125,"write":0.003,)"
            R"("peak_memory":64.5})");
  EXPECT_EQ(to_json(times_record(line, "times.jsonl", 1)), line);
}

TEST(Manifest, APathThatLeadsOutOfTheDatasetIsAnError) {
  for (const std::string path : {"/etc/passwd", "../1.ply", "A10/../../1.ply", "A10/./1.ply", "A10/", "", ".",
                                 "..", "A10/plys/../plys/1.ply", "A10//1.ply", "A10/1\\n.ply"}) {
    std::string line = to_json(example_record());
    const std::string good = "A10/plys/3.ply";
    line.replace(line.find(good), good.size(), path);
    EXPECT_THAT(test::complaint([&] { case_record(line, "manifest.jsonl", 12); }),
                testing::AllOf(testing::StartsWith("manifest.jsonl:12: "),
                               testing::HasSubstr("files[0].path: found ")))
        << path;
  }
}

// Found by fuzz/manifest_fuzz: such a number was converted to an integer that cannot hold it.
TEST(Manifest, ANumberThatIsNoWholeOneInRangeIsAnError) {
  for (const std::string number : {"1e300", "1.5", "-1", "18446744073709551616", "null", "\"7\"", "true"}) {
    std::string line = to_json(example_record());
    line.replace(line.find("4321,"), 4, number);
    EXPECT_THAT(
        test::complaint([&] { case_record(line, "manifest.jsonl", 12); }),
        testing::AllOf(testing::StartsWith("manifest.jsonl:12: "), testing::HasSubstr("points: found "),
                       testing::EndsWith("expected a whole number, 0 or more")))
        << number;
  }
  std::string line = to_json(example_record());
  line.replace(line.find("\"tubes\":10"), 10, "\"tubes\":3000000000");
  EXPECT_THAT(test::complaint([&] { case_record(line, "manifest.jsonl", 12); }),
              testing::HasSubstr("tubes: found 3000000000, expected 1 to 2147483647"));
}

// Found by fuzz/manifest_fuzz: such a line was taken for a case, and its manifest could then not be read,
// since of most lines no more is read than the case that they begin with.
TEST(Manifest, ALineThatDoesNotBeginWithItsCaseIsAnError) {
  const std::string begins = R"({"set":"A","tubes":10,"case":3,)";
  const std::string record = to_json(example_record());
  const std::string times = to_json(TimesRecord{{"A", 10, 3}, {0.001, 0.25, 0.0125, 0.003}, 64.5});
  ASSERT_THAT(record, testing::StartsWith(begins));
  ASSERT_THAT(times, testing::StartsWith(begins));
  for (const std::string beginning :
       {R"({"note":"","set":"A","tubes":10,"case":3,)", R"({"set":"A","tubes":10,"case":4,"case":3,)"}) {
    EXPECT_THAT(
        test::complaint([&] { case_record(beginning + record.substr(begins.size()), "manifest.jsonl", 12); }),
        testing::StartsWith("manifest.jsonl:12: "))
        << beginning;
    EXPECT_THAT(
        test::complaint([&] { times_record(beginning + times.substr(begins.size()), "times.jsonl", 12); }),
        testing::StartsWith("times.jsonl:12: "))
        << beginning;
  }
}

TEST(Manifest, ADamagedLineIsAnErrorThatSaysWhere) {
  const auto complaint_of = [](const std::string& line) {
    return test::complaint([&] { case_record(line, "manifest.jsonl", 12); });
  };
  EXPECT_EQ(complaint_of(""), "manifest.jsonl:12: found '', expected a JSON object");
  EXPECT_EQ(complaint_of("{"), "manifest.jsonl:12: found '{', expected a JSON object");
  EXPECT_EQ(complaint_of("[]"), "manifest.jsonl:12: found '[]', expected a JSON object");
  EXPECT_EQ(complaint_of(R"({"set":"A"})"), "manifest.jsonl:12: tubes: is missing");
  EXPECT_EQ(complaint_of(R"({"set":"A","tubes":"ten","case":1})"),
            "manifest.jsonl:12: tubes: found '\"ten\"', expected a whole number, 0 or more");
  EXPECT_EQ(complaint_of(R"({"set":"A","tubes":1,"case":1,"seed":"xyz"})"),
            "manifest.jsonl:12: seed: found 'xyz', expected a hexadecimal number of 64 bits");
  std::string line = to_json(example_record());
  line.replace(line.find("\"bytes\":7"), 9, "\"bytes\":x");
  EXPECT_THAT(complaint_of(line), testing::StartsWith("manifest.jsonl:12: found '{"));
  line.replace(line.find("\"bytes\":x"), 9, "\"bites\":7");
  EXPECT_EQ(complaint_of(line), "manifest.jsonl:12: files[1].bytes: is missing");
}

}  // namespace
}  // namespace tanglebin
