#pragma once

#include <functional>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

namespace lifeline::net {

/// Takes connections on an address. In the context's thread, once that runs; the context must be
/// stopped before this ends.
class TcpListener {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  explicit TcpListener(boost::asio::io_context& context) : acceptor_(context), retry_(context) {}

  /// Binds and listens; the error says why it could not.
  [[nodiscard]] boost::system::error_code open(const boost::asio::ip::tcp::endpoint& endpoint);
  /// Where it listens: the port is never 0.
  [[nodiscard]] boost::asio::ip::tcp::endpoint endpoint() const {
    return acceptor_.local_endpoint();
  }

  /// Hands over each connection from now on. Out of descriptors, it tries again a little later.
  void accept(std::function<void(Socket)> take);

 private:
  void accept_next();

  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer retry_;
  std::function<void(Socket)> take_;
};

}  // namespace lifeline::net
