#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "agents/sensing/attitude_source.hpp"
#include "agents/sensing/raw_scan.hpp"
#include "agents/sources/ros2_options.hpp"
#include "agents/sources/ros2_watch.hpp"
#include "common/base/bounded_queue.hpp"
#include "common/dds/raw_subscriber.hpp"

namespace lifeline::sources {

/// A larger LaserScan is dropped by DDS: kMaxBeams ranges and as many intensities, and the rest.
constexpr std::uint32_t kMaxScanBytes = 2 * 4 * 32768 + 1024;
/// A larger Imu message is dropped by DDS: 37 doubles, and a long frame_id.
constexpr std::uint32_t kMaxImuBytes = 1024;

/// Takes a ROS 2 driver's messages on a thread of its own, decodes them, and keeps scans and
/// orientations for their readers. Nothing that comes, or does not come, is an error: it is
/// counted, and named in the log.
class Ros2Receiver {
 public:
  /// `subscriber` hears the scans as its topic 0 and, where `options.imu` is given, the attitude as
  /// its topic 1. A request on `stop` ends everything that waits here.
  Ros2Receiver(std::unique_ptr<dds::RawSubscriber> subscriber, const Ros2Options& options,
               const std::stop_token& stop);
  ~Ros2Receiver();
  Ros2Receiver(const Ros2Receiver&) = delete;
  Ros2Receiver& operator=(const Ros2Receiver&) = delete;

  /// The next scan in the order of arrival; waits for it. Empty after the stop.
  [[nodiscard]] std::optional<sensing::RawScan> next_scan();
  /// The next orientation; waits until `deadline`, and not while none come.
  [[nodiscard]] sensing::AttitudeRead next_orientation(SteadyTime deadline);
  /// Failed while messages come without a usable orientation.
  [[nodiscard]] sensing::AttitudeHealth attitude_health() const { return health_; }

 private:
  void run();
  void take_scans(const std::vector<dds::RawSample>& samples, SteadyTime now);
  void take_orientations(const std::vector<dds::RawSample>& samples, SteadyTime now);
  void judge_attitude(SteadyTime now);
  void tell_of_drops();

  std::stop_source stop_;
  const std::unique_ptr<dds::RawSubscriber> subscriber_;
  std::stop_callback<std::function<void()>> on_outer_stop_;
  TopicWatch scan_watch_;
  std::optional<TopicWatch> imu_watch_;
  BoundedQueue<sensing::RawScan> scans_;
  BoundedQueue<sensing::OrientationSample> orientations_;
  std::atomic<sensing::AttitudeHealth> health_{sensing::AttitudeHealth::silent};
  bool told_of_drops_ = false;
  std::jthread thread_;  // last: joined before what it uses goes away
};

/// The DDS topics of `options`, in the order that the receiver expects.
[[nodiscard]] std::vector<dds::RawTopic> ros2_topics(const Ros2Options& options);

}  // namespace lifeline::sources
