#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/grid/pose2.hpp"
#include "deploy/demo/fleet_plan.hpp"

namespace lifeline::demo {

/// What is known of one helmet once it has stopped.
struct HelmetOutcome {
  std::string agent_id;
  nlohmann::json report;             ///< its ID.json; null where it left none
  std::optional<double> rmse_m;      ///< of its trajectory, after alignment to the truth
  std::optional<Pose2> T_world_map;  ///< where its map frame truly lies
};

/// The content of summary.json (docs/demo.md names the fields). `coordinator` is coordinator.json,
/// or null where there is none; `finds` is what is truly to be found. What is not known is null in
/// the summary, too.
[[nodiscard]] nlohmann::json make_summary(const std::vector<HelmetOutcome>& helmets,
                                          const nlohmann::json& coordinator,
                                          const std::vector<TrueFind>& finds, double wall_s);

/// True where the summary's accepted merges tie all of its helmets together.
[[nodiscard]] bool is_one_map(const nlohmann::json& summary);

/// How a demo ended.
struct Verdict {
  bool good = false;
  std::string text;  ///< for people, one line
};

/// Good is one map on all machines, all in it. A helmet alone has nobody to share with: there, good
/// is that the coordinator holds all of its map. `coordinator` is coordinator.json, or null.
[[nodiscard]] Verdict judge(const nlohmann::json& summary, const nlohmann::json& coordinator);

/// The summary as a table for people, several lines.
[[nodiscard]] std::string render_summary(const nlohmann::json& summary);

}  // namespace lifeline::demo
