// Any input in place of a file of a results directory is either results or an InputError. The first byte
// selects the file.

#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/experiment/compare.hpp"
#include "tanglebin/experiment/results.hpp"
#include "tanglebin/report/results.hpp"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path directory =
      fs::temp_directory_path() / ("tanglebin-fuzz-results-" + std::to_string(getpid()));
  static const std::array<std::string, 7> files = {"experiment.json",  "results.jsonl",  "times.jsonl",
                                                   "generation.jsonl", "pictures.jsonl", "journal.jsonl",
                                                   "scenes.jsonl"};
  if (size == 0) return 0;
  fs::remove_all(directory);
  fs::create_directories(directory / "out");
  write(
      directory / "experiment.json",
      R"({"version":"0","dataset_seed":1,"methods":["paper"],"ratios":[0.3],"seed":0,"recipe_sha256":"","recipe":"","cases":1})");
  write(directory / files[data[0] % files.size()], std::string(data + 1, data + size));
  is_refused([&] { tanglebin::read_results_directory(directory); });
  is_refused([&] {
    tanglebin::FinishedRuns finished({{"paper"}, {0.3}});
    finished.add(directory);
    finished.write(directory / "out", {{"A", 2, 1}}, directory / "out");
  });
  is_refused([&] { tanglebin::merge_results({directory}, directory / "out"); });
  is_refused([&] {
    for (const auto& [baseline, other] : tanglebin::pairs_to_compare({directory, directory}, {}))
      tanglebin::compare(baseline, other);
  });
  fs::remove_all(directory);
  return 0;
}
