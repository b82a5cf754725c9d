#include "deploy/demo/summary.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "deploy/demo/merge_error.hpp"

namespace lifeline::demo {
namespace {

using nlohmann::json;

/// The field, or null where `object` is none or lacks it.
json field(const json& object, const std::string& name) {
  return object.is_object() ? object.value(name, json()) : json();
}

std::string text(const json& value, const std::string& otherwise) {
  return value.is_string() ? value.get<std::string>() : otherwise;
}

std::optional<double> number(const json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

template <typename T>
json or_null(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

/// A helmet without a common map reports an empty hash or one of zeros only.
bool is_hash(const std::string& hash) {
  return hash.find_first_not_of('0') != std::string::npos;
}

json helmet_summary(const HelmetOutcome& helmet) {
  json result{{"agent_id", helmet.agent_id}};
  for (const char* name : {"scans", "scans_dropped", "common_map_sha256", "fingerprint"}) {
    result[name] = field(helmet.report, name);
  }
  result["trajectory_rmse_m"] = or_null(helmet.rmse_m);
  for (const char* name : {"slam_ms_median", "slam_ms_p99", "bytes_sent"}) {
    result[name] = field(helmet.report, name);
  }
  return result;
}

std::optional<Pose2> read_pose(const json& value) {
  const auto x_m = number(field(value, "x_m")), y_m = number(field(value, "y_m"));
  const auto yaw_rad = number(field(value, "yaw_rad"));
  if (!x_m || !y_m || !yaw_rad) return std::nullopt;
  return Pose2{*x_m, *y_m, *yaw_rad};
}

/// T_a_b as the two trajectories have it, where both helmets know the truth.
std::optional<Pose2> true_transform(const std::map<std::string, Pose2>& T_world_map,
                                    const json& merge) {
  const auto a = T_world_map.find(text(field(merge, "a"), ""));
  const auto b = T_world_map.find(text(field(merge, "b"), ""));
  if (a == T_world_map.end() || b == T_world_map.end()) return std::nullopt;
  return a->second.inverse() * b->second;
}

json merge_summary(const json& merge, const std::map<std::string, Pose2>& T_world_map) {
  json result;
  for (const char* name :
       {"a", "b", "accepted", "T_a_b", "s_overlapping", "acceptance_index", "at_s"}) {
    result[name] = field(merge, name);
  }
  for (const char* name : {"error_m", "error_deg", "error_at_origin_m"}) result[name] = json();
  const auto T_a_b = read_pose(field(merge, "T_a_b"));
  const auto T_a_b_true = true_transform(T_world_map, merge);
  if (!T_a_b || !T_a_b_true) return result;
  const json centre = field(merge, "overlap_centre_b");
  const auto x_m = number(field(centre, "x_m")), y_m = number(field(centre, "y_m"));
  const bool has_centre = x_m && y_m;
  const MergeError error = merge_error(
      *T_a_b, *T_a_b_true, has_centre ? Eigen::Vector2d(*x_m, *y_m) : Eigen::Vector2d::Zero());
  if (has_centre) result["error_m"] = error.at_centre_m;
  result["error_deg"] = error.angle_deg;
  result["error_at_origin_m"] = error.at_origin_m;
  return result;
}

/// The coordinator's list, each entry with how far it is from the nearest true find of its kind.
json finds_summary(const json& coordinator, const std::map<std::string, Pose2>& T_world_map,
                   const std::vector<TrueFind>& finds) {
  json all = json::array();
  const auto lead = T_world_map.find(text(field(coordinator, "common_frame_of"), ""));
  for (json find : field(coordinator, "detections")) {
    if (!find.is_object()) continue;
    find["error_m"] = json();
    const auto x_m = number(field(find, "x_m")), y_m = number(field(find, "y_m"));
    if (lead != T_world_map.end() && text(field(find, "frame"), "") == "common" && x_m && y_m) {
      const Eigen::Vector2d p_world = lead->second * Eigen::Vector2d(*x_m, *y_m);
      for (const TrueFind& there : finds) {
        const double error_m = (p_world - Eigen::Vector2d(there.x_m, there.y_m)).norm();
        if (there.kind != text(field(find, "kind"), "") ||
            error_m > number(field(find, "error_m")).value_or(error_m)) {
          continue;
        }
        find["error_m"] = error_m;
      }
    }
    all.push_back(std::move(find));
  }
  return all;
}

bool all_lists_equal(const std::vector<HelmetOutcome>& helmets, const json& coordinator) {
  const json list = field(coordinator, "detections");
  return list.is_array() && std::all_of(helmets.begin(), helmets.end(), [&](const auto& helmet) {
           return field(helmet.report, "detections") == list;
         });
}

bool all_hashes_equal(const json& summary) {
  const std::string hash = text(summary["coordinator"]["common_map_sha256"], "");
  const json& helmets = summary["helmets"];
  return is_hash(hash) && std::all_of(helmets.begin(), helmets.end(), [&](const json& helmet) {
           return text(helmet["common_map_sha256"], "") == hash;
         });
}

std::string shown(const json& value, const char* format) {
  const auto known = number(value);
  return known ? fmt::format(fmt::runtime(format), *known) : "-";
}

std::string render_helmet(const json& helmet) {
  return fmt::format(
      "{:<10} {:>6} {:>8} {:>10} {:>8} {:>9} {:>8}  {:.12}\n", text(helmet["agent_id"], ""),
      shown(helmet["scans"], "{:.0f}"), shown(helmet["scans_dropped"], "{:.0f}"),
      shown(helmet["slam_ms_median"], "{:.2f}"), shown(helmet["slam_ms_p99"], "{:.2f}"),
      shown(helmet["bytes_sent"], "{:.0f}"), shown(helmet["trajectory_rmse_m"], "{:.3f}"),
      text(helmet["common_map_sha256"], "none"));
}

std::string render_find(const json& find) {
  std::string by;
  for (const json& id : field(find, "seen_by")) by += (by.empty() ? "" : ", ") + text(id, "?");
  return fmt::format("{:<10} {:<10} {:>8} {:>8} {:>8} {:>6} {:>9}  {}\n",
                     text(field(find, "kind"), "?"), text(field(find, "frame"), "?"),
                     shown(field(find, "x_m"), "{:.2f}"), shown(field(find, "y_m"), "{:.2f}"),
                     shown(field(find, "error_m"), "{:.3f}"),
                     shown(field(find, "confidence"), "{:.2f}"),
                     text(field(field(find, "first_seen"), "by"), "?"), by);
}

/// The merges of one pair in one line: the newest one's figures, and the largest error of all.
std::string render_pair(const std::string& pair, const std::vector<json>& merges) {
  const json& newest = merges.back();
  double worst_m = 0.0;
  for (const json& merge : merges) {
    worst_m = std::max(worst_m, number(merge["error_m"]).value_or(0.0));
  }
  return fmt::format("{:<22} {:<9} {:>7} {:>8} {:>9.3f} {:>9} {:>7} {:>7} {:>7}\n", pair,
                     newest["accepted"] == true ? "accepted" : "refused", merges.size(),
                     shown(newest["error_m"], "{:.3f}"), worst_m,
                     shown(newest["error_deg"], "{:.2f}"), shown(newest["s_overlapping"], "{:.3f}"),
                     shown(newest["acceptance_index"], "{:.3f}"),
                     shown(merges.front()["at_s"], "{:.1f}"));
}

}  // namespace

json make_summary(const std::vector<HelmetOutcome>& helmets, const json& coordinator,
                  const std::vector<TrueFind>& finds, double wall_s) {
  std::map<std::string, Pose2> T_world_map;
  json summary{{"shared", false},
               {"helmets", json::array()},
               {"coordinator", {{"common_map_sha256", field(coordinator, "common_map_sha256")}}},
               {"merges", json::array()},
               {"wall_s", wall_s}};
  for (const HelmetOutcome& helmet : helmets) {
    summary["helmets"].push_back(helmet_summary(helmet));
    if (helmet.T_world_map) T_world_map.emplace(helmet.agent_id, *helmet.T_world_map);
  }
  for (const json& merge : field(coordinator, "merges")) {
    summary["merges"].push_back(merge_summary(merge, T_world_map));
  }
  summary["detections"] = finds_summary(coordinator, T_world_map, finds);
  summary["detections_agree"] = all_lists_equal(helmets, coordinator);
  summary["shared"] = all_hashes_equal(summary);
  return summary;
}

bool is_one_map(const json& summary) {
  std::vector<std::string> helmets;
  for (const json& helmet : summary["helmets"]) helmets.push_back(text(helmet["agent_id"], ""));
  std::vector<std::pair<std::string, std::string>> merges;
  for (const json& merge : summary["merges"]) {
    if (merge["accepted"] == true) merges.emplace_back(text(merge["a"], ""), text(merge["b"], ""));
  }
  return all_in_one_map(helmets, merges);
}

Verdict judge(const json& summary, const json& coordinator) {
  const std::string outcome = text(field(coordinator, "outcome"), "working");
  if (summary["helmets"].size() == 1 && outcome == "apart") {
    const std::string id = text(summary["helmets"][0]["agent_id"], "?");
    return {true, fmt::format("{0} was alone: nobody to share a map with; the coordinator holds "
                              "all of its map ({0}.png)",
                              id)};
  }
  if (outcome == "working") return {false, "the helmets did not come to share one map in time"};
  if (!is_one_map(summary)) return {false, "the helmets are not all in one map"};
  if (summary["shared"] != true || outcome != "shared") {
    return {false, "the maps are not the same on all machines"};
  }
  return {true, "all share one map"};
}

std::string render_summary(const json& summary) {
  std::string table =
      fmt::format("{:<10} {:>6} {:>8} {:>10} {:>8} {:>9} {:>8}  {}\n", "helmet", "scans", "dropped",
                  "SLAM ms", "p99", "sent B", "rmse m", "common map");
  for (const json& helmet : summary["helmets"]) table += render_helmet(helmet);
  table += fmt::format("{:<64}  {:.12}\n\n", "coordinator",
                       text(summary["coordinator"]["common_map_sha256"], "none"));
  table += fmt::format("{:<22} {:<9} {:>7} {:>8} {:>9} {:>9} {:>7} {:>7} {:>7}\n", "merge", "",
                       "matches", "error m", "largest", "error deg", "S", "ai", "first s");
  std::map<std::string, std::vector<json>> pairs;
  for (const json& merge : summary["merges"]) {
    pairs[text(merge["a"], "?") + " - " + text(merge["b"], "?")].push_back(merge);
  }
  for (const auto& [pair, merges] : pairs) table += render_pair(pair, merges);
  if (field(summary, "detections").empty()) return table;
  table += fmt::format("\n{:<10} {:<10} {:>8} {:>8} {:>8} {:>6} {:>9}  {}\n", "find", "frame",
                       "x m", "y m", "error m", "sure", "first by", "seen by");
  for (const json& find : summary["detections"]) table += render_find(find);
  return table;
}

}  // namespace lifeline::demo
