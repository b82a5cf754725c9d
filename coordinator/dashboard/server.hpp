#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "common/base/result.hpp"
#include "coordinator/dashboard/access.hpp"
#include "coordinator/dashboard/feed.hpp"
#include "coordinator/dashboard/frames.hpp"
#include "coordinator/dashboard/listen_address.hpp"
#include "coordinator/dashboard/look_back.hpp"

namespace lifeline::dashboard {

/// A file of the page.
struct Asset {
  std::string_view path;  ///< "/index.html"
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::span<const std::uint8_t> bytes;
};

struct ServerLimits {
  std::size_t connections = 48;  ///< of all kinds
  std::size_t watchers = 16;     ///< live ones
  std::size_t look_backs = 2;    ///< pages that look back at once, one of them a commander's
  double frames_per_s = 20;      ///< that a client may send, on average
  double frames_at_once = 40;
  std::size_t tile_frame = 128 * 1024;  ///< about the largest frame of tiles, octets
  std::chrono::seconds http_timeout{10};
  std::chrono::seconds live_timeout{20};  ///< without a sign of life
};

struct ServerOptions {
  ListenAddress listen;
  std::span<const Asset> assets;
  Greeting greeting;
  ServerLimits limits;
  /// Of a mission that goes on. Without it Steer goes to who feeds the pages, all of them alike.
  OpenLookBack look_back{};
};

/// The page and its live frames, in a thread of its own. Whatever a client does or fails to do, the
/// feed's other side never waits. Paths: the assets; /live for who may command, /watch for who only
/// looks (WebSockets, subprotocol `lifeline.v1`; the token as a second one, `token.HEX`).
class Server {
 public:
  /// Opens the port. unavailable where it is taken or not ours to open: what, where, what to do.
  [[nodiscard]] static Result<std::unique_ptr<Server>> open(ServerOptions options, Feed& feed);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// With the port that was really opened.
  [[nodiscard]] const ListenAddress& listen() const;
  [[nodiscard]] const Access& access() const;

 private:
  struct Core;
  explicit Server(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

}  // namespace lifeline::dashboard
