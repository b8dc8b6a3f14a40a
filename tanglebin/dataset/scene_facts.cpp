#include "tanglebin/dataset/scene_facts.hpp"

#include "tanglebin/geometry/bin_parts.hpp"

namespace tanglebin {
namespace {

Json nanometres(const Eigen::Vector3d& point) {
  return {to_billionth(point.x()), to_billionth(point.y()), to_billionth(point.z())};
}

}  // namespace

Json facts_json(const Occlusions& occlusions, const std::vector<Contact>& contacts) {
  Json json{{"tubes", Json::array()}, {"crossings", Json::array()}, {"contacts", Json::array()}};
  for (const TubeVisibility& tube : occlusions.tubes) {
    json["tubes"].push_back({{"id", tube.tube},
                             {"whole_pixels", tube.whole},
                             {"visible_pixels", tube.visible},
                             {"visible_share", tube.share()}});
  }
  for (const Crossing& crossing : occlusions.crossings) {
    json["crossings"].push_back(
        {{"over", crossing.over},
         {"under", crossing.under},
         {"pixels", crossing.pixels},
         {"visible_pixels", crossing.visible},
         {"pixel", Json::array({to_billionth(crossing.pixel.x()), to_billionth(crossing.pixel.y())})},
         {"point", nanometres(crossing.point)}});
  }
  for (const Contact& contact : contacts) {
    Json entry{{"tube", contact.tube}, {"other", contact.other}};
    if (contact.bin_part) entry["part"] = bin_part_names.at(*contact.bin_part);
    entry["point"] = nanometres(contact.point);
    entry["gap"] = to_billionth(contact.gap);
    json["contacts"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace tanglebin
