#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lifeline {

/// What `lifeline-coordinator match` was told.
struct MatchCommandOptions {
  std::filesystem::path a;  ///< NAME.yaml as ROS map_server writes it, or NAME.lifemap
  std::filesystem::path b;
  bool json = false;
  std::string matching = "oriented";             ///< or spectra
  std::optional<std::filesystem::path> picture;  ///< PNG that shows b laid on a
};

/// Looks for T_G between two saved maps and prints it with its evidence. The exit status: 0 done,
/// whatever the verdict; 1 failed (a map cannot be read, cell sizes differ), 2 wrong use.
[[nodiscard]] int run_match_command(const MatchCommandOptions& options);

}  // namespace lifeline
