#include "tanglebin/experiment/tables.hpp"

#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "tanglebin/experiment/measures.hpp"
#include "tanglebin/experiment/run_failure.hpp"

namespace tanglebin {
namespace {

void append_keys(std::vector<std::string>& names, const Json& json) {
  for (const auto& [name, value] : json.items()) names.push_back(name);
}

const std::vector<std::string>& run_columns() {
  static const std::vector<std::string> columns = {"set", "tubes", "case", "scanner", "method", "ratio"};
  return columns;
}

const std::vector<std::string>& result_columns() {
  static const std::vector<std::string> columns = [] {
    std::vector<std::string> names = run_columns();
    for (const char* name : {"case_sha256", "labels_sha256", "failure_of", "failure"})
      names.emplace_back(name);
    append_keys(names, measures_json(Score{}));
    names.emplace_back("tubes_found");
    append_keys(names, measures_json(TubesScore{}));
    return names;
  }();
  return columns;
}

const std::vector<std::string>& tube_columns() {
  static const std::vector<std::string> columns = [] {
    std::vector<std::string> names;
    append_keys(names, tube_json(TubeScore{}));
    return names;
  }();
  return columns;
}

// A text in quotes where it has to be.
std::string in_quotes(const std::string& text) {
  if (text.find_first_of("\",\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char character : text) {
    if (character == '"') result += '"';
    result += character;
  }
  return result + '"';
}

std::string cell(const Json& json, const std::string& name) {
  const auto value = json.find(name);
  if (value == json.end() || value->is_null()) return {};
  return value->is_string() ? in_quotes(value->get<std::string>()) : json_text(*value);
}

std::string cells(const Json& json, const std::vector<std::string>& columns) {
  std::string text;
  for (const std::string& column : columns)
    text += (&column == columns.data() ? "" : ",") + cell(json, column);
  return text;
}

std::string header_of(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ","));
}

}  // namespace

ResultTables::ResultTables(const std::filesystem::path& directory, const std::filesystem::path& staging)
    : runs_(directory / "results.csv", staging), tubes_(directory / "tubes.csv", staging) {
  runs_.append(header_of(result_columns()) + "\r\n");
  tubes_.append(header_of(run_columns()) + "," + header_of(tube_columns()) + "\r\n");
}

void ResultTables::add(const JsonRecord& result) {
  Json json = result.json();
  const std::optional<RunFailure> failure = failure_in(result);
  if (failure && failure->of != FailureOf::scene) json["micro_recall"] = 0.0;
  runs_.append(cells(json, result_columns()) + "\r\n");
  const std::string run = cells(json, run_columns());
  if (!result.has("each_tube")) return;
  for (const JsonRecord& tube : result.objects("each_tube"))
    tubes_.append(run + "," + cells(tube.json(), tube_columns()) + "\r\n");
}

void ResultTables::commit() {
  runs_.commit();
  tubes_.commit();
}

}  // namespace tanglebin
