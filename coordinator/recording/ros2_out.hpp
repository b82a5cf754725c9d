#pragma once

#include <memory>
#include <vector>

#include "common/dds/raw_publisher.hpp"
#include "common/ros2/messages.hpp"

namespace lifeline {

/// Publishes the mission for ROS 2's tools, in a domain of theirs (docs/ros2.md).
class Ros2Out {
 public:
  /// `options.qos_profiles` as config/qos/ros2.xml. Errors as dds::RawPublisher::open().
  [[nodiscard]] static Result<std::unique_ptr<Ros2Out>> open(
      const dds::ParticipantOptions& options);

  void send(const std::vector<ros2::Message>& messages);

 private:
  explicit Ros2Out(std::unique_ptr<dds::RawPublisher> publisher)
      : publisher_(std::move(publisher)) {}
  void send(const ros2::Message& message);

  std::unique_ptr<dds::RawPublisher> publisher_;
  bool refused_ = false;  ///< said already
};

}  // namespace lifeline
