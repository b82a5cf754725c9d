#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "agents/sensing/attitude_source.hpp"
#include "agents/sensing/raw_scan.hpp"
#include "agents/sources/laser_messages.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// The next sample of an attitude sensor in the order of recording; empty at the end.
using ImuStream = std::function<Result<std::optional<ImuSample>>()>;

/// Roll, pitch and yaw (turned about z, then y, then x) of an orientation with its z axis up.
[[nodiscard]] sensing::Attitude to_attitude(const Eigen::Quaterniond& R_world_body);

/// The attitude at any time, from the samples of a recording or of a live sensor. Reads ahead no
/// farther than the sample behind the time asked for, and of a live sensor no longer than it may.
class AttitudeTrack {
 public:
  /// Samples farther than this from the time asked for say nothing about it.
  static constexpr Duration kReach = std::chrono::milliseconds(100);
  /// Of a sweep; more come from no sensor.
  static constexpr std::size_t kMostAhead = 4096;

  explicit AttitudeTrack(std::unique_ptr<sensing::AttitudeSource> source)
      : source_(std::move(source)) {}
  /// A recording's messages; those without an orientation are passed over.
  explicit AttitudeTrack(ImuStream samples);

  /// Between the samples before and after `stamp` (spherical interpolation); at one of them where
  /// only that one is within kReach; empty where none is. Ask in the order of time: samples once
  /// passed do not come back. A live source is waited for until `deadline`.
  [[nodiscard]] Result<std::optional<sensing::Attitude>> at(
      Timestamp stamp, SteadyTime deadline = SteadyTime::max());

  /// Sets a scan's attitude, and how it goes on within the sweep: up to the first sample behind its
  /// end. Where samples are farther apart than kReach nothing is known of what lies between, and
  /// the sweep is left to the attitude at its stamp.
  [[nodiscard]] Result<void> fill(sensing::RawScan& scan, SteadyTime deadline = SteadyTime::max());

  /// For a live source whose clock may be set back: before a scan at `stamp`. Where all that was
  /// read lies far ahead of it, reads what is there without waiting, and begins anew at a sample
  /// far behind the one before it.
  [[nodiscard]] Result<void> follow_set_back(Timestamp stamp);

  /// Whether no sample as late as `stamp` has been read yet.
  [[nodiscard]] bool is_behind(Timestamp stamp) const;
  [[nodiscard]] sensing::AttitudeHealth health() const { return source_->health(); }

 private:
  using Sample = sensing::OrientationSample;
  [[nodiscard]] Result<std::optional<Sample>> read(SteadyTime deadline);
  [[nodiscard]] Result<void> read_ahead(Timestamp stamp, SteadyTime deadline);

  std::unique_ptr<sensing::AttitudeSource> source_;
  std::optional<Sample> before_;
  std::optional<Sample> after_;
  std::deque<Sample> ahead_;  ///< read for a sweep's end, behind after_
  bool ended_ = false;
};

}  // namespace lifeline::sources
