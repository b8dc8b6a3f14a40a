#include "tanglebin/files/json_record.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;

std::string nested(std::size_t levels, const std::string& open, const std::string& close) {
  std::string text;
  for (std::size_t i = 0; i < levels; ++i) text += open;
  text += "1";
  for (std::size_t i = 0; i < levels; ++i) text += close;
  return text;
}

TEST(ParseJson, IsAnyJsonOrDiscarded) {
  EXPECT_EQ(parse_json(R"({"a":[1,2.5,null]})", {}).dump(), R"({"a":[1,2.5,null]})");
  EXPECT_TRUE(parse_json("{\"a\":", {}).is_discarded());
  EXPECT_TRUE(parse_json("", {}).is_discarded());
}

TEST(ParseJson, MayBeNestedSixtyFourDeep) {
  EXPECT_EQ(parse_json(nested(64, "[", "]"), {}).dump(), nested(64, "[", "]"));
  EXPECT_EQ(parse_json(nested(64, R"({"a":)", "}"), {}).dump(), nested(64, R"({"a":)", "}"));
}

TEST(ParseJson, NestedDeeperIsAnErrorHoweverDeepItIs) {
  for (const std::size_t levels : {65U, 400000U}) {
    for (const auto& text : {nested(levels, "[", "]"), nested(levels, R"({"a":)", "}"),
                             nested(levels, R"({"a":[)", "]}"), nested(levels, "[", "")}) {
      EXPECT_EQ(complaint([&] {
                  parse_json(text, {"dataset.json", 3, ""});
                }),
                "dataset.json:3: found JSON nested too deep, expected at most 64 levels");
    }
  }
}

std::string object_of(int keys) {
  std::string text = "{";
  for (int i = 0; i < keys; ++i) text += fmt::format("{}\"{}\":{{\"a\":{}}}", i == 0 ? "" : ",", i, i);
  return text + "}";
}

TEST(ParseJson, AnObjectMayHaveTenThousandKeys) {
  EXPECT_EQ(parse_json(object_of(10000), {}).size(), 10000U);
  EXPECT_EQ(parse_json("[" + object_of(6000) + "," + object_of(6000) + "]", {}).size(), 2U);
  for (const std::string& text : {object_of(10001), "{\"b\":" + object_of(10001) + "}"}) {
    EXPECT_EQ(complaint([&] {
                parse_json(text, {"camera.json", 0, ""});
              }),
              "camera.json: found a JSON object with too many keys, expected at most 10000");
  }
}

TEST(JsonText, HasNoBytesThatAreNotUtf8) {
  EXPECT_EQ(json_text({{"directory", "d\xe9s"}, {"größe", 1.5}}), R"({"directory":"d�s","größe":1.5})");
}

TEST(JsonRecord, TextThatIsMissingOrNullIsNone) {
  const JsonRecord record(R"({"scanner":"left","dataset":null,"cases":3})", "experiment.json", 2);
  EXPECT_EQ(record.text_if_there("scanner"), "left");
  EXPECT_EQ(record.text_if_there("dataset"), std::nullopt);
  EXPECT_EQ(record.text_if_there("digest"), std::nullopt);
  EXPECT_EQ(complaint([&] { record.text_if_there("cases"); }),
            "experiment.json:2: cases: found '3', expected text");
}

TEST(JsonRecord, NestedTooDeepIsAnErrorThatNamesTheFile) {
  const std::string text = "{\"a\":" + nested(400000, "[", "]") + "}";
  EXPECT_EQ(complaint([&] { JsonRecord(text, "experiment.json", 0); }),
            "experiment.json: found JSON nested too deep, expected at most 64 levels");
}

}  // namespace
}  // namespace tanglebin
