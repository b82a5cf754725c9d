#include "coordinator/dashboard/on_common.hpp"

#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"

namespace lifeline::dashboard {

std::optional<OnCommon> on_common(const Coordinator& coordinator, const LayerKey& layer) {
  const auto name = sharing::to_layer_name(layer);
  for (const auto& member : coordinator.directive().members) {
    if (member.group == 0 && member.layer == name)
      return OnCommon{sharing::to_pose(member.T_common_map), member.covariance};
  }
  return std::nullopt;
}

}  // namespace lifeline::dashboard
