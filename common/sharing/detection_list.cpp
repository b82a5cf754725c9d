#include "common/sharing/detection_list.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "common/sharing/accept.hpp"

namespace lifeline::sharing {
namespace {

constexpr double kFarthestM = 2000.0;  // as the directive's transforms

Result<void> check(const wire::Detection& detection) {
  const auto layer = to_layer_key({detection.agent_id, detection.map_id, detection.floor});
  if (!layer) return forward_error(layer);
  const bool is_somewhere =
      std::abs(detection.x_m) <= kFarthestM && std::abs(detection.y_m) <= kFarthestM;
  if (!is_somewhere || !(detection.confidence >= 0.0F && detection.confidence <= 1.0F)) {
    return fail(ErrorCode::bad_data,
                "detection {}/{}: place ({}, {}) m or confidence {} out of bounds",
                detection.agent_id, detection.detection_id, detection.x_m, detection.y_m,
                detection.confidence);
  }
  if (detection.kind > wire::DetectionKind::uwb_tag ||
      detection.state > wire::DetectionState::rescued ||
      detection.first_seen_at_ns > detection.seen_at_ns) {
    return fail(ErrorCode::bad_data,
                "detection {}/{}: no such kind or state, or seen before it was first seen",
                detection.agent_id, detection.detection_id);
  }
  return {};
}

/// Which of two samples of one detection is the newer. Two of one revision, which no honest helmet
/// sends, are told apart all the same, so that all machines hold the same one.
auto age(const wire::Detection& d) {
  return std::tuple(d.revision, d.seen_at_ns, d.first_seen_at_ns, d.map_id, d.floor, d.kind,
                    d.state, d.x_m, d.y_m, d.confidence);
}

using Held = std::map<DetectionKey, wire::Detection>;

Result<void> make_room(Held& held, const DetectionKey& key) {
  constexpr auto kMostPerHelmet = DetectionList::kMostPerHelmet, kMost = DetectionList::kMost;
  // The helmet's own lot first, then all together: the highest key goes, which may be the new one.
  const auto first = held.lower_bound({key.first, 0});
  const auto behind = held.upper_bound({key.first, std::numeric_limits<std::uint32_t>::max()});
  const bool full_lot = static_cast<std::size_t>(std::distance(first, behind)) >= kMostPerHelmet;
  if (!full_lot && held.size() < kMost) return {};
  const auto highest = std::prev(full_lot ? behind : held.end());
  if (highest->first < key) {
    return fail(ErrorCode::unsupported, "detection {}/{}: more than {} of one helmet, or {} in all",
                key.first, key.second, kMostPerHelmet, kMost);
  }
  held.erase(highest);
  return {};
}

}  // namespace

Result<bool> DetectionList::take_in(Held& held, const wire::Detection& detection) {
  const DetectionKey key{detection.agent_id, detection.detection_id};
  const auto found = held.find(key);
  if (found != held.end()) {
    if (age(detection) <= age(found->second)) return false;
    found->second = detection;
    return true;
  }
  if (auto room = make_room(held, key); !room) return forward_error(room);
  held.emplace(key, detection);
  return true;
}

Result<bool> DetectionList::apply(const wire::Detection& detection) {
  if (auto sound = check(detection); !sound) return forward_error(sound);
  const bool is_ruling = detection.envelope.sender_id != detection.agent_id;
  return take_in(is_ruling ? rulings_ : held_, detection);
}

std::vector<FleetDetection> DetectionList::list() const {
  if (rulings_.empty()) return associate(held_, places_);
  Held ruled = held_;
  for (const auto& [key, ruling] : rulings_) {
    // Where the helmet's own sample was missed (both share a key, and readers keep one), what was
    // ruled on says as much.
    const auto found = ruled.try_emplace(key, ruling).first;
    if (ruling.state != wire::DetectionState::reported) found->second.state = ruling.state;
  }
  return associate(ruled, places_);
}

void DetectionList::follow(const wire::MergeDirective& directive) {
  places_.clear();
  for (const auto& member : directive.members) {
    if (auto key = to_layer_key(member.layer)) {
      places_.emplace(*std::move(key), GroupPlace{member.group, member.T_common_map});
    }
  }
}

}  // namespace lifeline::sharing
