#pragma once

#include <optional>
#include <string>

namespace lifeline {

/// What `lifeline-coordinator replay` was told.
struct ReplayCommandOptions {
  std::string bag;
  std::string speed = "1";  ///< times as fast as it was recorded, or `max`
  bool json = false;
  std::optional<std::string> dashboard;  ///< ADDRESS:PORT of a page that shows it
};

/// Plays a recording through the coordinator's code and prints which common map that comes to. A
/// page shows it as the mission's own did, and stays at its end until a signal. The exit status: 0
/// done, 1 failed (an error, or another map than the mission's), 2 wrong use.
[[nodiscard]] int run_replay_command(const ReplayCommandOptions& options);

}  // namespace lifeline
