#pragma once

#include "coordinator/coordinator.hpp"
#include "tests/support/helmet_channels.hpp"

namespace lifeline::test {

template <typename Bus>
CoordinatorChannels coordinator_channels(Bus& bus) {
  return {bus.template reader<wire::TsdTile>(),
          bus.template reader<wire::HelmetPose>(),
          bus.template reader<wire::AgentStatus>(),
          bus.template reader<wire::Detection>(),
          bus.template writer<wire::MergeDirective>(),
          bus.template writer<wire::MergeEvidence>(),
          bus.template writer<wire::AgentStatus>(),
          exchange_channels(bus),
          [] { return std::uint64_t{0}; },
          [] { return std::uint64_t{0}; }};
}

}  // namespace lifeline::test
