#pragma once

#include "common/recording/mission_recording.hpp"
#include "coordinator/dashboard/look_back.hpp"

namespace lifeline {

/// How pages look back at a mission while it is recorded: each by a replay of its own of what was
/// recorded so far, in a thread of low priority. `recording`: nullptr where nothing is recorded;
/// else it outlives the pages.
[[nodiscard]] dashboard::OpenLookBack look_back_at(MissionRecording* recording);

}  // namespace lifeline
