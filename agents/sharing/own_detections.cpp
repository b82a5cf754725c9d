#include "agents/sharing/own_detections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lifeline::sharing {

/// The find that the sighting belongs to; all().size() where it is a new one.
std::size_t OwnDetections::nearest(const MapSighting& sighting) const {
  std::size_t nearest = detections_.size();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < detections_.size(); ++i) {
    if (detections_[i].kind != sighting.kind) continue;
    const double sigma_m = std::sqrt(sighting.sigma_m * sighting.sigma_m + 1.0 / information_[i]);
    const double distance_m = (detections_[i].p_map_m - sighting.p_map_m).norm();
    const double gate_m = std::clamp(kSameFindSigmas * sigma_m, kSameFindM, kOtherFindM);
    if (distance_m > gate_m || distance_m >= nearest_m) continue;
    nearest = i;
    nearest_m = distance_m;
  }
  return nearest;
}

/// The place of a new find; all().size() where there is none.
std::size_t OwnDetections::new_find(const MapSighting& sighting) {
  std::size_t place = detections_.size();
  if (place < kMost) {
    detections_.emplace_back();
    information_.push_back(0.0);
  } else {
    for (std::size_t i = 0; i < detections_.size(); ++i) {
      if (detections_[i].sightings >= kLeastSightings) continue;
      if (place == kMost || detections_[i].seen < detections_[place].seen) place = i;
    }
    if (place == kMost) return place;
    information_[place] = 0.0;
  }
  detections_[place] = {.number = static_cast<std::uint32_t>(place),
                        .kind = sighting.kind,
                        .first_seen = sighting.stamp,
                        .seen = sighting.stamp};
  return place;
}

void OwnDetections::note(const MapSighting& sighting) {
  if (!sighting.p_map_m.allFinite() || !(sighting.sigma_m > 0.0) ||
      !std::isfinite(sighting.sigma_m) || !std::isfinite(sighting.confidence)) {
    return;
  }
  std::size_t place = nearest(sighting);
  if (place == detections_.size()) place = new_find(sighting);
  if (place == detections_.size()) return;
  OwnDetection& find = detections_[place];
  const double information = 1.0 / (sighting.sigma_m * sighting.sigma_m);
  information_[place] += information;
  find.p_map_m += information / information_[place] * (sighting.p_map_m - find.p_map_m);
  const double share = kShareOfEach * std::clamp(sighting.confidence, 0.0, 1.0);
  find.confidence = std::min(1.0 - (1.0 - find.confidence) * (1.0 - share), kMostConfidence);
  find.seen = std::max(find.seen, sighting.stamp);
  ++find.sightings;
}

wire::Detection to_wire(const OwnDetection& own, const LayerKey& layer, std::uint8_t start) {
  static_assert(OwnDetections::kMost <= 1U << 8);
  wire::Detection sample;
  sample.agent_id = layer.agent_id.text();
  sample.detection_id = layer.map_id.value << 16 | std::uint32_t{start} << 8 | own.number;
  sample.revision = own.sightings;
  sample.map_id = layer.map_id.value;
  sample.floor = layer.floor.value;
  sample.kind = own.kind;
  sample.x_m = own.p_map_m.x();
  sample.y_m = own.p_map_m.y();
  sample.confidence = static_cast<float>(own.confidence);
  sample.first_seen_at_ns = own.first_seen.time_since_epoch().count();
  sample.seen_at_ns = own.seen.time_since_epoch().count();
  return sample;
}

}  // namespace lifeline::sharing
