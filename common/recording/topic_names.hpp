#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "common/bag/bag_file.hpp"
#include "common/dds/topics.hpp"

namespace lifeline {

/// What a recording begins and ends with: std_msgs/String that holds a JSON object.
inline constexpr std::string_view kRecordingTopic = "/lifeline/recording";

/// How a topic of ours is called in a recording: `lifeline/pose` of `lifeline::msg::HelmetPose` is
/// `/lifeline/pose` of `lifeline/msg/HelmetPose`.
template <typename Message>
[[nodiscard]] bag::Topic recorded_topic() {
  const auto& row = dds::topic_of<Message>();
  std::string type(row.type);
  for (std::size_t at = type.find("::"); at != std::string::npos; at = type.find("::", at))
    type.replace(at, 2, "/");
  return {fmt::format("/{}", row.name), type};
}

}  // namespace lifeline
