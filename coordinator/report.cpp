#include "coordinator/report.hpp"

#include <nlohmann/json.hpp>

#include "common/base/log.hpp"
#include "common/base/sha256.hpp"
#include "common/files/atomic_file.hpp"
#include "common/files/finds_json.hpp"
#include "common/files/map_picture.hpp"
#include "common/files/occupancy_image.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/sharing/fixed_transform.hpp"

namespace lifeline {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const MergeRecord& record) {
  const auto& result = record.result;
  Json json;
  json["a"] = record.pair.a.agent_id.text();
  json["b"] = record.pair.b.agent_id.text();
  json["map_id_a"] = record.pair.a.map_id.value;
  json["map_id_b"] = record.pair.b.map_id.value;
  json["accepted"] = result.accepted();
  json["verdict"] = matching::to_string(result.verdict);
  json["reason"] = result.reason;
  json["in_directive"] = record.in_directive;
  json["at_s"] = to_seconds(record.at);
  json["match_ms"] = result.match_ms;
  json["margin"] = result.margin;
  if (result.candidates.empty()) return json;
  const auto& best = result.candidates.front();
  json["T_a_b"] = {
      {"x_m", best.T_a_b.x_m}, {"y_m", best.T_a_b.y_m}, {"yaw_rad", best.T_a_b.yaw_rad}};
  json["s_overlapping"] = best.s_overlapping;
  json["acceptance_index"] = best.acceptance_index;
  json["overlap_centre_b"] = {{"x_m", result.overlap_centre_b_m.x()},
                              {"y_m", result.overlap_centre_b_m.y()}};
  return json;
}

Json merges_of(const Coordinator& coordinator) {
  Json merges = Json::array();
  for (const MergeRecord& record : coordinator.accepted_matches())
    merges.push_back(to_json(record));
  // Pairs that never merged are named too, with the reason.
  for (const auto& [pair, record] : coordinator.newest_matches()) {
    if (!record.result.accepted()) merges.push_back(to_json(record));
  }
  return merges;
}

Json helmets_of(const Coordinator& coordinator) {
  Json helmets = Json::array();
  for (const auto& [id, entry] : coordinator.roster().entries()) {
    if (entry.status.role != wire::Role::helmet) continue;
    helmets.push_back({{"agent_id", id},
                       {"map_id", entry.status.map_id},
                       {"epoch_applied", entry.status.epoch_applied},
                       {"fingerprint", to_hex(entry.status.fingerprint)},
                       {"common_map_sha256", to_hex(entry.status.common_map_sha256)},
                       {"tiles_behind", entry.status.tiles_behind},
                       {"id_used_twice", entry.contested}});
  }
  return helmets;
}

/// The helmet whose map frame is the largest group's common frame; empty while there is none.
std::string lead_of(const wire::MergeDirective& directive) {
  for (const auto& member : directive.members) {
    if (member.group == 0) return member.layer.agent_id;
  }
  return "";
}

std::string to_json(const Coordinator& coordinator, Settlement outcome) {
  const auto status = coordinator.status();
  const bool shares = !coordinator.common_map().placements().empty();
  Json json;
  json["settled"] = outcome == Settlement::shared;
  json["outcome"] = to_string(outcome);
  json["epoch"] = status.epoch_applied;
  json["common_map_sha256"] = shares ? to_hex(status.common_map_sha256) : "";
  json["fingerprint"] = shares ? to_hex(status.fingerprint) : "";
  json["bytes_sent"] = status.bytes_sent;
  json["samples_refused"] = status.samples_refused;
  json["helmets"] = helmets_of(coordinator);
  json["merges"] = merges_of(coordinator);
  json["common_frame_of"] = lead_of(coordinator.directive());
  json["detections"] = files::to_json(coordinator.detections());
  return json.dump(1) + "\n";
}

files::PicturePath picture_path(const LayerKey& layer, const Coordinator::Path& path,
                                const Pose2& T_picture_map) {
  files::PicturePath drawn{layer.agent_id.text(), {}};
  for (const Eigen::Vector2d& p_map : path) drawn.points.push_back(T_picture_map * p_map);
  return drawn;
}

/// One peer's impossible map must not cost the report of all the others.
Result<void> leave_out(std::string_view what, const Error& why) {
  spdlog::warn("report: {} is left out: {}", what, why.text);
  return {};
}

Result<void> write_common_map(const std::filesystem::path& folder, const Coordinator& coordinator) {
  const auto grid = to_occupancy(coordinator.common_map().to_grid());
  if (!grid) return leave_out("common_map.png", grid.error());
  std::vector<files::PicturePath> paths;
  for (const auto& placement : coordinator.common_map().placements()) {
    const auto path = coordinator.paths().find(placement.layer);
    if (path == coordinator.paths().end()) continue;
    paths.push_back(
        picture_path(placement.layer, path->second, sharing::to_pose(placement.T_fused_layer)));
  }
  const std::string title = fmt::format("Common map of {} helmets", paths.size());
  if (auto drawn = files::write_map_picture(folder / "common_map.png", *grid, paths, title); !drawn)
    return drawn;
  return files::write_occupancy_image(folder / "common_map", *grid);
}

Result<void> write_own_map(const std::filesystem::path& folder, const Coordinator& coordinator,
                           const LayerKey& layer) {
  const auto& tiles = *coordinator.store().find(layer);
  const auto grid = to_occupancy(sharing::to_grid(tiles, coordinator.store().geometry()));
  if (!grid) return leave_out(fmt::format("the picture of {}", to_string(layer)), grid.error());
  std::vector<files::PicturePath> paths;
  if (const auto path = coordinator.paths().find(layer); path != coordinator.paths().end()) {
    paths.push_back(picture_path(layer, path->second, Pose2{}));
  }
  const std::string name = layer.map_id.value == 1
                               ? layer.agent_id.text()
                               : fmt::format("{}-{}", layer.agent_id.text(), layer.map_id.value);
  return files::write_map_picture(folder / (name + ".png"), *grid, paths,
                                  fmt::format("Own map of {} before merging", to_string(layer)));
}

}  // namespace

Result<void> write_report(const std::filesystem::path& folder, const Coordinator& coordinator,
                          Settlement outcome) {
  for (const auto& [layer, tiles] : coordinator.store().layers()) {
    if (auto written = write_own_map(folder, coordinator, layer); !written) return written;
  }
  if (!coordinator.common_map().tiles().empty()) {
    if (auto written = write_common_map(folder, coordinator); !written) return written;
  }
  return files::write_file_atomically(folder / "coordinator.json", to_json(coordinator, outcome));
}

}  // namespace lifeline
