#pragma once

#include "common/base/result.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline::proto {
class CoordinatorConfig;
class GridConfig;
}  // namespace lifeline::proto

namespace lifeline {

/// The schema's values as the coordinator's parts take them; the values were checked when the file
/// was read.
[[nodiscard]] CoordinatorSettings to_settings(const proto::CoordinatorConfig& config,
                                              sharing::Speaker speaker);
[[nodiscard]] matching::MatchConfig to_match_config(const proto::CoordinatorConfig& config);

}  // namespace lifeline
