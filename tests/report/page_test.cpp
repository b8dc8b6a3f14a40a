#include "tanglebin/report/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <tuple>

#include "tests/report/synthetic_results.hpp"

namespace tanglebin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

RunScore score(const RunKey& run, double micro_recall) {
  return {.run = run,
          .micro_recall = micro_recall,
          .mean_iou = 0.5,
          .f1 = 0.25,
          .panoptic_quality = 0.125,
          .adjusted_rand_index = 0.75,
          .centre_line_error = 0.0021,
          .true_joins = 10,
          .joins_found = 6,
          .joins_made = 8};
}

TimesRecord generation(const CaseId& id, double settle) {
  return {
      .id = id, .times = {.generate = 0.1, .settle = settle, .scan = 0.3, .write = 0.1}, .peak_memory = 90};
}

/// Ten tubes with ratio 0.3.
RunKey run_of(const std::string& set, int number) {
  return {.id = {set, 10, number}, .method = "paper", .ratio = 0.3};
}

ExperimentRecord experiment() {
  return {.version = "0.1.0",
          .dataset_seed = 7,
          .methods = {"paper"},
          .ratios = {0.3},
          .seed = 5,
          .cases = 3,
          .recipe_sha256 = "abc"};
}

/// Two cases of set A and one of set B.
Results small_results() {
  Results results;
  results.experiment = experiment();
  results.is_papers = true;
  results.scores = {score(run_of("A", 1), 0.9), score(run_of("A", 2), 0.8), score(run_of("B", 1), 0.7)};
  results.times = {{run_of("A", 1), 0.4}, {run_of("A", 2), 0.46}, {run_of("B", 1), 0.5}};
  results.generation = {generation({"A", 10, 1}, 2.0), generation({"A", 10, 2}, 3.0)};
  return results;
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "<tr><th scope=\"row\">" + cells.front() + "</th>";
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const bool is_published = cells[i].front() == '*';
    text += (is_published ? "<td class=\"published\">" : "<td>") + cells[i].substr(is_published ? 1 : 0) +
            "</td>";
  }
  return text + "</tr>";
}

// Every number below is by hand; * marks the paper's.
TEST(Page, Table1HasMeansBesideThePapers) {
  // Cases of 2.5 s and 3.5 s; 3.0 / 14.20 = 0.211.
  EXPECT_THAT(report_page(small_results()), HasSubstr(row({"10", "2", "3.000", "*14.20", "0.211"})));
}

TEST(Page, Table2HasMeansBesideThePapersForSetA) {
  const std::string page = report_page(small_results());
  EXPECT_THAT(page, HasSubstr(row({"0.3", "0.430", "*0.85"})));
  EXPECT_THAT(page, HasSubstr(row({"0.3", "0.500"})));
}

TEST(Page, Figure8HasTheSpreadAndWhatThePaperStates) {
  const std::string page = report_page(small_results());
  EXPECT_THAT(
      page, HasSubstr(row({"10", "2", "0", "0.850", "0.071", "0.800", "0.825", "0.850", "0.875", "0.900"})));
  EXPECT_THAT(page, HasSubstr(row({"10", "1", "0", "0.700", "–", "0.700", "0.700", "0.700", "0.700", "0.700",
                                   "*≈ 0.831"})));
  EXPECT_THAT(page, HasSubstr("Set B, published"));
}

TEST(Page, OtherMeasuresAreMeansAndSharesOfAllJoins) {
  EXPECT_THAT(report_page(small_results()), HasSubstr(row({"10", "2", "0", "0.500", "0.250", "0.125", "0.750",
                                                           "2.10", "60.0 % of 20", "75.0 % of 16"})));
}

TEST(Page, ScenesOfOneTubeHaveNoRandIndex) {
  Results results = small_results();
  for (RunScore& score : results.scores) {
    score.run.id.tubes = 1;
    score.adjusted_rand_index.reset();
  }
  EXPECT_THAT(report_page(results), HasSubstr(row({"1", "2", "0", "0.500", "0.250", "0.125", "–", "2.10",
                                                   "60.0 % of 20", "75.0 % of 16"})));
}

TEST(Page, SaysThatJoinsAreBetweenNeighboursHiddenOrNot) {
  EXPECT_THAT(report_page(small_results()),
              HasSubstr("Joins: between neighbouring pieces of a tube, hidden or not;"));
}

