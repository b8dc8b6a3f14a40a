#include "tanglebin/dataset/dataset_summary.hpp"

#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/read_file.hpp"

namespace tanglebin {
namespace {

Json json_of(const std::set<Versions>& made_with) {
  Json json = Json::array();
  for (const Versions& versions : made_with) {
    Json names = Json::object();
    for (const auto& [name, version] : versions) names[name] = version;
    json.push_back(names);
  }
  return json;
}

std::set<Versions> made_with_in(const JsonRecord& json) {
  std::set<Versions> made_with;
  for (const JsonRecord& versions : json.objects("made_with")) {
    Versions names;
    for (const std::string& name : versions.fields()) names[name] = versions.text(name);
    made_with.insert(std::move(names));
  }
  return made_with;
}

}  // namespace

void Digest::add(const CaseRecord& record) {
  for (const FileRecord& file : record.files) hash_.add(file.sha256 + "  " + file.path + '\n');
  files_ += record.files.size();
}

std::string to_json(const DatasetSummary& summary) {
  Json json{{"cases", summary.cases},
            {"recipe_cases", summary.recipe_cases},
            {"failed", summary.failed},
            {"files", summary.files},
            {"digest", summary.digest}};
  json["made_with"] = json_of(summary.made_with);
  return json.dump(2) + '\n';
}

std::string to_json(const std::set<Versions>& made_with) {
  return json_text(Json{{"made_with", json_of(made_with)}});
}

std::set<Versions> made_with(const std::string& json, const std::string& file, std::size_t line) {
  return made_with_in(JsonRecord(json, file, line));
}

std::optional<DatasetSummary> read_dataset_summary(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / summary_name;
  const std::optional<std::string> text = read_if_there(file);
  if (!text) return std::nullopt;
  const JsonRecord json(*text, file.string(), 0);
  return DatasetSummary{json.whole_number("cases"),  json.whole_number("recipe_cases"),
                        json.whole_number("failed"), json.whole_number("files"),
                        json.text("digest"),         made_with_in(json)};
}

}  // namespace tanglebin
