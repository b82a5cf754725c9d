#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/bag/bag_file.hpp"

namespace lifeline::bag {

/// How a topic's messages were offered, as far as who plays a bag must know it.
enum class Durability {
  volatile_,        ///< for who listens at the moment
  transient_local,  ///< the newest message, also for who comes late
};

/// The QoS of a topic as rosbag2 keeps it (YAML): reliable, all deadlines endless.
[[nodiscard]] std::string qos_text(Durability durability);

struct TopicCount {
  Topic topic;
  std::string qos;
  std::uint64_t messages = 0;
};

/// What metadata.yaml says of a bag of one file.
struct Metadata {
  std::string file;  ///< name of the .db3 file
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::uint64_t messages = 0;
  std::vector<TopicCount> topics;
};

/// metadata.yaml in the version that ROS 2 Humble writes (5), which later ones read.
[[nodiscard]] std::string to_yaml(const Metadata& metadata);

}  // namespace lifeline::bag