TEST(Page, AFailedRunCountsAsOneThatFoundNothingAndIsCounted) {
  Results results = small_results();
  results.scores[1] = {.run = run_of("A", 2), .failure = "no <points>"};
  results.unscored = {run_of("A", 3)};
  const std::string page = report_page(results);
  EXPECT_THAT(
      page, HasSubstr(row({"10", "2", "1", "0.450", "0.636", "0.000", "0.225", "0.450", "0.675", "0.900"})));
  EXPECT_THAT(page, HasSubstr(row({"10", "2", "1", "0.250", "0.125", "0.062", "0.375", "2.10", "60.0 % of 10",
                                   "75.0 % of 8"})));
  EXPECT_THAT(page, HasSubstr("1 run failed; a failed run counts as one that found nothing."));
  EXPECT_THAT(page, HasSubstr(row({"paper", "1", "A10/2", "no &lt;points&gt;"})));
  EXPECT_THAT(page, HasSubstr("1 case without a visible tube"));
  EXPECT_THAT(page, HasSubstr("2 scored, 1 failed; seed 5"));
}

TEST(Page, EachReasonOfFailuresIsShownWithItsNumberOnOneLine) {
  Results results = small_results();
  const std::string traceback = "Traceback\n\x1b[31mno tubes";
  for (int number = 4; number < 9; ++number)
    results.scores.push_back({.run = run_of("A", number), .failure = number == 6 ? "too slow" : traceback});
  const std::string page = report_page(results);
  EXPECT_THAT(page, HasSubstr(row({"paper", "4", "A10/4", "Traceback\\n\\x1b[31mno tubes"}) + "\n" +
                              row({"paper", "1", "A10/6", "too slow"})));
}

TEST(Page, TheHeadHasTheHeadlineNumbers) {
  const std::string page = report_page(small_results());
  // Of 0.9 and 0.8: Student's t with one degree of freedom, 12.706, times 0.0707 / sqrt(2).
  EXPECT_THAT(page, HasSubstr("has a mean micro-recall of 0.850 ± 0.635 (set A) and 0.700 (set B)"));
  EXPECT_THAT(page, HasSubstr("a case of set A with 10 tubes in 0.43 s on average (published: 0.85 s)"));
  EXPECT_THAT(page, HasSubstr("2 cases of set A (10 tubes) and 1 case of set B (10 tubes); seed 7"));
  EXPECT_THAT(page, HasSubstr("i7-8750H"));
}

TEST(Page, SaysOfHowManyCasesOfTheDatasetItIs) {
  Results results = small_results();
  results.experiment.recipe.emplace();
  results.experiment.recipe->sets = {{.name = "A", .tubes = {10}, .cases = 9},
                                     {.name = "B", .tubes = {10}, .cases = 1}};
  EXPECT_THAT(report_page(results),
              HasSubstr("2 of 9 cases of set A (10 tubes) and 1 case of set B (10 tubes); seed 7"));
}

std::string commands_in(const Results& results) {
  const std::string page = report_page(results, "pages/report.html");
  const std::size_t begin = page.find("<code>", page.find("<pre"));
  return page.substr(begin + 6, page.find("</code>", begin) - begin - 6);
}

TEST(Page, TellsTheCommandsThatMadeItWithTheirDirectoriesAndMethods) {
  Results results = small_results();
  results.directory = "my results";
  results.experiment.dataset = "sets/dataset";
  results.experiment.methods = {"paper", "mine", "strict"};
  results.experiment.options_of_methods = {{"mine", {"--method", "python3 it's.py {cloud} {out}"}},
                                           {"strict", {"--method", "axis:strict.toml"}}};
  results.experiment.time_limit = 60;
  results.experiment.memory_limit = 1U << 29U;
  results.experiment.parameters = {{"axis.fit.tolerance", 0.1}};
  EXPECT_EQ(commands_in(results),
            "tanglebin generate sets/dataset/recipe.toml --out sets/dataset\n"
            "tanglebin experiment sets/dataset --out &#39;my results&#39; \\\n"
            "  --method paper \\\n"
            "  --method mine=&#39;python3 it&#39;\\&#39;&#39;s.py {cloud} {out}&#39; \\\n"
            "  --method strict=axis:strict.toml \\\n"
            "  --downsample 0.3 --seed 5 --time-limit 60 --memory-limit 0.5 \\\n"
            "  --parameter axis.fit.tolerance=0.1\n"
            "tanglebin report &#39;my results&#39; --out pages/report.html\n");
}

