#include "tanglebin/report/write_pictures.hpp"

#include <fmt/core.h>

#include <numbers>
#include <string>

#include "tanglebin/experiment/summary.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/json_record.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/report/picture.hpp"

namespace tanglebin {
namespace {

// With the world's x to the right and y up.
constexpr View from_above{
    .azimuth = -std::numbers::pi / 2, .elevation = std::numbers::pi / 2, .width = 900, .height = 640};

void draw(const PointCloud& cloud, const std::filesystem::path& file, const std::string& cloud_file) {
  const Picture picture = picture_of_cloud(cloud, from_above, cloud_file);
  write_file(file, color_png(picture.width, picture.height, picture.pixels));
}

// Draws an example and returns its line of pictures.jsonl.
std::string draw_example(const Example& example, const std::filesystem::path& directory,
                         const Dataset& dataset, const ExperimentSettings& settings) {
  const RunId& run = example.result.run;
  const CaseData data = read_case(dataset, run.scene);
  const KnownScene known = known_scene(recipe_of(dataset, run.scene), data, run.scene, settings.scene);
  const ComparedClouds clouds = compared_clouds(data, model_case(known, data, run, settings));
  const std::string name = fmt::format("pictures/{}-{}", name_of(run.method), example.rank);
  const std::string truth = name + "-truth.png";
  const std::string labels = name + "-labels.png";
  draw(clouds.truth, directory / truth, data.cloud_file);
  draw(clouds.labels, directory / labels, data.cloud_file);

  Json line{{"method", name_of(run.method)}, {"rank", example.rank}};
  line.update(id_json(run.scene));
  line["ratio"] = run.ratio;
  line["micro_recall"] = example.result.micro_recall;
  line["truth"] = truth;
  line["labels"] = labels;
  return line.dump();
}

}  // namespace

void write_pictures(const std::filesystem::path& directory, const Dataset& dataset,
                    const ExperimentSettings& settings) {
  make_directories(directory / "pictures");
  const std::vector<RunResult> results = read_results(directory);
  std::string lines;
  for (const Method method : settings.methods) {
    for (const Example& example : examples(results, method, ratio_to_show(settings.ratios))) {
      lines += draw_example(example, directory, dataset, settings) + '\n';
    }
  }
  write_file(directory / "pictures.jsonl", lines);
}

}  // namespace tanglebin
