#pragma once

#include "common/recording/message_tap.hpp"
#include "common/recording/mission_state.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline {

/// Has `tap` note what a coordinator hears (directives excepted, which are recorded where they are
/// followed), and what it says itself: evidence, status, alerts, rulings on finds. Before the
/// coordinator takes the channels.
void tap_channels(CoordinatorChannels& channels, MessageTap& tap);

[[nodiscard]] MissionState state_of(const Coordinator& coordinator);

}  // namespace lifeline
