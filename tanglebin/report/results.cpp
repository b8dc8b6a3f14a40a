#include "tanglebin/report/results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/excerpt.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- Values of a JSON object
// -------------------------------------------------------------------------------

/// A JSON object of a file, whose values are read by name; what is wrong with one is an InputError.
class Record {
public:
  Record(const std::string& text, std::string file, std::size_t line) : file_(std::move(file)), line_(line) {
    json_ = Json::parse(text, nullptr, /* allow_exceptions */ false);
    if (!json_.is_object()) throw InputError({file_, line_, ""}, excerpt(text), "a JSON object");
  }

  std::string text(const std::string& field) const { return text(field, at(field)); }

  std::vector<std::string> texts(const std::string& field) const {
    std::vector<std::string> result;
    for (const Json& value : array(field)) result.push_back(text(field, value));
    return result;
  }

  double number(const std::string& field, double least, double greatest) const {
    return number(field, at(field), least, greatest);
  }

  std::optional<double> number_or_null(const std::string& field, double least, double greatest) const {
    const Json& value = at(field);
    if (value.is_null()) return std::nullopt;
    return number(field, value, least, greatest);
  }

  double share(const std::string& field) const { return number(field, 0, 1); }

  double ratio(const std::string& field) const { return ratio(field, at(field)); }

  std::vector<double> ratios(const std::string& field) const {
    std::vector<double> result;
    for (const Json& value : array(field)) result.push_back(ratio(field, value));
    return result;
  }

  std::uint64_t whole_number(const std::string& field) const {
    const Json& value = at(field);
    if (!value.is_number_unsigned()) fail(field, excerpt(value.dump()), "a whole number, 0 or more");
    return value.get<std::uint64_t>();
  }

  int positive_int(const std::string& field) const {
    constexpr auto greatest = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    const std::uint64_t value = whole_number(field);
    if (value < 1 || value > greatest) {
      fail(field, std::to_string(value), fmt::format("1 to {}", greatest));
    }
    return static_cast<int>(value);
  }

  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError({file_, line_, field}, found, expected);
  }

private:
  const Json& at(const std::string& field) const {
    const auto found = json_.find(field);
    if (found == json_.end()) throw InputError({file_, line_, field}, "is missing");
    return *found;
  }

  const Json& array(const std::string& field) const {
    const Json& value = at(field);
    if (!value.is_array()) fail(field, excerpt(value.dump()), "a list");
    return value;
  }

  std::string text(const std::string& field, const Json& value) const {
    if (!value.is_string()) fail(field, excerpt(value.dump()), "text");
    return value.get<std::string>();
  }

  double number(const std::string& field, const Json& value, double least, double greatest) const {
    if (!value.is_number()) fail(field, excerpt(value.dump()), "a number");
    const auto number = value.get<double>();
    if (!(number >= least && number <= greatest)) {
      fail(field, excerpt(value.dump()),
           greatest == infinity ? fmt::format("{} or more", least)
                                : fmt::format("a number from {} to {}", least, greatest));
    }
    return number;
  }

  double ratio(const std::string& field, const Json& value) const {
    return number(field, value, std::numeric_limits<double>::min(), 1);
  }

  std::string file_;
  std::size_t line_;
  Json json_;
};

// ---- Files
// -------------------------------------------------------------------------------------------------

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) {
    throw InputError({file.string(), 0, ""},
                     "cannot be read: " + std::generic_category().message(in ? EISDIR : errno));
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

/// `read` of each line of a file, none where the file does not exist.
template <typename Value, typename Read>
std::vector<Value> read_lines(const fs::path& file, const Read& read) {
  std::vector<Value> values;
  if (!fs::exists(file)) return values;
  std::istringstream in(bytes_of(file));
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line)
    values.push_back(read(text, file.string(), line));
  return values;
}

template <typename Value>
std::vector<Value> read_records(const fs::path& file, Value (*read)(const Record&)) {
  return read_lines<Value>(file, [&](const std::string& text, const std::string& name, std::size_t line) {
    return read(Record(text, name, line));
  });
}

ExperimentRecord read_experiment(const fs::path& file) {
  if (!fs::exists(file)) {
    throw InputError({file.string(), 0, ""},
                     "is missing: a results directory, which `tanglebin experiment` writes, has it");
  }
  const Record record(bytes_of(file), file.string(), 0);
  return {.version = record.text("version"),
          .dataset_seed = record.whole_number("dataset_seed"),
          .methods = record.texts("methods"),
          .ratios = record.ratios("ratios"),
          .seed = record.whole_number("seed"),
          .cases = record.whole_number("cases"),
          .recipe_sha256 = record.text("recipe_sha256")};
}

// ---- Records
// -------------------------------------------------------------------------------------------------

RunKey run_of(const Record& record) {
  return {.id = {record.text("set"), record.positive_int("tubes"), record.positive_int("case")},
          .method = record.text("method"),
          .ratio = record.ratio("ratio")};
}

RunScore score_of(const Record& record) {
  return {.run = run_of(record),
          .micro_recall = record.share("micro_recall"),
          .mean_iou = record.share("mean_iou"),
          .f1 = record.share("f1"),
          .panoptic_quality = record.share("panoptic_quality"),
          .adjusted_rand_index = record.number("adjusted_rand_index", -1, 1),
          .centre_line_error = record.number_or_null("centre_line_error", 0, infinity),
          .true_joins = record.whole_number("true_joins"),
          .joins_found = record.whole_number("joins_found"),
          .joins_made = record.whole_number("joins_made")};
}

RunTime time_of(const Record& record) {
  return {.run = run_of(record), .seconds = record.number("seconds", 0, infinity)};
}

/// A file of the results directory; no other is read.
std::string path_inside(const Record& record, const std::string& field) {
  std::string text = record.text(field);
  const fs::path path(text);
  if (path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end())
    record.fail(field, excerpt(text), "a path below the results directory");
  return text;
}

CasePictures pictures_of(const Record& record) {
  CasePictures pictures{.run = run_of(record),
                        .rank = record.text("rank"),
                        .micro_recall = record.share("micro_recall"),
                        .truth_file = path_inside(record, "truth"),
                        .truth_png = {},
                        .labels_file = path_inside(record, "labels"),
                        .labels_png = {}};
  const std::vector<std::string> ranks = {"best", "median", "worst"};
  if (std::ranges::find(ranks, pictures.rank) == ranks.end()) {
    record.fail("rank", excerpt(pictures.rank), "best, median or worst");
  }
  return pictures;
}

/// The bytes of a picture; none where it is missing.
std::string read_png(const fs::path& directory, const std::string& name) {
  constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
  const fs::path file = directory / name;
  if (!fs::exists(file)) return {};
  std::string bytes = bytes_of(file);
  if (!bytes.starts_with(signature))
    throw InputError({file.string(), 0, ""}, excerpt(bytes), "a PNG picture");
  return bytes;
}

}  // namespace

Results read_results_directory(const fs::path& directory) {
  Results results{.experiment = read_experiment(directory / "experiment.json"),
                  .scores = read_records(directory / "results.jsonl", score_of),
                  .times = read_records(directory / "times.jsonl", time_of),
                  .generation = read_lines<TimesRecord>(directory / "generation.jsonl", times_record),
                  .pictures = read_records(directory / "pictures.jsonl", pictures_of),
                  .unfinished = fs::exists(directory / "journal.jsonl")};
  for (CasePictures& pictures : results.pictures) {
    pictures.truth_png = read_png(directory, pictures.truth_file);
    pictures.labels_png = read_png(directory, pictures.labels_file);
  }
  return results;
}

}  // namespace tanglebin
