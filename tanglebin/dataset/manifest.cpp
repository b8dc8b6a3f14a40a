#include "tanglebin/dataset/manifest.hpp"

#include <algorithm>
#include <string>

#include "tanglebin/dataset/json_line.hpp"

namespace tanglebin {
namespace {

// A manifest from elsewhere must not make a program read or write outside of the dataset's directory.
std::string path_from(const Json& json) {
  auto text = json.get<std::string>();
  const std::filesystem::path path(text);
  const auto is_control = [](unsigned char character) { return character < 0x20 || character == 0x7f; };
  const bool is_below = path.is_relative() && path.has_filename() &&
                        text == path.lexically_normal().string() && *path.begin() != ".." &&
                        *path.begin() != ".";
  if (!is_below || std::ranges::any_of(text, is_control)) {
    throw Json::other_error::create(501, "path is not below the dataset's directory: " + json.dump(),
                                    nullptr);
  }
  return text;
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
  return read_json_line(json, file, line, [](const Json& value) {
    CaseRecord record{id_from(value),
                      seed_from(value.at("seed")),
                      value.at("simulated").get<double>(),
                      value.at("largest_overlap").get<double>(),
                      integer_from<std::size_t>(value.at("points")),
                      {},
                      {}};
    for (const Json& rejection : value.at("rejected")) {
      record.rejections.push_back({seed_from(rejection.at("seed")), rejection.at("simulated").get<double>(),
                                   rejection.at("fault").get<std::string>()});
    }
    for (const Json& entry : value.at("files")) {
      record.files.push_back({path_from(entry.at("path")), integer_from<std::size_t>(entry.at("bytes")),
                              entry.at("sha256").get<std::string>()});
    }
    for (const Json& scanner : value.value("scanners", Json::array())) {
      record.scanners.push_back(
          {scanner.at("name").get<std::string>(), integer_from<std::size_t>(scanner.at("points"))});
    }
    const Json drawn = value.value("drawn", Json::object());
    for (const auto& [path, number] : drawn.items()) {
      record.drawn.push_back({path, number.get<double>()});
    }
    return record;
  });
}

TimesRecord times_record(const std::string& json, const std::string& file, std::size_t line) {
  return read_json_line(json, file, line, [](const Json& value) {
    return TimesRecord{id_from(value),
                       {value.at("generate").get<double>(), value.at("settle").get<double>(),
                        value.at("scan").get<double>(), value.at("write").get<double>()},
                       value.at("peak_memory").get<double>()};
  });
}

}  // namespace tanglebin
