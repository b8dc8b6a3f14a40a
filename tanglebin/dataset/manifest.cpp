#include "tanglebin/dataset/manifest.hpp"

#include <fmt/core.h>

#include <charconv>
#include <string>

#include "tanglebin/dataset/json_line.hpp"

namespace tanglebin {
namespace {

// Hexadecimal text, since many readers of JSON take a number for a double, which cannot hold all of a seed.
std::string seed_text(std::uint64_t seed) {
  return fmt::format("{:016x}", seed);
}

std::uint64_t seed_from(const Json& json) {
  const auto text = json.get<std::string>();
  std::uint64_t seed = 0;
  constexpr int hexadecimal = 16;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed, hexadecimal);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw Json::other_error::create(501, "seed is not a hexadecimal number", nullptr);
  }
  return seed;
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
                      value.at("points").get<std::size_t>(),
                      {},
                      {}};
    for (const Json& rejection : value.at("rejected")) {
      record.rejections.push_back({seed_from(rejection.at("seed")), rejection.at("simulated").get<double>(),
                                   rejection.at("fault").get<std::string>()});
    }
    for (const Json& entry : value.at("files")) {
      record.files.push_back({entry.at("path").get<std::string>(), entry.at("bytes").get<std::size_t>(),
                              entry.at("sha256").get<std::string>()});
    }
    for (const Json& scanner : value.value("scanners", Json::array())) {
      record.scanners.push_back(
          {scanner.at("name").get<std::string>(), scanner.at("points").get<std::size_t>()});
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
