#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lifeline {

/// What `lifeline-agent slam` was told.
struct SlamCommandOptions {
  std::string source;
  std::string attitude;                             ///< of a live attitude sensor; empty for none
  std::optional<std::filesystem::path> trajectory;  ///< TUM file; NAME.truth.tum beside it where
                                                    ///< the source knows the truth
  std::optional<std::filesystem::path> map;     ///< NAME of NAME.lifemap, NAME.pgm and NAME.yaml
  std::optional<std::filesystem::path> stats;   ///< JSON: counts, times, memory
  std::optional<std::filesystem::path> config;  ///< config/agent.yaml's schema
  std::optional<std::string> matcher;           ///< overrides the configuration
  bool json = false;                            ///< print what `stats` would hold
};

/// One helmet offline: plays a source through SLAM as fast as it goes, with no network. Same input,
/// same output. Nothing is written unless all of the source could be read. The exit status: 0 done,
/// 1 failed, 2 wrong use; errors are one line on stderr.
[[nodiscard]] int run_slam_command(const SlamCommandOptions& options);

}  // namespace lifeline
