#include "tanglebin/dataset/manifest.hpp"

#include <algorithm>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/io/json_record.hpp"
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
  for (const DrawnNumber& drawn : record.drawn) json["drawn"][drawn.path] = drawn.value;
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
  return json.dump();
}

std::string to_json(const TimesRecord& record) {
  Json json = id_json(record.id);
  json["generate"] = record.times.generate;
  json["settle"] = record.times.settle;
  json["scan"] = record.times.scan;
  json["write"] = record.times.write;
  json["peak_memory"] = record.peak_memory;
  return json.dump();
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
  if (value.has("drawn")) {
    const JsonRecord drawn = value.object("drawn");
    for (const std::string& path : drawn.fields()) record.drawn.push_back({path, drawn.number(path)});
  }
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
