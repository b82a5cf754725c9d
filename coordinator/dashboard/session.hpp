#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "coordinator/dashboard/server.hpp"

namespace lifeline::dashboard {

class LiveSession;

/// The newest of everything that a page may be told.
struct Picture {
  TileBook book{};
  std::array<Frame, kSections> sections{};
  std::array<std::uint64_t, kSections> versions{};  ///< 0: nothing yet

  void take(Feed::News& news);
};

/// What a page sees that looks back. The player ends before what it fills.
struct Past {
  Feed feed{};
  Picture picture{};
  std::weak_ptr<LiveSession> page{};
  std::unique_ptr<LookBack> player{};

  void take_news();
};

/// What all sessions share; in the server's thread alone.
struct Hub {
  ServerOptions options;
  Feed& feed;
  Access access;
  /// Does something later, in the server's thread; from any thread.
  std::function<void(std::function<void()>)> post{};
  Picture picture{};
  std::map<std::uint64_t, std::weak_ptr<LiveSession>> live{};
  std::vector<std::shared_ptr<Past>> pasts{};  ///< those that end, too
  std::size_t connections = 0;
  std::uint64_t last_client = 0;

  /// Distributes what the coordinator put.
  void take_news();
  /// Begins a look back for a page, at the time that its order says; unavailable, for people, where
  /// there is none.
  [[nodiscard]] Result<std::shared_ptr<Past>> look_back(const std::shared_ptr<LiveSession>& page,
                                                        Role role, ClientOrder where);
  /// Lets go of those that have ended.
  void forget_pasts();
};

/// Counts a connection while it lives.
class Seat {
 public:
  explicit Seat(Hub& hub) : hub_(hub) { ++hub_.connections; }
  ~Seat() { --hub_.connections; }
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

 private:
  Hub& hub_;
};

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// One request, or several one after the other, of a browser.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(Hub& hub, boost::asio::ip::tcp::socket socket)
      : hub_(hub), seat_(std::make_shared<Seat>(hub)), stream_(std::move(socket)) {}
  void read();

 private:
  void handle();
  void go_live(Role role);
  void respond(boost::beast::http::response<boost::beast::http::string_body> response);
  void refuse(boost::beast::http::status status, const std::string& why);
  void serve_asset();

  Hub& hub_;
  std::shared_ptr<Seat> seat_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_{16 * 1024};
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  HttpRequest request_;
};

/// A page that is told what happens. One frame is under way at a time, and the next is chosen when
/// it is gone: the most urgent of what is newer than what this client got.
class LiveSession : public std::enable_shared_from_this<LiveSession> {
 public:
  LiveSession(Hub& hub, std::shared_ptr<Seat> seat, boost::beast::tcp_stream stream, Role role);
  ~LiveSession();
  void start(HttpRequest request);
  /// Something may be new.
  void pump();
  void answer(std::uint32_t request_id, const std::string& why_not);
  /// Everything that follows is live. `why`: where nobody asked for it.
  void go_live(const std::string& why);

 private:
  using WebSocket = boost::beast::websocket::stream<boost::beast::tcp_stream>;

  void read();
  void take(const boost::beast::flat_buffer& buffer);
  void watch(const Watch& wanted);
  void steer(ClientRequest request);
  void order(ClientRequest request);
  /// Whatever was told is void, but for alerts.
  void begin_anew();
  void close(boost::beast::websocket::close_code code, const char* why);
  [[nodiscard]] bool may_speak();
  [[nodiscard]] Frame next();
  [[nodiscard]] Frame newer(const Picture& picture, Section section);

  Hub& hub_;
  std::shared_ptr<Seat> seat_;
  WebSocket socket_;
  Role role_;
  std::uint64_t id_;
  boost::beast::flat_buffer buffer_{kMaxClientFrame + 512};
  Frame writing_;
  bool is_open_ = false;
  bool is_closing_ = false;
  std::deque<Frame> first_;  ///< greeting and answers
  std::array<std::uint64_t, kSections> seen_{};
  std::map<std::string, TileBook::Version> maps_{{"", 0}};
  std::shared_ptr<Past> past_;  ///< while it looks back
  double may_send_;
  std::chrono::steady_clock::time_point counted_at_ = std::chrono::steady_clock::now();
};

}  // namespace lifeline::dashboard
