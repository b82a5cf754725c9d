#pragma once

#include <vector>

#include "common/sharing/fused_map.hpp"

namespace lifeline::sharing {

/// Where the members of the group that holds `layer` lie in the common frame; empty when no group
/// holds it.
[[nodiscard]] std::vector<Placement> group_of(const wire::MergeDirective& directive,
                                              const LayerKey& layer);

/// The same of the largest group: group 0, since plans list the largest first.
[[nodiscard]] std::vector<Placement> largest_group(const wire::MergeDirective& directive);

}  // namespace lifeline::sharing
