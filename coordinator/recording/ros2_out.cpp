#include "coordinator/recording/ros2_out.hpp"

#include "common/base/log.hpp"
#include "common/ros2/names.hpp"

namespace lifeline {
namespace {

constexpr const char* kMapWriter = "ros2_map_writer";
constexpr const char* kStreamWriter = "ros2_stream_writer";

}  // namespace

Result<std::unique_ptr<Ros2Out>> Ros2Out::open(const dds::ParticipantOptions& options) {
  auto publisher =
      dds::RawPublisher::open(options, "ros2_participant", {kMapWriter, kStreamWriter});
  if (!publisher) return forward_error(publisher);
  spdlog::info("publishes for ROS 2 in domain {}", options.domain_id);
  return std::unique_ptr<Ros2Out>(new Ros2Out(*std::move(publisher)));
}

void Ros2Out::send(const std::vector<ros2::Message>& messages) {
  for (const ros2::Message& message : messages) send(message);
}

void Ros2Out::send(const ros2::Message& message) {
  const bool is_map = message.type == ros2::kOccupancyGrid;
  const auto sent = publisher_->put({ros2::dds_topic(message.topic), ros2::dds_type(message.type),
                                     is_map ? kMapWriter : kStreamWriter},
                                    message.cdr);
  if (!sent && !std::exchange(refused_, true)) spdlog::warn("ROS 2: {}", sent.error().text);
}

}  // namespace lifeline
