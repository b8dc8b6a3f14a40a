#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::HasSubstr;
using testing::StartsWith;

// What the program says of wrong usage.
std::string usage_error(const std::string& arguments) {
  const ProgramResult run = run_program(arguments);
  EXPECT_EQ(run.status, 64) << arguments;
  EXPECT_EQ(run.out, "") << arguments;
  return run.err;
}

TEST(Usage, AnUnknownCommandGetsTheNearestOneOrAll) {
  EXPECT_THAT(usage_error("generat"),
              StartsWith("tanglebin: unknown command 'generat', did you mean 'generate'?\n"));
  EXPECT_THAT(usage_error("fly"),
              StartsWith("tanglebin: unknown command 'fly', expected one of generate, merge, verify, "));
  EXPECT_THAT(usage_error(""), StartsWith("tanglebin: expected a command: generate, merge, verify, "));
}

TEST(Usage, AnUnknownOptionGetsTheNearestOne) {
  EXPECT_THAT(usage_error("generate r.toml --out d --case 3"),
              StartsWith("tanglebin: unknown option '--case', did you mean '--cases'?\n"));
  EXPECT_THAT(usage_error("report r --outt=r.html"),
              StartsWith("tanglebin: unknown option '--outt', did you mean '--out'?\n"));
  EXPECT_THAT(usage_error("--verbose"),
              HasSubstr("unknown option '--verbose', expected one of --help, --version"));
}

TEST(Usage, MissingValuesAndWrongNumbersAreNamedPlainly) {
  EXPECT_THAT(usage_error("report r --out"), StartsWith("tanglebin: --out: expected one value\n"));
  EXPECT_THAT(usage_error("report r --out a.html --out b.html"),
              StartsWith("tanglebin: --out: expected one value\n"));
  for (const std::string jobs : {"-1", "0", "1e9", "99999999999999999999", "two"}) {
    EXPECT_THAT(
        usage_error("verify d --jobs " + jobs),
        StartsWith("tanglebin: --jobs: found '" + jobs + "', expected a whole number from 1 to 1024\n"));
  }
  EXPECT_THAT(usage_error("verify d --progress xml"),
              StartsWith("tanglebin: --progress: found 'xml', expected line or json\n"));
}

TEST(Usage, ListsHaveCommas) {
  EXPECT_THAT(usage_error("generate r.toml --out d --tubes 1 5"),
              HasSubstr("lists have commas, such as 1,5,10"));
  EXPECT_THAT(usage_error("experiment d --out e --set A B"), HasSubstr("lists have commas"));
}

// The command says what it would say of the new name.
TEST(Usage, RenamedOptionsStillWorkAndSayTheirNewNames) {
  const auto expect_same = [](const std::string& old_name, const std::string& name, const std::string& before,
                              const std::string& after) {
    const ProgramResult run = run_program(before + old_name + after);
    const ProgramResult current = run_program(before + name + after);
    EXPECT_EQ(run.status, current.status);
    EXPECT_EQ(run.err, "tanglebin: " + old_name + " is now " + name + "\n" + current.err);
    EXPECT_THAT(current.err, HasSubstr("/nowhere"));
  };
  expect_same("--set", "--parameter", "scan /nowhere --out c.ply ", " scanner.sigma=0.1");
  expect_same("--tubes", "--modelled-tubes", "model /nowhere --out c.ply ", "=t.txt");
  expect_same("--labels", "--labelled", "score --truth /nowhere ", " c.ply");
  expect_same("--tubes", "--modelled-tubes", "score --truth /nowhere --labelled c.ply --true-tubes a.txt ",
              " b.txt");
}

TEST(Usage, NamesThatOtherCommandsRenamedKeepTheirMeaning) {
  EXPECT_EQ(run_program("scan /nowhere --out c.ply --labels l.png").err,
            run_program("scan /nowhere --out c.ply").err);
  EXPECT_EQ(run_program("generate /nowhere --out d --tubes 1 --set A").err,
            run_program("generate /nowhere --out d").err);
}

TEST(Usage, SeedsAreDecimalOrHexadecimalEverywhere) {
  const auto said = [](const std::string& command, const std::string& seed) {
    const ProgramResult run = run_program(command + " --seed " + seed);
    EXPECT_EQ(run.status, 2) << command;
    return run.err;
  };
  for (const std::string command : {"scan /nowhere --out c.ply", "model /nowhere --out c.ply"}) {
    for (const std::string seed : {"0", "31", "0x1f", "18446744073709551615", "0xffffffffffffffff"})
      EXPECT_THAT(said(command, seed), StartsWith("tanglebin: /nowhere: cannot be opened")) << seed;
    for (const std::string seed :
         {"1f", "-1", "0x", "1.5", "''", "18446744073709551616", "0x10000000000000000"})
      EXPECT_THAT(said(command, seed),
                  HasSubstr("expected a seed of at most 64 bits: decimal, or hexadecimal"))
          << seed;
  }
}

TEST(Usage, LearningLinksTakesNoScene) {
  const ProgramResult run = run_program("learn /nowhere --scene /nowhere.toml");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err,
              HasSubstr("--scene: links are learned from what the recipe says; only --confidence has it"));
}

TEST(Usage, ADirectoryWithoutADatasetIsNamed) {
  const test::TemporaryDirectory directory;
  const std::string empty = directory.path().string();
  const auto said = [](const std::string& arguments) {
    const ProgramResult run = run_program(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    return run.err;
  };
  const std::string expected = ", expected the directory of a dataset from `tanglebin generate`\n";
  EXPECT_EQ(said("verify " + empty), "tanglebin: " + empty + ": found no recipe.toml in it" + expected);
  EXPECT_EQ(said("learn /nowhere"), "tanglebin: /nowhere: found nothing" + expected);
  EXPECT_EQ(said("experiment /dev/null --out /nowhere"), "tanglebin: /dev/null: found a file" + expected);
  EXPECT_EQ(said("merge /nowhere --out " + empty), "tanglebin: /nowhere: found nothing" + expected);
}

}  // namespace
}  // namespace tanglebin
