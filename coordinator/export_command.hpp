#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lifeline {

/// What `lifeline-coordinator export` was told.
struct ExportCommandOptions {
  std::filesystem::path source;  ///< a recording, NAME.lifemap, or NAME.yaml of ROS map_server
  std::filesystem::path to;
  std::vector<std::string> formats;  ///< empty: all that can be made
  std::vector<std::string> origin;   ///< two of X,Y=LATITUDE,LONGITUDE
  bool json = false;                 ///< print one JSON object
};

/// Writes what a recording or a saved map holds in formats of others, and names the files. The exit
/// status: 0 done, 1 failed, 2 wrong use.
[[nodiscard]] int run_export_command(const ExportCommandOptions& options);

}  // namespace lifeline
