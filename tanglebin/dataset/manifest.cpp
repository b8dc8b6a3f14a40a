#include "tanglebin/dataset/manifest.hpp"

#include <algorithm>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/recipe/case_json.hpp"

namespace tanglebin {
namespace {

// A manifest from elsewhere must not make the program read or write outside of the dataset's directory.
std::string path_from(const JsonRecord& entry) {
  std::string text = entry.text("path");
  const std::filesystem::path path(text);
  const auto is_control = [](unsigned char character) { return character < 0x20 || character == 0x7f; };
  const bool is_below = path.is_relative() && path.has_filename() &&
                        text == path.lexically_normal().string() && *path.begin() != ".." &&
                        *path.begin() != ".";
  if (!is_below || std::ranges::any_of(text, is_control)) {
    entry.fail("path", excerpt(text), "a path below the dataset's directory");
  }
  return text;
}

// If members are in another order or there twice, the line's beginning does not name its case.
void expect_id_first(const CaseId& id, const std::string& json, const std::string& file, std::size_t line) {
  if (id_of_line(json, file, line) != id) {
    throw InputError({file, line, ""}, excerpt(json), "a line that begins with its set, tubes and case");
  }
}

void add_drawn(const std::vector<DrawnNumber>& drawn, Json& json) {
  for (const auto& [path, value, tube] : drawn) {
    if (tube == 0) {
      json["drawn"][path] = value;
      continue;
    }
    Json& tubes = json["drawn_tubes"];
    while (tubes.size() < static_cast<std::size_t>(tube)) tubes.push_back(Json::object());
    tubes.back()[path] = value;
  }
}

std::vector<DrawnNumber> drawn_numbers(const JsonRecord& record) {
  std::vector<DrawnNumber> drawn;
  const auto add = [&](const JsonRecord& numbers, int tube) {
    for (const std::string& path : numbers.fields()) drawn.push_back({path, numbers.number(path), tube});
  };
  if (record.has("drawn")) add(record.object("drawn"), 0);
  if (!record.has("drawn_tubes")) return drawn;
  int tube = 0;
  for (const JsonRecord& numbers : record.objects("drawn_tubes")) add(numbers, ++tube);
  return drawn;
}

}  // namespace

std::string to_json(const CaseRecord& record) {
  Json json = id_json(record.id);
  json["seed"] = seed_text(record.seed);
  json["simulated"] = record.simulated;
  json["largest_overlap"] = record.largest_overlap;
  json["points"] = record.points;
  for (const ScannerRecord& scanner : record.scanners) {
    json["scanners"].push_back({{"name", scanner.name}, {"points", scanner.points}});
  }
  add_drawn(record.drawn, json);
  json["rejected"] = Json::array();
  for (const Rejection& rejection : record.rejections) {
    json["rejected"].push_back({{"seed", seed_text(rejection.seed)},
                                {"simulated", rejection.simulated},
                                {"fault", rejection.fault}});
  }
  json["files"] = Json::array();
  for (const FileRecord& file : record.files) {
    json["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  return json_text(json);
}

std::string to_json(const TimesRecord& record) {
  Json json = id_json(record.id);
  json["generate"] = record.times.generate;
  json["settle"] = record.times.settle;
  json["scan"] = record.times.scan;
  json["write"] = record.times.write;
  json["peak_memory"] = record.peak_memory;
  return json_text(json);
}

CaseRecord case_record(const std::string& json, const std::string& file, std::size_t line) {
  const JsonRecord value(json, file, line);
  CaseRecord record{id_of(value),
                    value.seed("seed"),
                    value.number("simulated"),
                    value.number("largest_overlap"),
                    value.whole_number("points"),
                    {},
                    {}};
  for (const JsonRecord& rejection : value.objects("rejected")) {
    record.rejections.push_back(
        {rejection.seed("seed"), rejection.number("simulated"), rejection.text("fault")});
  }
  for (const JsonRecord& entry : value.objects("files")) {
    record.files.push_back({path_from(entry), entry.whole_number("bytes"), entry.text("sha256")});
  }
  if (value.has("scanners")) {
    for (const JsonRecord& scanner : value.objects("scanners")) {
      record.scanners.push_back({scanner.text("name"), scanner.whole_number("points")});
    }
  }
  record.drawn = drawn_numbers(value);
  expect_id_first(record.id, json, file, line);
  return record;
}

TimesRecord times_record(const std::string& json, const std::string& file, std::size_t line) {
  const JsonRecord value(json, file, line);
  TimesRecord record{
      id_of(value),
      {value.number("generate"), value.number("settle"), value.number("scan"), value.number("write")},
      value.number("peak_memory")};
  expect_id_first(record.id, json, file, line);
  return record;
}

}  // namespace tanglebin
