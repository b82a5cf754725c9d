#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::foxglove {

// Foxglove's WebSocket protocol, version 1: JSON texts, and messages as octets.

/// The subprotocols that clients ask for: the same thing under two names.
inline constexpr std::string_view kSubprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// The one of ours that a client offers in its list; empty where there is none.
[[nodiscard]] std::string_view choose_subprotocol(std::string_view offered);

struct Channel {
  std::uint32_t id = 0;
  std::string topic;
  std::string type;
};

[[nodiscard]] std::string server_info(std::string_view name, std::string_view session_id);
[[nodiscard]] std::string advertise(const std::vector<Channel>& channels);
/// Tells a client what it did wrong.
[[nodiscard]] std::string warning(std::string_view text);
/// A message, for the subscription that a client chose a number for.
[[nodiscard]] std::vector<std::uint8_t> message_data(std::uint32_t subscription, Timestamp stamp,
                                                     const std::vector<std::uint8_t>& payload);

/// What a client asked for, out of a text that may be anything.
struct Request {
  struct Subscription {
    std::uint32_t id = 0;
    std::uint32_t channel = 0;
  };
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;
};
/// bad_data for what is no JSON object with a text `op`, and for lists that hold anything else than
/// they should. Other operations than these two ask for nothing.
[[nodiscard]] Result<Request> read_request(std::string_view text);

}  // namespace lifeline::foxglove
