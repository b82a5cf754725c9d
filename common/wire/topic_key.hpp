#pragma once

#include <tuple>
#include <utility>

#include "common/wire/messages.hpp"

namespace lifeline::wire {

// The key of every topic: samples of one key replace one another (docs/topics.md; @key in
// idl/*.idl).

[[nodiscard]] inline auto topic_key(const HelmetPose& m) {
  return std::tuple(m.agent_id);
}
[[nodiscard]] inline auto topic_key(const HelmetScan& m) {
  return std::tuple(m.agent_id);
}
[[nodiscard]] inline auto topic_key(const TsdTile& m) {
  return std::tuple(m.layer.agent_id, m.layer.map_id, m.layer.floor, m.tile_x, m.tile_y, m.part);
}
[[nodiscard]] inline auto topic_key(const TileCopy& m) {
  return topic_key(static_cast<const TsdTile&>(m));
}
[[nodiscard]] inline auto topic_key(const TileRequest& m) {
  return std::tuple(m.requester_id);
}
[[nodiscard]] inline auto topic_key(const MergeDirective& m) {
  return std::tuple(m.mission_id);
}
[[nodiscard]] inline auto topic_key(const DirectiveCopy& m) {
  return std::tuple(m.teller_id);
}
[[nodiscard]] inline auto topic_key(const MergeEvidence& m) {
  return std::tuple(m.a, m.b);
}
[[nodiscard]] inline auto topic_key(const AgentStatus& m) {
  return std::tuple(m.agent_id);
}
[[nodiscard]] inline auto topic_key(const Detection& m) {
  return std::tuple(m.agent_id, m.detection_id);
}
[[nodiscard]] inline auto topic_key(const Alert& m) {
  return std::tuple(m.issuer_id, m.alert_id);
}

template <typename Message>
using TopicKey = decltype(topic_key(std::declval<const Message&>()));

/// Whether a reader that comes late is told the newest sample of every key (transient local).
template <typename Message>
inline constexpr bool kReachesLateReaders = true;
template <>
inline constexpr bool kReachesLateReaders<HelmetPose> = false;
template <>
inline constexpr bool kReachesLateReaders<HelmetScan> = false;
template <>
inline constexpr bool kReachesLateReaders<TileRequest> = false;
template <>
inline constexpr bool kReachesLateReaders<TileCopy> = false;
template <>
inline constexpr bool kReachesLateReaders<DirectiveCopy> = false;

}  // namespace lifeline::wire
