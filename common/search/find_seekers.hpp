#pragma once

#include <vector>

#include "common/search/assign_parts.hpp"
#include "common/sharing/fused_map.hpp"
#include "common/sharing/pose_watch.hpp"
#include "common/sharing/roster.hpp"

namespace lifeline::search {

/// Who of those whose poses are heard could go and look, in the frame of the map that `placements`
/// make: not those who are lost, not heard for so long that they may be elsewhere, or on another
/// map.
[[nodiscard]] std::vector<Seeker> find_seekers(const sharing::PoseWatch& poses,
                                               const sharing::Roster& roster,
                                               const std::vector<sharing::Placement>& placements,
                                               SteadyTime now);

}  // namespace lifeline::search
