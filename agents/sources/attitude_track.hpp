#pragma once

#include <functional>
#include <optional>

#include "agents/sensing/raw_scan.hpp"
#include "agents/sources/laser_messages.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// The next sample of an attitude sensor in the order of recording; empty at the end.
using ImuStream = std::function<Result<std::optional<ImuSample>>()>;

/// Roll, pitch and yaw (turned about z, then y, then x) of an orientation with its z axis up.
[[nodiscard]] sensing::Attitude to_attitude(const Eigen::Quaterniond& R_world_body);

/// The attitude at any time of a recording, from its attitude sensor's samples. Reads ahead no
/// farther than the sample behind the time asked for.
class AttitudeTrack {
 public:
  /// Samples farther than this from the time asked for say nothing about it.
  static constexpr Duration kReach = std::chrono::milliseconds(100);

  explicit AttitudeTrack(ImuStream samples) : samples_(std::move(samples)) {}

  /// Between the samples before and after `stamp` (spherical interpolation); at one of them where
  /// only that one is within kReach; empty where none is. Ask in the order of time: samples once
  /// passed do not come back.
  [[nodiscard]] Result<std::optional<sensing::Attitude>> at(Timestamp stamp);

 private:
  struct Held {
    Timestamp stamp{};
    Eigen::Quaterniond R_world_body;
  };
  [[nodiscard]] Result<std::optional<Held>> next_held();

  ImuStream samples_;
  std::optional<Held> before_;
  std::optional<Held> after_;
  bool ended_ = false;
};

}  // namespace lifeline::sources
