// Any input in place of a file that lists a dataset's cases is either cases or an InputError, and whatever
// was read is written so that it reads back the same. The first byte selects the file.

#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/is_refused.hpp"
#include "tanglebin/dataset/catalogue.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace {

namespace fs = std::filesystem;

constexpr const char* record =
    R"({"set":"A","tubes":1,"case":1,"seed":"0000000000000011","simulated":1.5,"largest_overlap":0.0001,)"
    R"("points":7,"rejected":[],"files":[{"path":"A1/plys/1.ply","bytes":3,"sha256":"ab"}]})";

fs::path fresh_directory() {
  // In memory if possible, because a harness writes thousands of files per second.
  const fs::path shared = "/dev/shm";
  const fs::path parent = fs::is_directory(shared) ? shared : fs::temp_directory_path();
  const fs::path directory = parent / ("tanglebin-fuzz-manifest-" + std::to_string(getpid()));
  fs::remove_all(directory);
  fs::create_directories(directory);
  return directory;
}

void check_that_it_reads_back(const tanglebin::Catalogue& catalogue, const fs::path& directory) {
  const std::vector<tanglebin::CaseId> ids = catalogue.cases();
  std::vector<std::string> records;
  records.reserve(ids.size());
  for (const tanglebin::CaseId& id : ids) records.push_back(to_json(catalogue.record(id)));
  const tanglebin::DatasetSummary written = catalogue.write(ids, {{{"tanglebin", "0"}}}, directory);
  fs::remove(directory / "journal.jsonl");
  const tanglebin::Catalogue back(directory);
  if (back.cases() != ids || written.cases != ids.size()) std::abort();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (to_json(back.record(ids[i])) != records[i]) std::abort();
  }
  if (tanglebin::read_dataset_summary(directory)->digest != written.digest) std::abort();
}

tanglebin::Recipe recipe_with_a_number_to_draw() {
  std::istringstream text(
      "[scanner]\nsigma = { min = 0, max = 0.001 }\n[[set]]\nname = \"A\"\ntubes = [1]\ncases = 3\n"
      "[set.tube]\nradius = 0.0125\nmass = 0.5\nlength = 0.5\nbend_max_deg = 30\n");
  return tanglebin::read_recipe(text, "recipe.toml");
}

void read_times_and_drawn_numbers(const tanglebin::Catalogue& catalogue) {
  static const tanglebin::Recipe recipe = recipe_with_a_number_to_draw();
  for (const tanglebin::CaseId& id : catalogue.cases()) {
    catalogue.times(id);
    resolve(recipe, id, catalogue.record(id).drawn);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 5> files{"manifest.jsonl", "times.jsonl", "failed.jsonl", "journal.jsonl",
                                             "dataset.json"};
  if (size == 0) return 0;
  const fs::path directory = fresh_directory();
  std::ofstream(directory / "manifest.jsonl") << record << '\n';
  std::ofstream(directory / files[data[0] % files.size()], std::ios::binary)
      << std::string(data + 1, data + size);
  // Each reads exactly these bytes, whatever the other files contain.
  is_refused([&] { tanglebin::read_dataset_summary(directory); });
  is_refused([&] { read_times_and_drawn_numbers(tanglebin::Catalogue(directory)); });
  is_refused([&] { check_that_it_reads_back(tanglebin::Catalogue(directory), directory); });
  // Readers that skip damage can still write a dataset.
  using Damage = tanglebin::Catalogue::Damage;
  check_that_it_reads_back(tanglebin::Catalogue(directory, Damage::is_passed_over), directory);
  fs::remove_all(directory);
  return 0;
}
