#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/base/result.hpp"
#include "common/grid/stamped_pose.hpp"

namespace lifeline::bench {

/// What `lifeline-agent slam` is to play.
struct SlamJob {
  std::filesystem::path agent;   ///< the program
  std::filesystem::path folder;  ///< takes what it writes; must exist
  std::string source;
  std::string matcher;
};

/// What it wrote.
struct SlamOutcome {
  std::vector<StampedPose> trajectory;
  std::vector<StampedPose> truth;  ///< empty where the source knows none
  nlohmann::json stats;
  std::filesystem::path map;  ///< a .lifemap file
};

/// Plays a source in a process of its own, at most half an hour. The error holds the last line the
/// program wrote.
[[nodiscard]] Result<SlamOutcome> run_slam(const SlamJob& job);

/// Draws the map with the trajectory and, laid over it, the truth.
[[nodiscard]] Result<void> draw_run(const std::filesystem::path& picture, const SlamOutcome& run,
                                    const std::string& title);

}  // namespace lifeline::bench
