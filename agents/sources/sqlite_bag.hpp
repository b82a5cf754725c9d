#pragma once

#include <string>
#include <vector>

#include "agents/sources/bag_stream.hpp"

namespace lifeline::sources {

/// The topics of one .db3 file of a rosbag2 recording, in the order of their ids. Files are opened
/// read-only, and as immutable where no write-ahead log stands beside them: a bag on a read-only
/// medium plays. bad_data for a file that is no such database, unsupported for topics that are not
/// serialized as CDR.
[[nodiscard]] Result<std::vector<BagTopic>> sqlite_topics(const std::string& file);

/// The messages of `topic` in all `files` of a recording, which are taken in the order of their
/// first messages; a file that lacks the topic is passed over.
[[nodiscard]] Result<BagStream> open_sqlite_topic(const std::vector<std::string>& files,
                                                  const std::string& topic);

}  // namespace lifeline::sources