TEST(Page, TellsHowTheCasesWereChosen) {
  std::istringstream recipe(
      "[[set]]\nname = \"A\"\ntubes = [1, 2, 10]\ncases = 9\n"
      "tube = { radius = 0.0125, mass = 0.5, length = 0.5, bend_max_deg = 30 }\n"
      "[[set]]\nname = \"B\"\ntubes = [10]\ncases = 9\n"
      "tube = { radius = 0.0125, mass = 0.5, length = 0.5, bend_max_deg = 45 }\n");
  Results results = small_results();
  results.experiment.recipe = read_recipe(recipe, "recipe");
  results.generation.clear();
  for (const char* set : {"A", "B"}) {
    for (const int number : {1, 2, 3, 7}) results.generation.push_back(generation({set, 10, number}, 1));
  }
  results.scores = {score(run_of("A", 1), 0.9), score(run_of("A", 2), 0.8)};
  EXPECT_THAT(commands_in(results), HasSubstr("--out dataset --tubes 10 --cases 1-3,7\n"));
  EXPECT_THAT(commands_in(results), HasSubstr("\n  --set A --cases 1-2 --downsample"));

  results.scores.push_back(score(run_of("B", 3), 0.8));
  results.generation.pop_back();
  const std::string page = report_page(results);
  EXPECT_THAT(page, HasSubstr("The dataset has 7 of the recipe's 36 cases"));
  EXPECT_THAT(page, HasSubstr("These results cover 3 of the dataset's 7 cases"));
}

TEST(Page, TheLeaderboardHasTheBestFirstAndEachSceneOnce) {
  Results results = small_results();
  results.is_papers = false;
  results.experiment.methods = {"paper", "axis", "none"};
  const auto seen = [](RunKey run, const char* method, const char* scanner) {
    run.method = method;
    run.scanner = scanner;
    return run;
  };
  results.scores.clear();
  for (const auto& [scanner, lost] : {std::pair("left", 0.0), std::pair("right", 0.2)}) {
    for (const auto& [set, number, recall] :
         {std::tuple("A", 1, 0.9), std::tuple("A", 2, 0.7), std::tuple("B", 1, 0.8)}) {
      results.scores.push_back(score(seen(run_of(set, number), "paper", scanner), recall - lost));
      results.scores.push_back(score(seen(run_of(set, number), "axis", scanner), recall - lost + 0.05));
      results.scores.push_back({.run = seen(run_of(set, number), "none", scanner), .failure = "no tubes"});
    }
  }
  results.times = {{seen(run_of("A", 1), "axis", "left"), 0.5}, {seen(run_of("A", 1), "axis", "right"), 1}};
  const std::string page = report_page(results);
  // Means of scenes 0.85, 0.65 and 0.75: their standard deviation is 0.1; Student's t is 4.303.
  const std::string best = row({"axis", "0.750 ± 0.248", "3", "6", "0", "0.750"});
  const std::string next = row({"paper", "0.700 ± 0.248", "3", "6", "0", "–"});
  EXPECT_THAT(page, HasSubstr(best));
  EXPECT_LT(page.find(best), page.find(next));
  EXPECT_LT(page.find(next), page.find(row({"none", "0.000 ± 0.000", "3", "6", "6", "–"})));
  EXPECT_THAT(page, HasSubstr(row({"paper", "0.700 ± 1.271", "0.700"}))) << "by set";
  EXPECT_THAT(page, HasSubstr(row({"paper", "0.800 ± 0.248", "0.600 ± 0.248"}))) << "by scanner";
  EXPECT_THAT(page, Not(HasSubstr("By number of tubes"))) << "there is only one number";
  EXPECT_THAT(page, HasSubstr("method “axis” has the highest mean micro-recall of 3 methods, 0.750."));
}

TEST(Page, RunsHaveTheirScannersAndTheNumbersDrawnForTheirCases) {
  std::istringstream recipe(
      "[[scanner]]\nname = \"left\"\nsigma = { min = 0, max = 1e-3 }\n"
      "[[scanner]]\nname = \"right\"\nsigma = { min = 0, max = 1e-3 }\n"
      "[[set]]\nname = \"A\"\ntubes = [10]\n"
      "tube = { radius = 0.0125, mass = 0.5, length = { min = 0.4, max = 0.5 }, bend_max_deg = 30 }\n");
  Results results = small_results();
  results.experiment.recipe = read_recipe(recipe, "recipe");
  for (RunScore& run : results.scores) {
    run.run.scanner = "right";
    run.drawn = {{"scanner[0].sigma", 0.25}, {"scanner[1].sigma", 0.5}, {"set[0].tube.length", 0.75}};
  }
  const std::string page = report_page(results);
  EXPECT_THAT(page, HasSubstr(R"("scanner":["right","right","right"])"));
  EXPECT_THAT(page, HasSubstr(R"("drawn":{"scanner.sigma":[0.5,0.5,0.5],"tube.length":[0.75,0.75,0.75]})"));
}

TEST(Page, SaysThatOnlySomeCasesOfTheDatasetWereModelled) {
  Results results = small_results();
  EXPECT_THAT(report_page(results), Not(HasSubstr("These results cover")));
  results.experiment.cases = 1;
  EXPECT_THAT(report_page(results), HasSubstr("These results cover 1 of the dataset's 2 cases"));
}

