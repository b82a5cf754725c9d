#include "common/dds/bounds.hpp"

#include <optional>
#include <string_view>

#include "common/dds/topics.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::dds {
namespace {

using namespace wire;  // the limits and messages, nothing else

/// Remembers the first field that breaks its bound.
class Bounds {
 public:
  explicit Bounds(std::string_view topic) : topic_(topic) {}

  /// `sized` is a text (no zero octet: it would end the text on the wire) or a sequence.
  template <typename Sized>
  Bounds& at_most(const Sized& sized, std::size_t bound, std::string_view field) {
    if (error_) return *this;
    if (sized.size() > bound) {
      error_ = Error{ErrorCode::bad_data, fmt::format("{}: {} has {} elements, at most {} may be "
                                                      "sent",
                                                      topic_, field, sized.size(), bound)};
    }
    if constexpr (std::is_same_v<Sized, std::string>) {
      if (!error_ && sized.find('\0') != std::string::npos) {
        error_ =
            Error{ErrorCode::bad_data, fmt::format("{}: {} holds a zero octet", topic_, field)};
      }
    }
    return *this;
  }

  Bounds& add(const Envelope& envelope) {
    at_most(envelope.mission_id, kMaxMissionIdLength, "envelope.mission_id");
    at_most(envelope.sender_id, kMaxIdLength, "envelope.sender_id");
    return at_most(envelope.signature, kMaxSignature, "envelope.signature");
  }

  Bounds& add(const LayerName& layer, std::string_view field) {
    return at_most(layer.agent_id, kMaxIdLength, field);
  }

  [[nodiscard]] Result<void> result() const {
    if (error_) return tl::unexpected<Error>(*error_);
    return {};
  }

 private:
  std::string_view topic_;
  std::optional<Error> error_;
};

template <typename Message>
Bounds bounds_of(const Message& message) {
  return Bounds(topic_of<Message>().name).add(message.envelope);
}

template <typename Tile>
Result<void> tile_bounds(const Tile& message) {
  return bounds_of(message)
      .add(message.layer, "layer.agent_id")
      .at_most(message.payload, kMaxTilePart, "payload")
      .result();
}

}  // namespace

Result<void> check_bounds(const HelmetPose& message) {
  return bounds_of(message).at_most(message.agent_id, kMaxIdLength, "agent_id").result();
}

Result<void> check_bounds(const HelmetScan& message) {
  return bounds_of(message)
      .at_most(message.agent_id, kMaxIdLength, "agent_id")
      .at_most(message.ranges_cm, kMaxScanBeams, "ranges_cm")
      .result();
}

Result<void> check_bounds(const TsdTile& message) {
  return tile_bounds(message);
}

Result<void> check_bounds(const TileCopy& message) {
  return tile_bounds(message);
}

Result<void> check_bounds(const TileRequest& message) {
  return bounds_of(message)
      .at_most(message.requester_id, kMaxIdLength, "requester_id")
      .at_most(message.asked_id, kMaxIdLength, "asked_id")
      .add(message.layer, "layer.agent_id")
      .at_most(message.held, kMaxTilesPerRequest, "held")
      .result();
}

Result<void> check_bounds(const MergeDirective& message) {
  auto bounds = bounds_of(message);
  bounds.at_most(message.mission_id, kMaxMissionIdLength, "mission_id");
  bounds.at_most(message.members, kMaxMembers, "members");
  for (const auto& member : message.members) bounds.add(member.layer, "members.layer.agent_id");
  return bounds.result();
}

Result<void> check_bounds(const DirectiveCopy& message) {
  if (auto told = check_bounds(message.directive); !told) return told;
  return bounds_of(message).at_most(message.teller_id, kMaxIdLength, "teller_id").result();
}

Result<void> check_bounds(const MergeEvidence& message) {
  return bounds_of(message)
      .add(message.a, "a.agent_id")
      .add(message.b, "b.agent_id")
      .at_most(message.reason, kMaxReason, "reason")
      .at_most(message.candidates, kMaxCandidates, "candidates")
      .result();
}

Result<void> check_bounds(const AgentStatus& message) {
  auto bounds = bounds_of(message);
  bounds.at_most(message.agent_id, kMaxIdLength, "agent_id");
  bounds.at_most(message.layers, kMaxLayers, "layers");
  bounds.at_most(message.peers_heard, kMaxPeers, "peers_heard");
  bounds.at_most(message.peers_echo_ms, kMaxPeers, "peers_echo_ms");
  for (const auto& digest : message.layers) bounds.add(digest.layer, "layers.layer.agent_id");
  for (const auto& peer : message.peers_heard) bounds.at_most(peer, kMaxIdLength, "peers_heard");
  return bounds.result();
}

Result<void> check_bounds(const Detection& message) {
  return bounds_of(message).at_most(message.agent_id, kMaxIdLength, "agent_id").result();
}

Result<void> check_bounds(const Alert& message) {
  auto bounds = bounds_of(message);
  bounds.at_most(message.issuer_id, kMaxIdLength, "issuer_id");
  bounds.at_most(message.subject_id, kMaxIdLength, "subject_id");
  bounds.at_most(message.text, kMaxAlertText, "text");
  bounds.at_most(message.acknowledged_by, kMaxPeers, "acknowledged_by");
  for (const auto& id : message.acknowledged_by) {
    bounds.at_most(id, kMaxIdLength, "acknowledged_by");
  }
  return bounds.result();
}

}  // namespace lifeline::dds
