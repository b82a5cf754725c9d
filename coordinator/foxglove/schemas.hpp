#pragma once

#include <string>
#include <string_view>

namespace lifeline::foxglove {

/// The definition of a message type of common/ros2/messages.hpp as ROS 2's .msg files have it, and
/// of all types that it is made of, in the form of `ros2msg` schemas. Empty for any other type.
[[nodiscard]] std::string schema_of(std::string_view type);

}  // namespace lifeline::foxglove
