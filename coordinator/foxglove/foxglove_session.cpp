#include "coordinator/foxglove/foxglove_session.hpp"

#include <algorithm>

namespace lifeline::foxglove {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;

constexpr auto kHandshakeTime = std::chrono::seconds(10);

/// A page that this machine serves itself.
bool is_local(std::string_view origin) {
  for (const std::string_view host : {"://localhost", "://127.0.0.1", "://[::1]"}) {
    const auto at = origin.find(host);
    if (at == std::string_view::npos ||
        (origin.substr(0, at) != "http" && origin.substr(0, at) != "https"))
      continue;
    const std::string_view rest = origin.substr(at + host.size());
    if (rest.empty() || rest.front() == ':') return true;
  }
  return origin == "file://";
}

std::string_view to_view(beast::string_view text) {
  return {text.data(), text.size()};
}

}  // namespace

Session::Session(boost::asio::ip::tcp::socket socket, std::shared_ptr<Stage> stage)
    : stream_(std::move(socket)), stage_(std::move(stage)) {
  ++stage_->sessions;
}

Session::~Session() {
  --stage_->sessions;
}

void Session::start() {
  beast::get_lowest_layer(stream_).expires_after(kHandshakeTime);
  http::async_read(stream_.next_layer(), buffer_, request_,
                   [self = shared_from_this()](error_code error, std::size_t) {
                     if (error) {
                       self->closed_ = true;
                     } else {
                       self->accept();
                     }
                   });
}

bool Session::may_connect() const {
  const std::string_view origin = to_view(request_[http::field::origin]);
  return origin.empty() || is_local(origin) ||
         std::find(stage_->origins.begin(), stage_->origins.end(), origin) != stage_->origins.end();
}

void Session::accept() {
  if (!websocket::is_upgrade(request_))
    return refuse(http::status::upgrade_required, "this is a WebSocket for Foxglove\n");
  if (!may_connect())
    return refuse(http::status::forbidden, "this page may not connect; see foxglove.origins\n");
  const std::string protocol(
      choose_subprotocol(to_view(request_[http::field::sec_websocket_protocol])));
  if (protocol.empty())
    return refuse(http::status::bad_request,
                  "offer the subprotocol foxglove.sdk.v1 or foxglove.websocket.v1\n");
  beast::get_lowest_layer(stream_).expires_never();
  stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  stream_.set_option(
      websocket::stream_base::decorator([protocol](websocket::response_type& response) {
        response.set(http::field::sec_websocket_protocol, protocol);
      }));
  stream_.read_message_max(kMostRequest);
  buffer_.clear();
  stream_.async_accept(request_, [self = shared_from_this()](error_code error) {
    self->closed_ = bool(error);
    if (error) return;
    self->open_ = true;
    self->send_text(server_info(self->stage_->name, self->stage_->session_id));
    self->advertise(self->stage_->channels);
    self->read();
  });
}

void Session::refuse(http::status status, const std::string& reason) {
  auto response = std::make_shared<http::response<http::string_body>>(status, request_.version());
  response->set(http::field::content_type, "text/plain");
  response->body() = reason;
  response->keep_alive(false);
  response->prepare_payload();
  closed_ = true;
  http::async_write(stream_.next_layer(), *response,
                    [self = shared_from_this(), response](error_code, std::size_t) {
                      error_code ignored;
                      self->stream_.next_layer().socket().shutdown(
                          boost::asio::ip::tcp::socket::shutdown_send, ignored);
                    });
}

void Session::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) {
      self->closed_ = true;
      return;
    }
    if (self->stream_.got_text()) self->take(beast::buffers_to_string(self->buffer_.data()));
    self->buffer_.consume(self->buffer_.size());
    self->read();
  });
}

void Session::take(const std::string& text) {
  const auto request = read_request(text);
  if (!request) return send_text(warning(request.error().text));
  for (const std::uint32_t id : request->unsubscribe) subscriptions_.erase(id);
  for (const auto& [id, channel] : request->subscribe) {
    if (subscriptions_.size() >= kMostSubscriptions)
      return send_text(warning("too many subscriptions"));
    subscriptions_[id] = channel;
    const auto newest = stage_->newest.find(channel);
    if (newest != stage_->newest.end()) send(id, *newest->second);
  }
}

void Session::advertise(const std::vector<Channel>& channels) {
  if (open_ && !channels.empty()) send_text(foxglove::advertise(channels));
}

void Session::publish(const PublishedPtr& message) {
  if (!open_ || closed_) return;
  for (const auto& [id, channel] : subscriptions_) {
    if (channel == message->channel.id) send(id, *message);
  }
}

void Session::send(std::uint32_t subscription, const Published& message) {
  enqueue({message_data(subscription, message.stamp, message.payload), false});
}

void Session::send_text(const std::string& text) {
  enqueue({{text.begin(), text.end()}, true});
}

void Session::enqueue(Frame frame) {
  // Who reads too slowly misses messages: the newest come again.
  if (waiting_octets_ + frame.octets.size() > kMostWaiting && !waiting_.empty()) return;
  waiting_octets_ += frame.octets.size();
  waiting_.push_back(std::move(frame));
  if (waiting_.size() == 1) write();
}

void Session::write() {
  const Frame& frame = waiting_.front();
  stream_.text(frame.text);
  stream_.async_write(boost::asio::buffer(frame.octets),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (error) {
                          self->closed_ = true;
                          return;
                        }
                        self->waiting_octets_ -= self->waiting_.front().octets.size();
                        self->waiting_.pop_front();
                        if (!self->waiting_.empty()) self->write();
                      });
}

}  // namespace lifeline::foxglove
