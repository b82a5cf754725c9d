#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "common/base/time.hpp"
#include "coordinator/foxglove/protocol.hpp"

namespace lifeline::foxglove {

/// A message that was handed over, shared by all clients.
struct Published {
  Channel channel;
  Timestamp stamp;
  std::vector<std::uint8_t> payload;
  bool kept = false;  ///< a map: the newest is for who comes later, too
};
using PublishedPtr = std::shared_ptr<const Published>;

/// What all sessions know; the server's thread alone.
struct Stage {
  std::string name;
  std::string session_id;
  std::vector<std::string> origins;
  std::vector<Channel> channels;
  std::map<std::uint32_t, PublishedPtr> newest;  ///< by channel, of those that are kept
  std::size_t sessions = 0;
};

/// One client. Lives as long as one of its operations is under way.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(boost::asio::ip::tcp::socket socket, std::shared_ptr<Stage> stage);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void start();
  /// Gone, or on its way.
  [[nodiscard]] bool closed() const { return closed_; }
  void advertise(const std::vector<Channel>& channels);
  void publish(const PublishedPtr& message);

 private:
  static constexpr std::size_t kMostRequest = 64 * 1024;
  static constexpr std::size_t kMostSubscriptions = 1'000;
  static constexpr std::size_t kMostWaiting = 32 * 1024 * 1024;  ///< octets

  struct Frame {
    std::vector<std::uint8_t> octets;
    bool text = false;
  };

  void accept();
  [[nodiscard]] bool may_connect() const;
  void refuse(boost::beast::http::status status, const std::string& reason);
  void read();
  void take(const std::string& text);
  void send(std::uint32_t subscription, const Published& message);
  void send_text(const std::string& text);
  void enqueue(Frame frame);
  void write();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  std::shared_ptr<Stage> stage_;
  boost::beast::flat_buffer buffer_{kMostRequest};
  boost::beast::http::request<boost::beast::http::empty_body> request_;
  std::map<std::uint32_t, std::uint32_t> subscriptions_;  ///< channel by subscription
  std::deque<Frame> waiting_;                             ///< the first one is being written
  std::size_t waiting_octets_ = 0;
  bool open_ = false, closed_ = false;
};

}  // namespace lifeline::foxglove
