#include "coordinator/foxglove/foxglove_server.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <fmt/format.h>

#include "common/base/ids.hpp"
#include "common/net/tcp_listener.hpp"
#include "coordinator/foxglove/foxglove_session.hpp"

namespace lifeline::foxglove {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kMostSessions = 16;
constexpr std::size_t kMostChannels = 1'000;
constexpr std::size_t kMostHandedOver = 2'000;  // messages that the thread has not taken yet

class Server final : public FoxgloveServer {
 public:
  explicit Server(ServerOptions options) {
    stage_->name = std::move(options.name);
    stage_->origins = std::move(options.origins);
    stage_->session_id = fmt::format("{:016x}", random_incarnation().value);
  }
  ~Server() override {
    context_.stop();
    if (thread_.joinable()) thread_.join();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  Result<void> listen(const std::string& address, std::uint16_t port) {
    error_code error;
    const auto host = asio::ip::make_address(address, error);
    if (error) {
      return fail(ErrorCode::wrong_use, "foxglove.address {}: is no IP address; give 127.0.0.1",
                  address);
    }
    error = listener_.open(tcp::endpoint(host, port));
    if (error) {
      return fail(ErrorCode::unavailable,
                  "Foxglove: cannot listen on {}:{} ({}); choose another foxglove.port or address",
                  address, port, error.message());
    }
    port_ = listener_.endpoint().port();
    accept();
    thread_ = std::thread([this] { context_.run(); });
    return {};
  }

  void send(Timestamp stamp, std::vector<ros2::Message> messages) override {
    if (messages.empty() || handed_over_ + messages.size() > kMostHandedOver) return;
    handed_over_ += messages.size();
    asio::post(context_, [this, stamp, messages = std::move(messages)]() mutable {
      handed_over_ -= messages.size();
      for (ros2::Message& message : messages) publish(stamp, std::move(message));
    });
  }
  [[nodiscard]] std::uint16_t port() const override { return port_; }

 private:
  void accept() {
    listener_.accept([this](tcp::socket socket) {
      std::erase_if(sessions_, [](const auto& session) {
        const auto alive = session.lock();
        return alive == nullptr || alive->closed();
      });
      if (stage_->sessions >= kMostSessions) return;
      const auto session = std::make_shared<Session>(std::move(socket), stage_);
      sessions_.push_back(session);
      session->start();
    });
  }

  void publish(Timestamp stamp, ros2::Message message) {
    auto channel = std::find_if(stage_->channels.begin(), stage_->channels.end(),
                                [&](const Channel& each) { return each.topic == message.topic; });
    if (channel == stage_->channels.end()) {
      if (stage_->channels.size() >= kMostChannels) return;
      const auto id = static_cast<std::uint32_t>(stage_->channels.size() + 1);
      stage_->channels.push_back({id, message.topic, message.type});
      channel = std::prev(stage_->channels.end());
      each_session([&](Session& session) { session.advertise({*channel}); });
    }
    const auto published = std::make_shared<const Published>(
        Published{*channel, stamp, std::move(message.cdr), message.type == ros2::kOccupancyGrid});
    if (published->kept) stage_->newest[channel->id] = published;
    each_session([&](Session& session) { session.publish(published); });
  }

  template <typename Do>
  void each_session(const Do& act) {
    for (const auto& weak : sessions_) {
      if (const auto session = weak.lock(); session != nullptr) act(*session);
    }
  }

  std::shared_ptr<Stage> stage_ = std::make_shared<Stage>();
  std::vector<std::weak_ptr<Session>> sessions_;
  std::atomic<std::size_t> handed_over_{0};
  std::uint16_t port_ = 0;
  asio::io_context context_{1};
  net::TcpListener listener_{context_};
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<FoxgloveServer>> FoxgloveServer::start(ServerOptions options) {
  const std::string address = options.address;
  const std::uint16_t port = options.port;
  auto server = std::make_unique<Server>(std::move(options));
  if (auto listening = server->listen(address, port); !listening) return forward_error(listening);
  return server;
}

}  // namespace lifeline::foxglove
