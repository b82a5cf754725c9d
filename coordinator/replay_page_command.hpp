#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "common/base/result.hpp"
#include "coordinator/dashboard/server.hpp"
#include "coordinator/looking_back/recording_player.hpp"
#include "coordinator/replay_command.hpp"

namespace lifeline {

/// A recording on a page, where people stop it, speed it up and move about in it. Until a signal.
class ReplayPage {
 public:
  /// `speed`: times as fast as it was; nothing: as fast as it goes. wrong_use where the address is
  /// none; else as of Replay::open and dashboard::Server::open.
  [[nodiscard]] static Result<std::unique_ptr<ReplayPage>> open(const ReplayCommandOptions& options,
                                                                std::optional<double> speed);

  /// `at_end` is called when the end is reached for the first time.
  [[nodiscard]] Result<void> run(const std::function<void(const Replay&)>& at_end);

 private:
  ReplayPage() = default;

  dashboard::Feed feed_;
  std::unique_ptr<RecordingPlayer> player_;
  std::unique_ptr<dashboard::Server> server_;
};

}  // namespace lifeline
