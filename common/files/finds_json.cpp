#include "common/files/finds_json.hpp"

#include <fmt/format.h>

namespace lifeline::files {
namespace {

const char* name(wire::DetectionKind kind) {
  switch (kind) {
    case wire::DetectionKind::victim:
      return "victim";
    case wire::DetectionKind::human:
      return "human";
    case wire::DetectionKind::uwb_tag:
      break;
  }
  return "uwb_tag";
}

const char* name(wire::DetectionState state) {
  switch (state) {
    case wire::DetectionState::reported:
      return "reported";
    case wire::DetectionState::confirmed:
      return "confirmed";
    case wire::DetectionState::dismissed:
      return "dismissed";
    case wire::DetectionState::rescued:
      break;
  }
  return "rescued";
}

std::string frame(const sharing::FleetDetection& find) {
  if (!find.group) return to_string(find.layer);
  return *find.group == 0 ? "common" : fmt::format("common-{}", *find.group);
}

nlohmann::ordered_json to_json(const sharing::Sighted& sighted) {
  return {{"by", sighted.agent_id}, {"at_s", static_cast<double>(sighted.at_ns) / 1e9}};
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<sharing::FleetDetection>& finds) {
  auto all = nlohmann::ordered_json::array();
  for (const auto& find : finds) {
    nlohmann::ordered_json json;
    json["kind"] = name(find.kind);
    json["state"] = name(find.state);
    json["frame"] = frame(find);
    json["floor"] = find.layer.floor.value;
    json["x_m"] = find.x_m;
    json["y_m"] = find.y_m;
    json["confidence"] = find.confidence;
    json["first_seen"] = to_json(find.first);
    json["last_seen"] = to_json(find.last);
    json["seen_by"] = find.seen_by;
    all.push_back(std::move(json));
  }
  return all;
}

}  // namespace lifeline::files
