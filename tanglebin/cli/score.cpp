#include "tanglebin/score/score.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/score_dataset.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/experiment/measures.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/io/read_tubes.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tanglebin/score/score_clouds.hpp"
#include "tanglebin/score/score_tubes.hpp"

namespace tanglebin::cli {
namespace {

struct ScoreArguments {
  std::optional<std::string> dataset;
  std::optional<std::string> labels;
  std::string truth;
  std::string labelled;
  std::optional<std::string> true_tubes;
  std::optional<std::string> tubes;
  bool json = false;
  bool confusion = false;
};

void expect_printable_confusion(const Score& score) {
  constexpr std::size_t most_cells = 10'000'000;
  const std::size_t tubes = score.tubes.size();
  const std::size_t columns = score.confusion.segments.size() + 1;
  if (tubes * columns > most_cells) {
    throw InputError({"", 0, "--confusion"},
                     fmt::format("a matrix of {} by {}", counted(tubes, "tube"), counted(columns, "label")),
                     fmt::format("at most {} cells", most_cells));
  }
}

// A row for each tube; a column for each predicted label, then one for null.
std::vector<std::vector<std::int64_t>> confusion_matrix(const Score& score) {
  const std::size_t segments = score.confusion.segments.size();
  std::vector<std::vector<std::int64_t>> rows;
  for (const TubeScore& tube : score.tubes) {
    rows.emplace_back(segments + 1).back() = tube.null_points;
  }
  for (const auto& [tube, segment, points] : score.confusion.overlaps) rows[tube][segment] = points;
  return rows;
}

nlohmann::ordered_json confusion_json(const Score& score) {
  nlohmann::ordered_json json;
  for (const Region& tube : score.confusion.tubes) json["tubes"].push_back(tube.label);
  for (const Region& segment : score.confusion.segments) json["labels"].push_back(segment.label);
  json["labels"].push_back(null_label);
  json["points"] = confusion_matrix(score);
  return json;
}

nlohmann::ordered_json score_json(const Score& score) {
  nlohmann::ordered_json json = measures_json(score);
  for (const TubeScore& tube : score.tubes) json["tubes"].push_back(tube_json(tube));
  return json;
}

void print_tubes(const Score& score) {
  print_out("\n{:>8} {:>9} {:>8} {:>9} {:>9} {:>6}\n", "tube", "points", "label", "correct", "null", "IoU");
  for (const TubeScore& tube : score.tubes) {
    print_out("{:>8} {:>9} {:>8} {:>9} {:>9} {:>6.3f}\n", tube.label, tube.points,
              tube.assigned ? std::to_string(*tube.assigned) : "none", tube.correct_points, tube.null_points,
              tube.iou);
  }
}

void print_confusion(const Score& score) {
  print_out("\n{:>8}", "label");
  for (const Region& segment : score.confusion.segments) print_out(" {:>8}", segment.label);
  print_out(" {:>8}\n", "null");
  const auto rows = confusion_matrix(score);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    print_out("{:>8}", fmt::format("tube {}", score.tubes[i].label));
    for (const std::int64_t points : rows[i]) print_out(" {:>8}", points);
    print_out("\n");
  }
}

std::string millimetres(const std::optional<double>& metres) {
  return metres ? fmt::format("{:.2f} mm", *metres * 1000) : "none";
}

void print_tubes_score(const TubesScore& score) {
  print_out("centre-line error    {}  95th percentile {}\n", millimetres(score.centre_line_error),
            millimetres(score.centre_line_error_p95));
  print_out("centre-line coverage {:.3f}\n", score.centre_line_coverage);
  print_out("joins                {} of {} missing, {} of {} wrong\n", score.true_joins - score.joins_found,
            score.true_joins, score.joins_made - score.joins_found, score.joins_made);
  print_out("complete tubes       {}{}\n", score.complete_tubes,
            score.length_error ? fmt::format("  length error {:.2f} %", 100 * *score.length_error) : "");
  if (score.true_junctions > 0 || score.junctions_made > 0) {
    print_out("junctions            {} of {} found, {} made\n", score.junctions_found, score.true_junctions,
              score.junctions_made);
  }
}

void print_text(const Score& score, const std::optional<TubesScore>& tubes_score) {
  const auto& [precision, recall, f1, panoptic_quality] = score.detection;
  const Instances& instances = score.instances;
  print_out("micro-recall         {:.3f}  {} of {} points, {} null\n", score.micro_recall,
            score.correct_points, score.points, score.null_points);
  if (score.unmixed_recall) print_out("without mixed points {:.3f}\n", *score.unmixed_recall);
  print_out("mean IoU             {:.3f}\n", score.mean_iou);
  print_out("F1 at IoU 0.5        {:.3f}  precision {:.3f}, recall {:.3f}\n", f1, precision, recall);
  print_out("panoptic quality     {:.3f}\n", panoptic_quality);
  print_out("adjusted Rand index  {}\n",
            score.adjusted_rand_index ? fmt::format("{:.3f}", *score.adjusted_rand_index) : "–");
  print_out("{}, {}: {} correct, {} over-segmented, {} under-segmented, {} missed, {} noise\n",
            counted(score.tubes.size(), "tube"), counted(score.confusion.segments.size(), "label"),
            instances.correct, instances.over_segmented, instances.under_segmented, instances.missed,
            instances.noise);
  if (tubes_score) print_tubes_score(*tubes_score);
  print_tubes(score);
}

// Only if both are given.
std::optional<TubesScore> score_given_tubes(const ScoreArguments& arguments) {
  if (!arguments.true_tubes || !arguments.tubes) return {};
  const auto read = [](auto&&... from) { return read_tubes(from...); };
  const std::vector<Tube> truth = read_input(*arguments.true_tubes, read);
  const std::vector<Tube> modelled = read_input(*arguments.tubes, read);
  try {
    return score_tubes(truth, modelled);
  } catch (const std::invalid_argument& error) {
    throw InputError({.file = *arguments.true_tubes}, error.what());
  }
}

void score_labels(const ScoreArguments& arguments) {
  const auto read = [](auto&&... from) { return read_cloud(from...); };
  const PointCloud truth = read_input(arguments.truth, read);
  const PointCloud labelled = read_input(arguments.labelled, read);
  const Score score = score_clouds(truth, arguments.truth, labelled, arguments.labelled);
  if (arguments.confusion) expect_printable_confusion(score);
  if (repeats_truth(truth, labelled, arguments.labelled)) {
    print_error(
        "tanglebin: warning: {}: its {} are the truth's own at every point; are they the result to score?\n",
        arguments.labelled, labelled.labels.empty() ? "colours" : "labels");
  }
  const std::optional<TubesScore> tubes_score = score_given_tubes(arguments);
  if (arguments.json) {
    nlohmann::ordered_json json = score_json(score);
    if (tubes_score) json.update(measures_json(*tubes_score));
    if (arguments.confusion) json["confusion"] = confusion_json(score);
    print_json_line(json);
    return;
  }
  print_text(score, tubes_score);
  if (arguments.confusion) print_confusion(score);
}

}  // namespace

