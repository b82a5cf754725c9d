#include <algorithm>
#include <span>

#include "coordinator/dashboard/session.hpp"
#include "coordinator/dashboard/timeline.hpp"

namespace lifeline::dashboard {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

namespace {

// Answers that a client does not fetch.
constexpr std::size_t kMostWaiting = 128;

}  // namespace

LiveSession::LiveSession(Hub& hub, std::shared_ptr<Seat> seat, beast::tcp_stream stream, Role role)
    : hub_(hub),
      seat_(std::move(seat)),
      socket_(std::move(stream)),
      role_(role),
      id_(hub.last_client + 1),
      may_send_(hub.options.limits.frames_at_once) {}

LiveSession::~LiveSession() {
  if (past_ && past_->player) past_->player->end();
  hub_.live.erase(id_);
  hub_.feed.set_watchers(hub_.live.size());
}

void LiveSession::start(HttpRequest request) {
  beast::get_lowest_layer(socket_).expires_never();
  websocket::stream_base::timeout limits{hub_.options.limits.http_timeout,
                                         hub_.options.limits.live_timeout, true};
  socket_.set_option(limits);
  socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
    response.set(beast::http::field::sec_websocket_protocol, "lifeline.v1");
  }));
  socket_.read_message_max(kMaxClientFrame);
  socket_.binary(true);
  auto kept = std::make_shared<HttpRequest>(std::move(request));
  socket_.async_accept(*kept, [self = shared_from_this(), kept](error_code error) {
    if (error) return;
    self->is_open_ = true;
    self->first_.push_back(std::make_shared<const std::string>(
        hello_frame(self->hub_.options.greeting, self->role_ == Role::commander)));
    self->read();
    self->pump();
  });
}

void LiveSession::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) {  // gone, or a frame beyond the limit: the closing frame says so already
      self->is_closing_ = true;
      return;
    }
    self->take(self->buffer_);
    self->buffer_.clear();
    if (!self->is_closing_) self->read();
  });
}

void LiveSession::take(const beast::flat_buffer& buffer) {
  if (!may_speak()) return close(websocket::close_code::policy_error, "too many frames");
  if (!socket_.got_binary())
    return close(websocket::close_code::unknown_data, "only binary frames");
  const auto data = buffer.cdata();
  auto request =
      decode_client_frame(std::span(static_cast<const std::uint8_t*>(data.data()), data.size()));
  if (!request) return close(websocket::close_code::bad_payload, "not understood");
  if (const auto* wanted = std::get_if<Watch>(&request->content)) {
    watch(*wanted);
    return answer(request->request_id, "");
  }
  if (hub_.options.look_back) {
    if (std::holds_alternative<Steer>(request->content)) return steer(*std::move(request));
    if (std::holds_alternative<GoLive>(request->content)) {
      go_live("");
      return answer(request->request_id, "");
    }
  }
  order(*std::move(request));
}

void LiveSession::order(ClientRequest request) {
  const std::uint32_t request_id = request.request_id;
  if (role_ != Role::commander) return answer(request_id, "this page may only look");
  // What is shown of the past is no ground for an order; alerts are those of now.
  if (past_ && !std::holds_alternative<AnswerAlert>(request.content))
    return answer(request_id, "this page looks back: go back to live first");
  if (!hub_.feed.put(ClientOrder{id_, std::move(request)}))
    answer(request_id, "too many orders wait already; try again");
}

void LiveSession::steer(ClientRequest request) {
  const std::uint32_t request_id = request.request_id;
  if (past_) {
    if (!past_->feed.put(ClientOrder{id_, std::move(request)}))
      answer(request_id, "too many orders wait already; try again");
    return;
  }
  if (!std::get<Steer>(request.content).to)
    return answer(request_id, "this mission is live: say which time to go to");
  auto past = hub_.look_back(shared_from_this(), role_, {id_, std::move(request)});
  if (!past) return answer(request_id, past.error().text);
  past_ = *std::move(past);
  begin_anew();
}

void LiveSession::go_live(const std::string& why) {
  if (!past_) return;
  past_->player->end();
  past_->page.reset();
  past_.reset();
  begin_anew();
  first_.push_back(std::make_shared<const std::string>(live_frame(why)));
  pump();
}

void LiveSession::begin_anew() {
  for (std::size_t i = 0; i < kSections; ++i) {
    if (static_cast<Section>(i) != Section::alerts) seen_[i] = 0;
  }
  for (auto& [map, seen] : maps_) seen = 0;
}

void LiveSession::watch(const Watch& wanted) {
  std::map<std::string, TileBook::Version> maps;
  for (const auto& map : wanted.maps) {
    const auto held = maps_.find(map);
    maps[map] = held == maps_.end() ? 0 : held->second;
  }
  maps_ = std::move(maps);
}

bool LiveSession::may_speak() {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> since = now - counted_at_;
  counted_at_ = now;
  const auto& limits = hub_.options.limits;
  may_send_ = std::min(limits.frames_at_once, may_send_ + since.count() * limits.frames_per_s);
  if (may_send_ < 1.0) return false;
  may_send_ -= 1.0;
  return true;
}

void LiveSession::answer(std::uint32_t request_id, const std::string& why_not) {
  if (first_.size() >= kMostWaiting)
    return close(websocket::close_code::policy_error, "answers are not fetched");
  first_.push_back(std::make_shared<const std::string>(answer_frame(request_id, why_not)));
  pump();
}

void LiveSession::close(websocket::close_code code, const char* why) {
  if (is_closing_) return;
  is_closing_ = true;
  socket_.async_close({code, why}, [self = shared_from_this()](error_code) {});
}

Frame LiveSession::next() {
  if (!first_.empty()) {
    Frame frame = std::move(first_.front());
    first_.pop_front();
    return frame;
  }
  // Alerts are of now, wherever a page looks.
  if (auto frame = newer(hub_.picture, Section::alerts)) return frame;
  const Picture& shown = past_ ? past_->picture : hub_.picture;
  if (past_) {
    // It knows that it looks back before it sees anything of that time.
    if (auto frame = newer(shown, Section::timeline)) return frame;
    if (seen_[static_cast<std::size_t>(Section::timeline)] == 0) return nullptr;
  }
  for (std::size_t i = 0; i < kSections; ++i) {
    if (static_cast<Section>(i) == Section::alerts) continue;
    if (auto frame = newer(shown, static_cast<Section>(i))) return frame;
  }
  TileBook& book = past_ ? past_->picture.book : hub_.picture.book;
  for (auto& [map, seen] : maps_) {
    if (auto frame = book.next_frame(map, seen, hub_.options.limits.tile_frame)) return frame;
  }
  return nullptr;
}

Frame LiveSession::newer(const Picture& picture, Section section) {
  const auto i = static_cast<std::size_t>(section);
  if (seen_[i] == picture.versions[i]) return nullptr;
  seen_[i] = picture.versions[i];
  return picture.sections[i];
}

void LiveSession::pump() {
  if (!is_open_ || is_closing_ || writing_) return;
  writing_ = next();
  if (!writing_) return;
  socket_.async_write(boost::asio::buffer(*writing_),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        self->writing_.reset();
                        if (error) {
                          self->is_closing_ = true;
                          return;
                        }
                        self->pump();
                      });
}

}  // namespace lifeline::dashboard
