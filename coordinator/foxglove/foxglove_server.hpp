#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/ros2/messages.hpp"

namespace lifeline::foxglove {

struct ServerOptions {
  std::string name;                   ///< shown to people
  std::string address = "127.0.0.1";  ///< who may connect: by default this machine alone
  std::uint16_t port = 8765;          ///< 0: any that is free
  /// Pages that may connect besides those of this machine, as browsers name them, e.g.
  /// `https://app.foxglove.dev`. Programs that are no browser name none and may.
  std::vector<std::string> origins;
};

/// Shows ROS 2 messages to Foxglove and Lichtblick (docs/ros2.md). Runs in a thread of its own;
/// nothing that a client does, or fails to do, holds up who sends. What a client cannot take in
/// time is left out for it.
class FoxgloveServer {
 public:
  /// unavailable where the port is taken or the address is none of this machine, with what to do.
  [[nodiscard]] static Result<std::unique_ptr<FoxgloveServer>> start(ServerOptions options);

  virtual ~FoxgloveServer() = default;

  /// Hands over messages, to whoever has subscribed; never waits. A topic is advertised with its
  /// first message, and its newest map is kept for who comes later.
  virtual void send(Timestamp stamp, std::vector<ros2::Message> messages) = 0;
  /// Where clients connect.
  [[nodiscard]] virtual std::uint16_t port() const = 0;
};

}  // namespace lifeline::foxglove
