#pragma once

#include <string>

#include "coordinator/export/geo_anchor.hpp"
#include "coordinator/export/mission_story.hpp"

namespace lifeline {

/// The first map with what belongs to it as GeoJSON (RFC 7946): a MultiLineString of the walls, a
/// LineString for each path, a Point for each find in the map's frame. Each feature's property
/// `what` is wall, path or detection.
[[nodiscard]] std::string to_geojson(const MissionStory& story, const GeoAnchor& anchor);

}  // namespace lifeline
