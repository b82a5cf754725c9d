#pragma once

#include <string>
#include <vector>

#include "agents/sources/bag_stream.hpp"

namespace lifeline::sources {

/// The topics of a ROS 1 bag (format 2.0), in the order in which they appear. Reads the record
/// headers of the whole file. bad_data for a file that is no such bag or is cut off, unsupported
/// for compressed chunks.
[[nodiscard]] Result<std::vector<BagTopic>> ros1_topics(const std::string& file);

/// The messages of `topic`, in the order of the file. Holds one message at a time.
[[nodiscard]] Result<BagStream> open_ros1_topic(const std::string& file, const std::string& topic);

}  // namespace lifeline::sources
