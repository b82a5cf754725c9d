#pragma once

#include <filesystem>
#include <fstream>
#include <memory>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/base/result.hpp"

namespace lifeline {

/// Writes down when this helmet published which revision of its tiles, when the oldest scan was
/// taken that is new in it, and when which tiles of all members came into its common map: one JSON
/// object a line. Times are of the machine's monotonic clock, in seconds: what processes of one
/// machine write can be compared.
class MapJournal {
 public:
  /// unavailable where the file cannot be written.
  [[nodiscard]] static Result<MapJournal> open(const std::filesystem::path& file);

  /// Hears of what `helmet` does, which must not outlive this.
  void attach(sharing::HelmetSharing& helmet);

 private:
  explicit MapJournal(std::unique_ptr<std::ofstream> file) : file_(std::move(file)) {}
  std::unique_ptr<std::ofstream> file_;
};

}  // namespace lifeline
