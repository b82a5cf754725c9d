#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/recording/heard.hpp"
#include "common/recording/mission_state.hpp"
#include "common/ros2/messages.hpp"
#include "common/ros2/names.hpp"

namespace lifeline {

/// Frame of the common map, as ROS 2 tools expect it.
inline constexpr std::string_view kCommonFrame = "map";

/// The mission as ROS 2 tools read it (docs/ros2.md): `/lifeline/map`, `/tf`, and of each helmet
/// `/NAME/pose`, `/NAME/path` and `/NAME/scan`. Frames: `map` is the common frame of the group that
/// is shown, `NAME/map` a helmet's own map frame, `NAME/base_link` its head. Stamps are the
/// recorder's: helmets' clocks do not agree. One owner, not thread-safe.
class Ros2View {
 public:
  struct Config {
    Duration map_interval = std::chrono::seconds(1);
    std::optional<Duration> path_interval{};  ///< no paths without it
  };
  explicit Ros2View(Config config) : config_(config) {}

  /// What was heard of poses and scans, and then whatever is due.
  [[nodiscard]] std::vector<ros2::Message> step(const std::vector<Heard>& heard,
                                                const MissionState& state, SteadyTime now,
                                                Timestamp stamp);
  /// The common map as it is; empty while there is none, or where it is too large for one grid.
  [[nodiscard]] static std::optional<ros2::Message> map_message(const MissionState& state,
                                                                Timestamp stamp);

 private:
  struct Track {
    LayerKey layer;
    std::vector<StampedPose> poses;  ///< at least 5 cm apart
    bool changed = false;
  };

  void see(const wire::HelmetPose& pose, const MissionState& state, Timestamp stamp);
  void see(const wire::HelmetScan& scan, const MissionState& state, Timestamp stamp);
  template <typename Other>
  void see(const Other& /*other*/, const MissionState& /*state*/, Timestamp /*stamp*/) {}
  void add_transforms(const wire::LayerName& layer, const Pose2& T_map_head,
                      const MissionState& state, Timestamp stamp);
  void add_map(const MissionState& state, SteadyTime now, Timestamp stamp);
  void add_paths(SteadyTime now, Timestamp stamp);
  void note(const wire::HelmetPose& pose, Timestamp stamp);

  Config config_;
  ros2::AgentNames names_;
  std::map<std::string, Track> tracks_;
  std::vector<ros2::Message> messages_;
  SteadyTime map_due_{}, paths_due_{};
  sharing::RevisionDigest map_sent_{};  ///< what the last map was made of
};

}  // namespace lifeline
