#pragma once

#include <functional>
#include <string>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/wire/loopback.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::test {

/// What the fleets that run in one process have in common.
inline constexpr double kAmple = 1e9;  ///< bit/s: no budget holds anything back
inline constexpr Duration kTick = std::chrono::milliseconds(100);

inline sharing::Speaker speaker(const std::string& id) {
  return {AgentId::parse(id).value(), kMission, Incarnation{std::hash<std::string>{}(id) | 1U}};
}

inline sharing::HelmetSharingConfig sharing_config(const std::string& id) {
  return {
      speaker(id), {AgentId::parse(id).value(), MapId{1}, Floor{0}}, GridGeometry{}, {}, kAmple};
}

/// Publishes every change at once and as it is: for drills that are about something else.
inline sharing::HelmetSharingConfig eager_sharing_config(const std::string& id) {
  sharing::HelmetSharingConfig config = sharing_config(id);
  config.publisher = {{std::chrono::milliseconds(500), 0.0, 0.0, 0.0}, false};
  return config;
}

/// `Bus`: a LoopbackBus, or what has its reader() and writer().
template <typename Bus>
sharing::ExchangeChannels exchange_channels(Bus& bus) {
  return {bus.template writer<wire::TileRequest>(), bus.template reader<wire::TileRequest>(),
          bus.template writer<wire::TileCopy>(), bus.template reader<wire::TileCopy>()};
}

template <typename Bus>
sharing::HelmetChannels helmet_channels(Bus& bus) {
  return {bus.template writer<wire::HelmetPose>(),
          bus.template writer<wire::HelmetScan>(),
          bus.template writer<wire::TsdTile>(),
          bus.template writer<wire::AgentStatus>(),
          bus.template writer<wire::Detection>(),
          bus.template reader<wire::TsdTile>(),
          bus.template reader<wire::MergeDirective>(),
          bus.template reader<wire::AgentStatus>(),
          bus.template reader<wire::Detection>(),
          exchange_channels(bus),
          {bus.template writer<wire::DirectiveCopy>(), bus.template reader<wire::DirectiveCopy>()},
          [] { return std::uint64_t{0}; },
          [] { return std::uint64_t{0}; },
          bus.template reader<wire::Alert>(),
          bus.template writer<wire::Alert>(),
          bus.template reader<wire::HelmetPose>()};
}

}  // namespace lifeline::test
