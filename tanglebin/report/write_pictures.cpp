#include "tanglebin/report/write_pictures.hpp"

#include <fmt/core.h>

#include <numbers>
#include <optional>
#include <string>

#include "tanglebin/experiment/summary.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/pictures/picture.hpp"
#include "tanglebin/recipe/case_json.hpp"

namespace tanglebin {
namespace {

// With the world's x to the right and y up.
constexpr View from_above{
    .azimuth = -std::numbers::pi / 2, .elevation = std::numbers::pi / 2, .width = 900, .height = 640};

void draw(const PointCloud& cloud, const std::filesystem::path& file, const std::string& cloud_file) {
  const Picture picture = picture_of_cloud(cloud, from_above, cloud_file);
  write_file(file, color_png(picture.width, picture.height, picture.pixels));
}

// Gives the points that are not scored, on no tube in truth, the bin's grey.
void grey_unscored(ComparedClouds& clouds) {
  for (std::size_t i = 0; i < clouds.truth.labels.size(); ++i) {
    if (clouds.truth.labels[i] > bin_label) continue;
    clouds.truth.labels[i] = bin_label;
    clouds.labels.labels[i] = bin_label;
  }
}

// Draws an example of an entry and returns its line of pictures.jsonl.
std::string draw_example(const Example& example, const RunId& run, const std::filesystem::path& directory,
                         const CaseData& data, const Model& model) {
  ComparedClouds clouds = compared_clouds(data, model);
  grey_unscored(clouds);
  const std::string name = fmt::format("pictures/{}-{}", run.method, example.rank);
  const std::string truth = name + "-truth.png";
  const std::string labels = name + "-labels.png";
  draw(clouds.truth, directory / truth, data.cloud_file);
  draw(clouds.labels, directory / labels, data.cloud_file);

  Json line{{"method", run.method}, {"rank", example.rank}};
  line.update(id_json(run.scene));
  if (!run.scanner.empty()) line["scanner"] = run.scanner;
  line["ratio"] = run.ratio;
  line["micro_recall"] = example.micro_recall;
  line["truth"] = truth;
  line["labels"] = labels;
  return json_text(line) + '\n';
}

}  // namespace

void write_pictures(const std::filesystem::path& directory, const Dataset& dataset,
                    const ExperimentSettings& settings, ModelAgain& model_again) {
  make_directories(directory / "pictures");
  const ResultsSummary summary = summary_of(directory, settings.ratios);
  std::string lines;
  for (const Entry& entry : settings.methods) {
    for (const Example& example : summary.examples(entry.name)) {
      const auto& [scene, scanner] = example.seen;
      const CaseData data = read_seen_case(dataset, example.seen);
      const RunId run{entry.name, scene, summary.ratio(), scanner};
      if (const std::optional<Model> model = model_again(entry, example.seen, data))
        lines += draw_example(example, run, directory, data, *model);
    }
  }
  write_file(directory / "pictures.jsonl", lines);
}

}  // namespace tanglebin
