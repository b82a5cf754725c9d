#pragma once

#include <functional>
#include <string>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/wire/loopback.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline::test {

/// What the fleets that run in one process have in common.
inline constexpr const char* kMission = "drill";
inline constexpr Duration kTick = std::chrono::milliseconds(100);

inline sharing::Speaker speaker(const std::string& id) {
  return {AgentId::parse(id).value(), kMission, Incarnation{std::hash<std::string>{}(id) | 1U}};
}

inline sharing::HelmetSharingConfig sharing_config(const std::string& id) {
  return {speaker(id), {AgentId::parse(id).value(), MapId{1}, Floor{0}}, GridGeometry{}, {}};
}

inline sharing::HelmetChannels helmet_channels(wire::LoopbackBus& bus) {
  return {bus.writer<wire::HelmetPose>(),  bus.writer<wire::HelmetScan>(),
          bus.writer<wire::TsdTile>(),     bus.writer<wire::AgentStatus>(),
          bus.reader<wire::TsdTile>(),     bus.reader<wire::MergeDirective>(),
          bus.reader<wire::AgentStatus>(), [] { return std::uint64_t{0}; }};
}

inline CoordinatorChannels coordinator_channels(wire::LoopbackBus& bus) {
  return {bus.reader<wire::TsdTile>(),       bus.reader<wire::HelmetPose>(),
          bus.reader<wire::AgentStatus>(),   bus.writer<wire::MergeDirective>(),
          bus.writer<wire::MergeEvidence>(), bus.writer<wire::AgentStatus>(),
          [] { return std::uint64_t{0}; }};
}

}  // namespace lifeline::test
