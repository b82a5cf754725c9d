#include "coordinator/recording/coordinator_tap.hpp"

namespace lifeline {

void tap_channels(CoordinatorChannels& channels, MessageTap& tap) {
  tap.attach(channels.tiles);
  tap.attach(channels.poses);
  tap.attach(channels.statuses);
  tap.attach(channels.detections);
  tap.attach(channels.evidence);
  tap.attach(channels.status);
  tap.attach(channels.exchange.asked);
  tap.attach(channels.exchange.sent);
  tap.attach(channels.alerts);
  tap.attach(channels.alert);
  tap.attach(channels.ruling);
}

MissionState state_of(const Coordinator& coordinator) {
  return {coordinator.store(), coordinator.directive(), coordinator.common_map()};
}

}  // namespace lifeline