void add_score(CLI::App& app) {
  const auto arguments = std::make_shared<ScoreArguments>();
  CLI::App* command =
      app.add_subcommand("score", "Score the labels of a cloud, or of a dataset, against the ground truth");
  CLI::Option* dataset = command->add_option("dataset", arguments->dataset,
                                             "Directory of a dataset, to score labels of all its scenes");
  CLI::Option* labels = command->add_option(
      "labels", arguments->labels,
      "Directory with a file of labels for each scene: A10/plys/1.ply, A10/labels/1.npy, …");
  dataset->needs(labels);
  CLI::Option* truth = command->add_option("--truth", arguments->truth,
                                           "Cloud with the true labels (PLY or PCD); - for standard input");
  CLI::Option* labelled = command->add_option(
      "--labelled", arguments->labelled,
      "Cloud with the labels to score: all or some points of the truth, in any order; - for "
      "standard input");
  truth->needs(labelled)->excludes(dataset);
  labelled->needs(truth);
  CLI::Option* true_tubes =
      command->add_option("--true-tubes", arguments->true_tubes,
                          "True tubes (configuration or tubes.json), to score --modelled-tubes against");
  CLI::Option* tubes =
      command->add_option("--modelled-tubes", arguments->tubes,
                          "Tubes that were found (configuration or tubes.json), to score them too");
  true_tubes->needs(tubes)->needs(truth);
  tubes->needs(true_tubes);
  command->add_flag("--json", arguments->json, "Print the score as JSON");
  command
      ->add_flag("--confusion", arguments->confusion,
                 "Also print the confusion matrix: points of each tube by label")
      ->excludes(dataset);
  command->footer(
      "If a cloud has no labels, each of its colours counts as a label, and black as none (null).\n\n"
      "Example:\n  tanglebin score --truth dataset/A10/plys/1.ply --labelled labelled.ply\n"
      "  tanglebin score dataset labels\n"
      "Measures: docs/metrics.md. Scoring your own algorithm: docs/scoring.md.");
  command->callback([arguments] {
    if (arguments->dataset) {
      score_dataset(*arguments->dataset, *arguments->labels, arguments->json);
    } else if (arguments->truth.empty()) {
      throw CLI::RequiredError("--truth");
    } else {
      score_labels(*arguments);
    }
  });
}

}  // namespace tanglebin::cli
