#pragma once

#include <functional>
#include <memory>

#include "common/base/result.hpp"
#include "coordinator/dashboard/dashboard.hpp"
#include "coordinator/recording/replay.hpp"
#include "coordinator/replay_command.hpp"

namespace lifeline {

/// A recording on a page, which people stop, speed up and move about in. Goes back by playing anew
/// from the beginning, as fast as it goes: the same code, the same picture. Until a signal.
class ReplayPage {
 public:
  /// `speed`: times as fast as it was; nothing: as fast as it goes. wrong_use where the address is
  /// none; else as of Dashboard::open.
  [[nodiscard]] static Result<std::unique_ptr<ReplayPage>> open(std::unique_ptr<Replay> replay,
                                                                const ReplayCommandOptions& options,
                                                                std::optional<double> speed);

  /// `at_end` is called when the end is reached for the first time.
  [[nodiscard]] Result<void> run(const std::function<void(const Replay&)>& at_end);

  [[nodiscard]] const Replay& replay() const { return *replay_; }

 private:
  ReplayPage(std::unique_ptr<Replay> replay, std::string bag)
      : replay_(std::move(replay)), bag_(std::move(bag)) {}
  [[nodiscard]] Result<void> play();
  [[nodiscard]] Result<void> follow(const dashboard::Steer& steer);
  [[nodiscard]] Result<void> go_to(Duration to);
  void anchor();
  void show(bool is_seeking);

  std::unique_ptr<Replay> replay_;
  std::string bag_;
  std::unique_ptr<dashboard::Dashboard> page_;
  dashboard::Timeline timeline_;
  SteadyTime anchored_{};  ///< then, by the machine's clock, ...
  Duration anchor_{};      ///< ... the recording was here
  bool is_at_end_ = false;
};

}  // namespace lifeline
