#pragma once

#include <variant>

#include "common/wire/messages.hpp"

namespace lifeline {

/// A sample of any topic.
using Heard = std::variant<wire::HelmetPose, wire::HelmetScan, wire::TsdTile, wire::TileRequest,
                           wire::TileCopy, wire::MergeDirective, wire::MergeEvidence,
                           wire::AgentStatus, wire::Detection, wire::Alert>;

}  // namespace lifeline
