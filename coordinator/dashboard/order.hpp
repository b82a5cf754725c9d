#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/sharing/alert_list.hpp"
#include "common/sharing/fleet_detection.hpp"
#include "common/wire/messages.hpp"
#include "coordinator/dashboard/timeline.hpp"
#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::dashboard {

/// The largest frame that a client may send, octets.
inline constexpr std::size_t kMaxClientFrame = 2048;
inline constexpr std::size_t kMaxWatchedMaps = 4;

/// A client's wishes, checked. The maps of Watch are the server's own business, and in a live
/// mission Steer and GoLive are; the rest goes to the coordinator.
struct Watch {
  std::vector<std::string> maps;  ///< each once; "" is the common map
};
struct RuleFind {
  sharing::DetectionKey find;
  wire::DetectionState state = wire::DetectionState::reported;
};
struct RuleMerge {
  merging::LayerPair pair;
  bool is_merged = false;
};
struct RaiseAlert {
  wire::AlertKind kind = wire::AlertKind::evacuate;
  std::string subject_id;
  std::string text;
};
struct AnswerAlert {
  sharing::AlertKey alert;
  wire::AlertState state = wire::AlertState::acknowledged;
};

struct ClientRequest {
  std::uint32_t request_id = 0;
  std::variant<Watch, RuleFind, RuleMerge, RaiseAlert, AnswerAlert, Steer, GoLive> content;
};

/// A client's frame (ClientFrame of idl/dashboard.proto). bad_data for whatever is no such thing:
/// too long, not Protobuf, nothing asked for, names that are none, states that nobody may set.
[[nodiscard]] Result<ClientRequest> decode_client_frame(std::span<const std::uint8_t> frame);

/// "alpha/1@-2", as to_string(LayerKey) writes it.
[[nodiscard]] Result<LayerKey> parse_map_name(const std::string& name);

}  // namespace lifeline::dashboard
