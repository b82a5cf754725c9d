#pragma once

#include <optional>
#include <string>

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include "idl/dashboard.pb.h"

namespace lifeline::dashboard::test {

namespace beast = boost::beast;
namespace http = beast::http;

/// A browser that may be told to lie.
class WebClient {
 public:
  using Response = http::response<http::string_body>;

  explicit WebClient(std::uint16_t port) : port_(port) { connect(); }

  void connect() {
    socket_.emplace(context_);
    socket_->next_layer().connect({boost::asio::ip::make_address("127.0.0.1"), port_});
    // A test that waits for what does not come ends.
    const timeval most{20, 0};
    setsockopt(socket_->next_layer().native_handle(), SOL_SOCKET, SO_RCVTIMEO, &most, sizeof(most));
  }

  [[nodiscard]] std::string host() const { return fmt::format("127.0.0.1:{}", port_); }

  /// Sends `target` as it stands.
  Response get(const std::string& target, http::verb verb = http::verb::get,
               std::optional<std::string> host_header = std::nullopt) {
    connect();
    http::request<http::string_body> request(verb, target, 11);
    request.set(http::field::host, host_header.value_or(host()));
    request.prepare_payload();
    http::write(socket_->next_layer(), request);
    return read_response(verb == http::verb::head);
  }

  /// Octets that are no request.
  Response send_raw(const std::string& octets) {
    connect();
    boost::asio::write(socket_->next_layer(), boost::asio::buffer(octets));
    return read_response(false);
  }

  struct Knock {
    std::string path = "/live";
    std::optional<std::string> origin{};    ///< the server's own where none is given
    std::string protocols = "lifeline.v1";  ///< none where empty
  };
  /// The status by which the server answers a WebSocket's request: 101 where it is taken.
  unsigned open(const Knock& knock) {
    connect();
    socket_->set_option(
        beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
          if (knock.origin != "")
            request.set(http::field::origin, knock.origin.value_or("http://" + host()));
          if (!knock.protocols.empty())
            request.set(http::field::sec_websocket_protocol, knock.protocols);
        }));
    boost::system::error_code error;
    socket_->handshake(host(), knock.path, error);
    if (error) return refusal(knock);
    socket_->binary(true);
    return 101;
  }

  [[nodiscard]] proto::dashboard::ServerFrame read() {
    beast::flat_buffer buffer;
    socket_->read(buffer);
    proto::dashboard::ServerFrame frame;
    const auto data = buffer.cdata();
    if (!frame.ParseFromArray(data.data(), static_cast<int>(data.size())))
      throw std::runtime_error("no ServerFrame");
    return frame;
  }
  /// The first frame of this kind.
  [[nodiscard]] proto::dashboard::ServerFrame read(
      proto::dashboard::ServerFrame::ContentCase wanted) {
    for (;;) {
      auto frame = read();
      if (frame.content_case() == wanted) return frame;
    }
  }
  void send(const std::string& octets, bool binary = true) {
    socket_->binary(binary);
    socket_->write(boost::asio::buffer(octets));
  }
  void send(const proto::dashboard::ClientFrame& frame) { send(frame.SerializeAsString()); }
  /// The code by which the server closes, after whatever else it says.
  unsigned close_code() {
    try {
      for (;;) (void)read();
    } catch (const boost::system::system_error&) {
      return socket_->reason().code;
    }
  }

 private:
  // The same request by hand: Beast's handshake keeps a refusal's status to itself.
  unsigned refusal(const Knock& knock) {
    connect();
    http::request<http::empty_body> request(http::verb::get, knock.path, 11);
    request.set(http::field::host, host());
    request.set(http::field::connection, "Upgrade");
    request.set(http::field::upgrade, "websocket");
    request.set(http::field::sec_websocket_version, "13");
    request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
    if (knock.origin != "")
      request.set(http::field::origin, knock.origin.value_or("http://" + host()));
    if (!knock.protocols.empty()) request.set(http::field::sec_websocket_protocol, knock.protocols);
    http::write(socket_->next_layer(), request);
    return read_response(false).result_int();
  }

  Response read_response(bool is_head) {
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.skip(is_head);
    boost::system::error_code error;
    http::read(socket_->next_layer(), buffer, parser, error);
    return parser.release();
  }

  std::uint16_t port_;
  boost::asio::io_context context_;
  std::optional<beast::websocket::stream<boost::asio::ip::tcp::socket>> socket_;
};

}  // namespace lifeline::dashboard::test