TEST(Page, SaysWhereItShowsAnotherRatioOrNumberOfTubesThanThePaper) {
  Results results = small_results();
  EXPECT_THAT(report_page(results), Not(HasSubstr("was not run")));
  for (RunScore& run : results.scores) {
    run.run.ratio = 0.25;
    run.run.id.tubes = 7;
  }
  const std::string page = report_page(results);
  EXPECT_THAT(
      page, HasSubstr("The ratio of the paper's Figure 8, 0.3, was not run; this shows the nearest, 0.25."));
  EXPECT_THAT(page, HasSubstr("Figure 9, 10, was not run; this shows the nearest, 7."));
}

TEST(Page, OfAnotherRecipeSaysNothingOfThePaper) {
  Results results = small_results();
  results.is_papers = false;
  for (RunScore& run : results.scores) run.run.ratio = 0.25;
  const std::string page = report_page(results);
  const std::string text = page.substr(page.find("<body>"), page.find("<script>") - page.find("<body>"));
  for (const char* word :
       {"paper's", "Publish", "publish", "Table 1", "Table 2", "Figure", "i7-8750H", "doi"}) {
    EXPECT_THAT(text, Not(HasSubstr(word)));
  }
  EXPECT_THAT(text, HasSubstr(row({"10", "2", "3.000"})));
}

TEST(Page, CasesWithoutTubesFoundHaveNoPartInTheCentreLineError) {
  Results results = small_results();
  results.scores[0].centre_line_error.reset();
  EXPECT_THAT(report_page(results), HasSubstr("<td>2.10</td>"));
  results.scores[1].centre_line_error.reset();
  EXPECT_THAT(report_page(results), HasSubstr("<td>0.750</td><td>–</td>"));
}

TEST(Page, SaysWhatIsMissing) {
  Results nothing;
  nothing.experiment = experiment();
  nothing.unfinished = true;
  const std::string page = report_page(nothing);
  for (const char* file :
       {"generation.jsonl", "times.jsonl", "results.jsonl", "scenes.jsonl", "pictures.jsonl"}) {
    EXPECT_THAT(page, HasSubstr(std::string("<code>") + file + "</code>"));
  }
  EXPECT_THAT(page, HasSubstr("This experiment is not finished"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
  EXPECT_THAT(page, Not(HasSubstr("<table")));
}

TEST(Page, APictureThatIsMissingIsNamed) {
  Results results = small_results();
  results.pictures = {{.run = results.scores[0].run,
                       .rank = "worst",
                       .micro_recall = 0.8,
                       .truth_file = "pictures/<gone>.png",
                       .truth_png = {},
                       .labels_file = "pictures/there.png",
                       .labels_png = test::picture_png(40, 30)}};
  const std::string page = report_page(results);
  EXPECT_THAT(page, HasSubstr("<code>pictures/&lt;gone&gt;.png</code> is missing."));
  EXPECT_THAT(
      page,
      HasSubstr(
          "width=\"40\" height=\"30\" alt=\"The labels of method paper for set A, 10 tubes, case 1.\""));
  EXPECT_THAT(
      page, HasSubstr("<b>Worst:</b> set A, 10 tubes, case 1, method paper, ratio 0.3: micro-recall 0.800."));
}

TEST(Page, NamesFromFilesAreText) {
  Results results = small_results();
  const std::string name = "<script>alert('1')</script>";
  results.experiment.version = name;
  results.experiment.recipe_sha256 = name;
  results.experiment.methods = {name, "other"};
  for (RunScore& run : results.scores) run.run.method = name;
  for (RunTime& run : results.times) run.run.method = name;
  for (RunScore& run : results.scores) run.run.id.set = name;
  for (RunTime& run : results.times) run.run.id.set = name;
  for (TimesRecord& record : results.generation) record.id.set = name;
  results.pictures = {{.run = results.scores[0].run,
                       .rank = "best",
                       .truth_file = name,
                       .truth_png = test::picture_png(4, 3),
                       .labels_file = name,
                       .labels_png = {}}};
  const std::string page = report_page(results);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
}

TEST(Page, NeedsNoOtherFile) {
  const std::string page = report_page(small_results());
  for (const char* part : {"<script src", "<link", "src=\"http", "url(http", "@import", " onload="}) {
    EXPECT_THAT(page, Not(HasSubstr(part)));
  }
}

TEST(Page, HasTheLicencesOfTheLibrariesInIt) {
  EXPECT_THAT(report_page(small_results()),
              AllOf(HasSubstr("Chart.js Contributors"), HasSubstr("three.js authors"),
                    HasSubstr("Permission is hereby granted")));
}

TEST(Page, TheSameResultsGiveTheSameBytes) {
  EXPECT_EQ(report_page(small_results()), report_page(small_results()));
}

}  // namespace
}  // namespace tanglebin
