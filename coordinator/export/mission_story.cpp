#include "coordinator/export/mission_story.hpp"

#include <ctime>

#include <fmt/format.h>

namespace lifeline {

std::string HelmetTrack::name() const {
  return layer.map_id.value <= 1 ? layer.agent_id.text()
                                 : fmt::format("{}-{}", layer.agent_id.text(), layer.map_id.value);
}

double HelmetTrack::walked_m() const {
  constexpr double kStepM = 0.05;  // less is the noise of standing still
  double walked_m = 0.0;
  Eigen::Vector2d last = poses.empty() ? Eigen::Vector2d{0.0, 0.0} : poses[0].pose.translation();
  for (const StampedPose& at : poses) {
    const double step_m = (at.pose.translation() - last).norm();
    if (step_m < kStepM) continue;
    walked_m += step_m;
    last = at.pose.translation();
  }
  return walked_m;
}

std::vector<StampedPose> HelmetTrack::placed() const {
  if (!T_common_map) return poses;
  std::vector<StampedPose> placed = poses;
  for (StampedPose& at : placed) at.pose = *T_common_map * at.pose;
  return placed;
}

std::vector<files::PicturePath> picture_paths(const MissionStory& story, const StoryMap& map) {
  std::vector<files::PicturePath> paths;
  for (const std::size_t track : map.tracks) {
    files::PicturePath path{story.tracks[track].name(), {}, track};
    for (const StampedPose& at : story.tracks[track].placed())
      path.points.push_back(at.pose.translation());
    paths.push_back(std::move(path));
  }
  return paths;
}

const char* to_string(wire::AlertKind kind) {
  switch (kind) {
    case wire::AlertKind::mayday:
      return "mayday";
    case wire::AlertKind::evacuate:
      return "evacuate";
    case wire::AlertKind::roll_call:
      return "roll call";
  }
  return "unknown";
}

const char* to_string(wire::AlertState state) {
  switch (state) {
    case wire::AlertState::raised:
      return "raised";
    case wire::AlertState::acknowledged:
      return "acknowledged";
    case wire::AlertState::cleared:
      return "cleared";
  }
  return "unknown";
}

const char* to_string(wire::Verdict verdict) {
  switch (verdict) {
    case wire::Verdict::accepted:
      return "accepted";
    case wire::Verdict::wait:
      return "wait";
    case wire::Verdict::rejected:
      return "rejected";
  }
  return "unknown";
}

std::string to_text(const wire::LayerName& layer) {
  return fmt::format("{}/{}", layer.agent_id, layer.map_id);
}

std::string utc_text(Timestamp at) {
  const std::time_t seconds =
      std::chrono::floor<std::chrono::seconds>(at.time_since_epoch()).count();
  std::tm utc{};
  if (::gmtime_r(&seconds, &utc) == nullptr) return "?";
  char text[64];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &utc)};
}

std::string mission_time(Duration since_begin) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since_begin).count();
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

}  // namespace lifeline
