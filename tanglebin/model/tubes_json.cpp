#include "tanglebin/model/tubes_json.hpp"

#include <nlohmann/json.hpp>

namespace tanglebin {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format = 1;

Json json_of(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json json_of(const PointCounts& counts) {
  return {{"all", counts.all},
          {"invalid", counts.invalid},
          {"behind_camera", counts.behind_camera},
          {"outside_image", counts.outside_image},
          {"below_support", counts.below_support},
          {"cropped", counts.cropped},
          {"on_support", counts.on_support},
          {"on_tubes", counts.on_tubes},
          {"near_support", counts.near_support},
          {"unexplained", counts.unexplained}};
}

Json json_of(const Finding& finding) {
  return {{"severity", finding.severity == Finding::Severity::error ? "error" : "warning"},
          {"code", finding.code},
          {"message", finding.message}};
}

Json json_of(const TubeJoin& join) {
  return {{"from", json_of(join.from)},
          {"to", json_of(join.to)},
          {"log_odds", join.log_odds},
          {"margin", join.margin}};
}

Json json_of(const Tube& tube, const TubeEvidence& evidence) {
  Json json{{"id", tube.id}, {"radius", tube.radius}, {"ends", tube.flat_ends ? "flat" : "round"}};
  json["nodes"] = Json::array();
  for (const Node& node : tube.nodes) json["nodes"].push_back(json_of(node.position));
  json["edges"] = Json::array();
  for (const Edge& edge : tube.edges) json["edges"].push_back({edge.from, edge.to});
  json["confidence"] = evidence.confidence;
  json["points"] = evidence.points;
  json["residual"] = evidence.residual;
  json["length"] = evidence.length;
  json["length_fit"] = name_of(evidence.length_fit);
  json["visible_length"] = evidence.visible_length;
  json["radius_error"] = evidence.radius_error;
  json["disagreement"] = evidence.disagreement;
  json["joins"] = Json::array();
  for (const TubeJoin& join : evidence.joins) json["joins"].push_back(json_of(join));
  return json;
}

}  // namespace

std::string tubes_json(const Model& model) {
  Json json{{"format", format}, {"frame", "world"}, {"unit", "m"}, {"usable", !model.is_refused()}};
  json["points"] = json_of(model.counts);
  json["findings"] = Json::array();
  for (const Finding& finding : model.findings) json["findings"].push_back(json_of(finding));
  json["estimated_lengths"] = Json::array();
  for (const auto& [kind, length] : model.estimated_lengths)
    json["estimated_lengths"].push_back({{"kind", kind}, {"length", length}});
  json["tubes"] = Json::array();
  for (std::size_t i = 0; i < model.tubes.size(); ++i) {
    json["tubes"].push_back(json_of(model.tubes[i], model.evidence[i]));
  }
  return json.dump();
}

}  // namespace tanglebin
