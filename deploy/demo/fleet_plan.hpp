#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::demo {

constexpr std::size_t kMostHelmets = 16;

/// One helmet of the demo: its name and the SOURCE of its scans (docs/sources.md).
struct HelmetPlan {
  std::string agent_id;
  std::string source;
};

/// Something to be found, where it truly lies.
struct TrueFind {
  std::string kind;  ///< as reports name it: victim, uwb_tag
  double x_m = 0.0;  ///< in the world's frame
  double y_m = 0.0;
};

struct FleetPlan {
  std::vector<HelmetPlan> helmets;
  std::vector<TrueFind> finds;  ///< empty where nobody knows
  double play_s = 0.0;          ///< how long the longest source plays
};

/// Name of the helmet number `index` (from 0, below kMostHelmets): alpha, bravo, charlie, ...
[[nodiscard]] std::string helmet_name(std::size_t index);

/// A simulated walk, the same for every helmet but for where it leads.
struct Walk {
  std::string plan = "office";  ///< TARGET of `sim:`
  double duration_s = 0.0;      ///< simulated
  double speed = 1.0;           ///< simulated seconds per second
  std::uint64_t seed = 1;
};

/// `helmets` people walking about in one building, where kVictims and kTags are to be found. The
/// errors are those of the plan: wrong_use, not_found, bad_data.
inline constexpr int kVictims = 3, kTags = 1;
[[nodiscard]] Result<FleetPlan> plan_walk(const Walk& walk, std::size_t helmets);

/// Consecutive scans of a log.
struct LogPiece {
  std::size_t from = 0;     ///< number of its first scan in the log, from 0
  std::size_t to = 0;       ///< number of the first scan behind it
  double recorded_s = 0.0;  ///< from its first to its latest scan, >= 0
};

/// Cuts a log, given by the stamps of its scans, into pieces of the same number of scans, give or
/// take one. bad_data where a piece would have fewer than two.
[[nodiscard]] Result<std::vector<LogPiece>> cut_log(const std::vector<Timestamp>& stamps,
                                                    std::size_t pieces);

/// Gives each helmet a piece of the CARMEN log at `path`, with the odometry as prior, played in
/// about `play_s`. The errors are those of the log: not_found, bad_data.
[[nodiscard]] Result<FleetPlan> plan_log(const std::string& path, std::size_t helmets,
                                         double play_s);

}  // namespace lifeline::demo
