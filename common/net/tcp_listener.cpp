#include "common/net/tcp_listener.hpp"

#include <chrono>
#include <utility>

namespace lifeline::net {

namespace asio = boost::asio;
using boost::system::error_code;

error_code TcpListener::open(const asio::ip::tcp::endpoint& endpoint) {
  error_code error;
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  return error;
}

void TcpListener::accept(std::function<void(Socket)> take) {
  take_ = std::move(take);
  accept_next();
}

void TcpListener::accept_next() {
  acceptor_.async_accept([this](error_code error, Socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {
      // Out of descriptors, most likely: again when some are free.
      retry_.expires_after(std::chrono::milliseconds(200));
      retry_.async_wait([this](error_code stopped) {
        if (!stopped) accept_next();
      });
      return;
    }
    take_(std::move(socket));
    accept_next();
  });
}

}  // namespace lifeline::net
