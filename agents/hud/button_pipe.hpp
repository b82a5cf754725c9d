#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "agents/serial/file_descriptor.hpp"
#include "common/base/result.hpp"

namespace lifeline::hud {

/// A button that no keyboard has: whoever watches it writes `1` into a FIFO (or any device that can
/// be read) when it goes down, and `0` when it comes up. All else is ignored.
class ButtonPipe {
 public:
  /// not_found or unavailable where it cannot be opened.
  [[nodiscard]] static Result<ButtonPipe> open(const std::filesystem::path& path);

  /// What came since the last call, true for down: a few dozen octets at most. Never blocks.
  [[nodiscard]] std::vector<bool> take();

 private:
  explicit ButtonPipe(serial::FileDescriptor pipe) : pipe_(std::move(pipe)) {}
  serial::FileDescriptor pipe_;
};

}  // namespace lifeline::hud
