#include "common/bag/bag_metadata.hpp"

#include <fmt/format.h>

namespace lifeline::bag {
namespace {

/// A text between double quotes, whatever it holds.
std::string quoted(const std::string& text) {
  std::string yaml = "\"";
  for (const char c : text) {
    if (c == '\n') {
      yaml += "\\n";
    } else if (c == '"' || c == '\\') {
      yaml += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      yaml += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      yaml += c;
    }
  }
  return yaml + "\"";
}

}  // namespace

std::string qos_text(Durability durability) {
  const bool kept = durability == Durability::transient_local;
  // The numbers are those of rmw's enumerations: keep last 1; reliable 1; transient local 1,
  // volatile 2.
  return fmt::format(
      "- history: 1\n  depth: {}\n  reliability: 1\n  durability: {}\n"
      "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
      "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
      "  liveliness: 1\n"
      "  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
      "  avoid_ros_namespace_conventions: false",
      kept ? 1 : 10, kept ? 1 : 2);
}

std::string to_yaml(const Metadata& metadata) {
  std::string yaml = fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
      "  duration:\n    nanoseconds: {0}\n"
      "  starting_time:\n    nanoseconds_since_epoch: {1}\n"
      "  message_count: {2}\n  topics_with_message_count:{3}\n",
      metadata.last_ns - metadata.first_ns, metadata.first_ns, metadata.messages,
      metadata.topics.empty() ? " []" : "");
  for (const TopicCount& count : metadata.topics) {
    yaml += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n"
        "        serialization_format: cdr\n        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        quoted(count.topic.name), quoted(count.topic.type), quoted(count.qos), count.messages);
  }
  return yaml + fmt::format(
                    "  compression_format: \"\"\n  compression_mode: \"\"\n"
                    "  relative_file_paths:\n    - {0}\n  files:\n    - path: {0}\n"
                    "      starting_time:\n        nanoseconds_since_epoch: {1}\n"
                    "      duration:\n        nanoseconds: {2}\n      message_count: {3}\n",
                    quoted(metadata.file), metadata.first_ns, metadata.last_ns - metadata.first_ns,
                    metadata.messages);
}

}  // namespace lifeline::bag
