#include "agents/sources/ros2_receiver.hpp"

#include <algorithm>
#include <utility>

#include "agents/sources/laser_messages.hpp"
#include "common/base/log.hpp"

namespace lifeline::sources {
namespace {

using sensing::AttitudeHealth;

constexpr const char* kScanType = "sensor_msgs::msg::dds_::LaserScan_";
constexpr const char* kImuType = "sensor_msgs::msg::dds_::Imu_";
constexpr std::size_t kScanTopic = 0, kImuTopic = 1;  // places in ros2_topics()
constexpr std::size_t kQueuedScans = 64;              // six seconds of 10 Hz
constexpr std::size_t kQueuedOrientations = 1024;     // five seconds of 200 Hz
constexpr Duration kLook = std::chrono::milliseconds(100);
constexpr Duration kAttitudeSilentAfter = std::chrono::milliseconds(500);

static_assert(kMaxScanBytes > 2 * sizeof(float) * kMaxBeams);

SteadyTime now() {
  return std::chrono::steady_clock::now();
}

}  // namespace

std::vector<dds::RawTopic> ros2_topics(const Ros2Options& options) {
  std::vector<dds::RawTopic> topics{
      {dds_topic(options.scan), kScanType, "ros2_scan_reader", kMaxScanBytes}};
  if (!options.imu.empty()) {
    topics.push_back({dds_topic(options.imu), kImuType, "ros2_imu_reader", kMaxImuBytes});
  }
  return topics;
}

Ros2Receiver::Ros2Receiver(std::unique_ptr<dds::RawSubscriber> subscriber,
                           const Ros2Options& options, const std::stop_token& stop)
    : subscriber_(std::move(subscriber)),
      on_outer_stop_(stop,
                     [this] {
                       stop_.request_stop();
                       subscriber_->wake();
                     }),
      scan_watch_(options.scan, kScanType, options.domain, now()),
      scans_(kQueuedScans, Overflow::drop_oldest),
      orientations_(kQueuedOrientations, Overflow::drop_oldest) {
  if (!options.imu.empty()) imu_watch_.emplace(options.imu, kImuType, options.domain, now());
  thread_ = std::jthread([this] { run(); });
}

Ros2Receiver::~Ros2Receiver() {
  stop_.request_stop();
  subscriber_->wake();
}

std::optional<sensing::RawScan> Ros2Receiver::next_scan() {
  while (!scans_.finished()) {
    auto scan = scans_.pop(std::chrono::seconds(1));
    if (stop_.stop_requested()) break;
    if (scan) return scan;
  }
  return std::nullopt;
}

sensing::AttitudeRead Ros2Receiver::next_orientation(SteadyTime deadline) {
  const bool speaks = health_ == AttitudeHealth::good;
  auto sample = orientations_.pop(speaks ? std::max(deadline - now(), Duration{0}) : Duration{0});
  const bool ended = !sample && orientations_.finished();
  return {std::move(sample), ended};
}

void Ros2Receiver::run() {
  while (!stop_.stop_requested()) {
    subscriber_->wait_for_data(kLook);
    const SteadyTime arrived = now();
    // Scans are taken first and handed on last: the attitudes sent before them are there, then.
    const auto scans = subscriber_->take(kScanTopic);
    if (imu_watch_) {
      take_orientations(subscriber_->take(kImuTopic), arrived);
      judge_attitude(arrived);
      imu_watch_->look(subscriber_->state(kImuTopic), arrived);
    }
    take_scans(scans, arrived);
    scan_watch_.look(subscriber_->state(kScanTopic), arrived);
    tell_of_drops();
  }
  scans_.close();
  orientations_.close();
}

void Ros2Receiver::take_scans(const std::vector<dds::RawSample>& samples, SteadyTime now) {
  for (const dds::RawSample& sample : samples) {
    if (!scan_watch_.takes(sample.publisher, now)) continue;
    auto scan = decode_laser_scan(sample.bytes, RosVersion::ros2);
    if (scan) {
      scan_watch_.note_good(now);
      scans_.push(*std::move(scan));
    } else {
      scan_watch_.note_bad(scan.error().text, now);
    }
  }
}

void Ros2Receiver::take_orientations(const std::vector<dds::RawSample>& samples, SteadyTime now) {
  for (const dds::RawSample& sample : samples) {
    if (!imu_watch_->takes(sample.publisher, now)) continue;
    const auto imu = decode_imu(sample.bytes, RosVersion::ros2);
    if (!imu) {
      imu_watch_->note_bad(imu.error().text, now);
    } else if (!imu->R_world_body) {
      imu_watch_->note_bad(
          "it gives no orientation (orientation_covariance[0] is -1, or the orientation all zero); "
          "name the topic of an orientation filter",
          now);
    } else {
      imu_watch_->note_good(now);
      orientations_.push({imu->stamp, *imu->R_world_body});
    }
  }
}

void Ros2Receiver::judge_attitude(SteadyTime now) {
  const auto is_recent = [now](const std::optional<SteadyTime>& time) {
    return time && now - *time < kAttitudeSilentAfter;
  };
  if (is_recent(imu_watch_->last_good())) {
    health_ = AttitudeHealth::good;
  } else {
    health_ = is_recent(imu_watch_->last_bad()) ? AttitudeHealth::failed : AttitudeHealth::silent;
  }
}

void Ros2Receiver::tell_of_drops() {
  if (scans_.dropped() == 0 || std::exchange(told_of_drops_, true)) return;
  spdlog::warn("scans come faster than they are taken: the oldest are dropped");
}

}  // namespace lifeline::sources
