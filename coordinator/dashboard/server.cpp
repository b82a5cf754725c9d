#include "coordinator/dashboard/server.hpp"

#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include "common/base/log.hpp"
#include "common/net/tcp_listener.hpp"
#include "coordinator/dashboard/session.hpp"

namespace lifeline::dashboard {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

constexpr int kSendBuffer = 256 * 1024;

}  // namespace

struct Server::Core {
  Core(ServerOptions options, Feed& feed)
      : hub{.options = std::move(options), .feed = feed, .access = Access({})} {}

  [[nodiscard]] Result<void> open();
  void run();
  void accept();

  // Sessions end with the context, in whose handlers they hang, and count in the hub.
  Hub hub;
  asio::io_context context{1};
  net::TcpListener listener{context};
  std::jthread thread;
};

Result<void> Server::Core::open() {
  ListenAddress& listen = hub.options.listen;
  error_code error;
  const asio::ip::tcp::endpoint endpoint(asio::ip::make_address(listen.address, error),
                                         listen.port);
  if (!error) error = listener.open(endpoint);
  if (error) {
    return fail(ErrorCode::unavailable,
                "dashboard: cannot open {}: {}; give another ADDRESS:PORT with --dashboard, or off",
                listen.text(), error.message());
  }
  listen.port = listener.endpoint().port();
  hub.access = Access(listen);
  hub.post = [this](std::function<void()> work) { asio::post(context, std::move(work)); };
  return {};
}

void Server::Core::accept() {
  listener.accept([this](asio::ip::tcp::socket socket) {
    // A little at a time, so that what a slow page gets is not old, and its pongs are not late.
    error_code ignored;
    socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
    if (hub.connections < hub.options.limits.connections)
      std::make_shared<HttpSession>(hub, std::move(socket))->read();
  });
}

void Server::Core::run() {
  try {
    context.run();
  } catch (const std::exception& failed) {
    spdlog::error("dashboard: ended: {}", failed.what());  // the mission goes on without a page
  }
}

Result<std::unique_ptr<Server>> Server::open(ServerOptions options, Feed& feed) {
  auto core = std::make_unique<Core>(std::move(options), feed);
  if (auto opened = core->open(); !opened) return forward_error(opened);
  Core& at_work = *core;
  feed.set_wake(
      [&at_work] { asio::post(at_work.context, [&at_work] { at_work.hub.take_news(); }); });
  at_work.accept();
  at_work.thread = std::jthread([&at_work] { at_work.run(); });
  return std::unique_ptr<Server>(new Server(std::move(core)));
}

Server::Server(std::unique_ptr<Core> core) : core_(std::move(core)) {}

Server::~Server() {
  core_->hub.feed.set_wake({});
  core_->hub.feed.set_watchers(0);
  core_->context.stop();
  core_->thread.join();
  // Who plays the past wakes the context: it ends before that.
  for (const auto& past : core_->hub.pasts) past->player.reset();
}

const ListenAddress& Server::listen() const {
  return core_->hub.options.listen;
}

const Access& Server::access() const {
  return core_->hub.access;
}

}  // namespace lifeline::dashboard
