#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/ids.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// Who saw a find, and when by its own clock.
struct Sighted {
  std::int64_t at_ns = 0;
  std::string agent_id;
  auto operator<=>(const Sighted&) const = default;
};

/// Names a detection in a mission.
using DetectionKey = std::pair<std::string, std::uint32_t>;  // agent_id, detection_id

/// One victim, person or tag as the whole fleet knows it, made of the detections of one or several
/// helmets.
struct FleetDetection {
  /// In the common frame of the directive's group with this number; empty: in the map frame of
  /// `layer`, which no group holds.
  std::optional<std::uint16_t> group;
  LayerKey layer;  ///< of the lowest of its detections; names the floor in either case
  wire::DetectionKind kind = wire::DetectionKind::victim;
  wire::DetectionState state = wire::DetectionState::reported;
  double x_m = 0.0;
  double y_m = 0.0;
  double confidence = 0.0;              ///< that it is there at all, 0 to 1
  Sighted first;                        ///< the earliest sighting; clocks of helmets may disagree
  Sighted last;                         ///< the latest
  std::vector<std::string> seen_by;     ///< ids in ascending order, each once
  std::vector<DetectionKey> made_of{};  ///< its detections, in the order of their layers
  bool operator==(const FleetDetection&) const = default;
};

/// Where a layer lies.
struct GroupPlace {
  std::uint16_t group = 0;
  wire::FixedTransform T_common_map;
};

/// Detections closer than this can be the same find. Wider than what merges and sightings are off,
/// narrower than two victims' places.
inline constexpr double kSameFindM = 1.0;

/// Detections as finds. Those of one kind in one frame and on one floor become one where all of
/// them lie within kSameFindM of each other, the closest first; two of one layer never do, since
/// their helmet told them apart. The position is the mean by confidence; the confidence that of
/// somebody being right; the state the farthest of dismissed, reported, confirmed, rescued. Ordered
/// by frame, kind and place. A pure function, in integers where the order could matter: the same on
/// every machine.
///
/// `detections` were accepted by DetectionList::apply().
[[nodiscard]] std::vector<FleetDetection> associate(
    const std::map<DetectionKey, wire::Detection>& detections,
    const std::map<LayerKey, GroupPlace>& places);

}  // namespace lifeline::sharing
