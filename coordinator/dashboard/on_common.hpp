#pragma once

#include <array>
#include <optional>

#include "common/base/ids.hpp"
#include "common/grid/pose2.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline::dashboard {

/// A layer's place on the common map.
struct OnCommon {
  Pose2 T_common_map;
  std::array<double, 6> covariance{};
};

/// Nothing: it is not on it.
[[nodiscard]] std::optional<OnCommon> on_common(const Coordinator& coordinator,
                                                const LayerKey& layer);

}  // namespace lifeline::dashboard
