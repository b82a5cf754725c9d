#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bag/bag_file.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// In ROS 1 bags the type is written without `msg/`.
using BagTopic = bag::Topic;

/// One serialized message of a topic.
struct BagMessage {
  std::vector<std::uint8_t> bytes;
  std::string place;  ///< file and which message of it, for error texts
};

/// A larger message is no scan and no attitude.
constexpr std::size_t kMaxMessageBytes = 4 * 1024 * 1024;

/// The next message of one topic, in the order of recording; empty at the end.
using BagStream = std::function<Result<std::optional<BagMessage>>()>;

}  // namespace lifeline::sources
