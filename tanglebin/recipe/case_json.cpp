#include "tanglebin/recipe/case_json.hpp"

namespace tanglebin {

Json id_json(const CaseId& id) {
  return {{"set", id.set}, {"tubes", id.tubes}, {"case", id.number}};
}

// The text ends behind the third member: a set's name has neither comma nor quote.
CaseId id_of_line(std::string_view line, const std::string& file, std::size_t number) {
  std::size_t end = std::string_view::npos;
  std::size_t from = 0;
  for (int members = 0; members < 3; ++members) {
    end = line.find_first_of(",}", from);
    from = end == std::string_view::npos ? end : end + 1;
  }
  return id_of({std::string(line.substr(0, end)) + '}', file, number});
}

CaseId id_of(const JsonRecord& record) {
  return {record.text("set"), record.positive_int("tubes"), record.positive_int("case")};
}

}  // namespace tanglebin
