#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "tanglebin/io/images.hpp"
#include "tests/support/temporary_directory.hpp"

// Results as an experiment might give them, without the hours that it takes: a results directory whose
// numbers are drawn, always the same, from curves like those of the paper.
namespace tanglebin::test {

struct SyntheticResults {
  std::vector<std::string> sets = {"A", "B"};
  std::vector<int> tubes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 20};
  int cases = 20;  ///< of each number of tubes
  std::vector<std::string> methods = {"paper"};
  std::vector<std::string> scanners = {""};
  std::vector<double> ratios = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
};

/// A plain picture with a bright diagonal, as PNG.
inline std::string picture_png(int width, int height) {
  std::vector<Color> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_diagonal = std::abs(x * height - y * width) < 6 * width;
      pixels.push_back(is_diagonal ? Color{220, 90, 40} : Color{60, 70, 90});
    }
  }
  return color_png(width, height, pixels);
}

class SyntheticWriter {
public:
  explicit SyntheticWriter(SyntheticResults settings) : settings_(std::move(settings)) {}

  void write(const std::filesystem::path& directory) {
    for (const std::string& method : settings_.methods)
      for (const std::string& set : settings_.sets)
        for (const int tubes : settings_.tubes)
          for (int number = 1; number <= settings_.cases; ++number) add_case(method, set, tubes, number);
    write_bytes(directory / "experiment.json", experiment());
    write_bytes(directory / "results.jsonl", results_);
    write_bytes(directory / "times.jsonl", times_);
    write_bytes(directory / "generation.jsonl", generation_);
    write_pictures(directory);
  }

private:
  std::string experiment() const {
    return fmt::format(
        R"({{"version":"0.1.0","dataset_seed":2022,"methods":["{}"],"ratios":[{}],"seed":1,"recipe_sha256":"{}","cases":{}}})"
        "\n",
        fmt::join(settings_.methods, "\",\""), fmt::join(settings_.ratios, ","), std::string(64, 'c'),
        settings_.sets.size() * settings_.tubes.size() * static_cast<std::size_t>(settings_.cases));
  }

  static std::string id(const std::string& set, int tubes, int number) {
    return fmt::format(R"("set":"{}","tubes":{},"case":{})", set, tubes, number);
  }

  void add_case(const std::string& method, const std::string& set, int tubes, int number) {
    const double luck = normal();
    for (const std::string& scanner : settings_.scanners)
      for (const double ratio : settings_.ratios) add_run(method, set, tubes, number, scanner, ratio, luck);
    if (method != settings_.methods.front()) return;
    generation_ += fmt::format(
        R"({{{},"generate":{:.4f},"settle":{:.4f},"scan":0.21,"write":0.09,"peak_memory":92.5}})"
        "\n",
        id(set, tubes, number), 0.002 * tubes, (0.25 + 0.12 * tubes) * (1 + 0.2 * std::abs(normal())));
  }

  void add_run(const std::string& method, const std::string& set, int tubes, int number,
               const std::string& scanner, double ratio, double luck) {
    const double lost = (set == "A" ? 0.03 : 0.07) + 0.006 * tubes + 0.01 / ratio + 0.02 * luck +
                        0.01 * normal() - (method == "paper" ? 0 : 0.03);
    const double recall = std::clamp(1 - lost, 0.2, 1.0);
    const int true_joins = tubes * (tubes - 1) / 3;
    const int joins_found = static_cast<int>(true_joins * recall * 0.9);
    const std::string seen = scanner.empty() ? "" : fmt::format(R"(,"scanner":"{}")", scanner);
    const std::string run =
        fmt::format(R"({}{},"method":"{}","ratio":{})", id(set, tubes, number), seen, method, ratio);
    const std::string drawn = fmt::format(R"("drawn":{{"bin.friction":{}}})", 0.5 + 0.125 * (number % 4));
    results_ += fmt::format(
        R"({{{},{},"points":{},"micro_recall":{:.6f},"mean_iou":{:.6f},"precision":{:.6f},"recall":{:.6f},"f1":{:.6f},)"
        R"("panoptic_quality":{:.6f},"adjusted_rand_index":{:.6f},"correct":{},"over_segmented":0,)"
        R"("under_segmented":0,"missed":0,"noise":0,"tubes_found":{},"centre_line_error":{:.6f},)"
        R"("centre_line_coverage":{:.6f},"true_joins":{},"joins_found":{},"joins_made":{},"counts":{{"filter":1}}}})"
        "\n",
        run, drawn, 9000 * tubes, recall, recall * 0.95, recall, recall, recall * 0.98, recall * 0.9,
        recall * 0.93, tubes, tubes, 0.002 + 0.01 * (1 - recall), recall, true_joins, joins_found,
        joins_found + tubes / 4);
    times_ += fmt::format(R"({{{},"seconds":{:.6f},"steps":{{"filter":0.001}}}})"
                          "\n",
                          run, (0.02 + 0.12 * ratio * tubes) * (1 + 0.1 * std::abs(normal())));
  }

  void write_pictures(const std::filesystem::path& directory) const {
    std::string lines;
    std::filesystem::create_directories(directory / "pictures");
    for (const std::string& method : settings_.methods) {
      for (const std::string rank : {"best", "median", "worst"}) {
        const std::string name = fmt::format("pictures/{}-{}", method, rank);
        write_bytes(directory / (name + "-truth.png"), picture_png(120, 90));
        write_bytes(directory / (name + "-labels.png"), picture_png(120, 90));
        lines += fmt::format(R"({{"method":"{}","rank":"{}",{},"ratio":0.3,"micro_recall":0.9,)"
                             R"("truth":"{}-truth.png","labels":"{}-labels.png"}})"
                             "\n",
                             method, rank, id(settings_.sets.front(), settings_.tubes.back(), 1), name, name);
      }
    }
    write_bytes(directory / "pictures.jsonl", lines);
  }

  /// About normal: by twelve uniform numbers, which all standard libraries draw alike.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine_()) / static_cast<double>(engine_.max());
    return sum;
  }

  SyntheticResults settings_;
  std::mt19937 engine_{2022};
  std::string results_;
  std::string times_;
  std::string generation_;
};

inline void write_synthetic_results(const std::filesystem::path& directory,
                                    const SyntheticResults& settings = {}) {
  SyntheticWriter(settings).write(directory);
}

}  // namespace tanglebin::test
