#include "tanglebin/dataset/json_line.hpp"

namespace tanglebin {

Json id_json(const CaseId& id) {
  return {{"set", id.set}, {"tubes", id.tubes}, {"case", id.number}};
}

CaseId id_from(const Json& json) {
  return {json.at("set").get<std::string>(), json.at("tubes").get<int>(), json.at("case").get<int>()};
}

}  // namespace tanglebin
