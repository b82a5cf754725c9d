#pragma once

#include <filesystem>

#include "common/base/result.hpp"
#include "coordinator/export/mission_story.hpp"

namespace lifeline {

/// What a recording tells, replayed to its end. Errors as Replay::open().
[[nodiscard]] Result<MissionStory> story_of_recording(const std::filesystem::path& bag);

/// What a saved map tells: NAME.lifemap, with its trajectory, or NAME.yaml of ROS map_server.
[[nodiscard]] Result<MissionStory> story_of_map(const std::filesystem::path& file);

}  // namespace lifeline
