#pragma once

#include "common/sharing/fused_map.hpp"

namespace lifeline {

/// What a machine holds of the mission, as a recording needs it: a view, valid while its owner
/// stands still.
struct MissionState {
  const sharing::ReplicaStore& store;     ///< everybody's layers, its own included
  const wire::MergeDirective& directive;  ///< the one that it follows; epoch 0 before the first
  const sharing::FusedMap& common_map;    ///< of the group that it shows
};

}  // namespace lifeline
