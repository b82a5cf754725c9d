#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/files/map_picture.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/grid/stamped_pose.hpp"
#include "common/sharing/fleet_detection.hpp"
#include "common/wire/messages.hpp"

namespace lifeline {

/// Where one helmet went in one of its maps. Stamps are the recorder's.
struct HelmetTrack {
  LayerKey layer;
  std::optional<Pose2> T_common_map;        ///< where the common map holds it
  std::vector<StampedPose> poses;           ///< T_map_head
  std::vector<std::uint8_t> trust_percent;  ///< one a pose; empty where it is not known

  /// "alpha", or "alpha-2" for a helmet's second map.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] double walked_m() const;
  /// In the common frame where it has a place there, else in its map's.
  [[nodiscard]] std::vector<StampedPose> placed() const;
};

/// A map and who went about in it, by their places in MissionStory::tracks.
struct StoryMap {
  std::string name;   ///< of its files
  std::string title;  ///< for people
  OccupancyGrid grid;
  std::vector<std::size_t> tracks;
};

/// A message and when it was recorded.
template <typename Message>
struct Recorded {
  Timestamp at{};
  Message message;
};

/// What there is to tell of a mission, or of one saved map.
struct MissionStory {
  std::string mission_id;  ///< empty for a saved map
  Timestamp first{}, last{};
  std::string common_map_sha256;
  std::vector<StoryMap> maps;  ///< the common map first, then those that have no place in it
  std::vector<HelmetTrack> tracks;
  std::vector<sharing::FleetDetection> finds;
  std::vector<Recorded<wire::Alert>> alerts;          ///< every change of each
  std::vector<Recorded<wire::MergeEvidence>> merges;  ///< every change of a pair's verdict
};

/// The paths to be drawn on a map, each helmet in the same colour on all of them.
[[nodiscard]] std::vector<files::PicturePath> picture_paths(const MissionStory& story,
                                                            const StoryMap& map);

[[nodiscard]] const char* to_string(wire::AlertKind kind);
[[nodiscard]] const char* to_string(wire::AlertState state);
[[nodiscard]] const char* to_string(wire::Verdict verdict);
/// "alpha/1": a layer as a message names it.
[[nodiscard]] std::string to_text(const wire::LayerName& layer);
/// "2026-11-26 21:44:05" (UTC)
[[nodiscard]] std::string utc_text(Timestamp at);
/// "1:02:03" since the mission's beginning.
[[nodiscard]] std::string mission_time(Duration since_begin);

}  // namespace lifeline
