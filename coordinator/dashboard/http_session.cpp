#include <algorithm>

#include <boost/beast/version.hpp>
#include <fmt/format.h>

#include "coordinator/dashboard/session.hpp"

namespace lifeline::dashboard {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

namespace {

constexpr std::string_view kProtocol = "lifeline.v1";
constexpr std::string_view kTokenPrefix = "token.";
constexpr std::uint32_t kMaxHeader = 8 * 1024;

std::string_view view(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

/// What a WebSocket's request offers as subprotocols.
struct Offered {
  bool speaks_ours = false;
  std::string_view token;
};

Offered offered(std::string_view header) {
  Offered offer;
  while (!header.empty()) {
    const auto comma = header.find(',');
    std::string_view each = header.substr(0, comma);
    header = comma == std::string_view::npos ? std::string_view() : header.substr(comma + 1);
    while (!each.empty() && each.front() == ' ') each.remove_prefix(1);
    while (!each.empty() && each.back() == ' ') each.remove_suffix(1);
    if (each == kProtocol) offer.speaks_ours = true;
    if (each.starts_with(kTokenPrefix)) offer.token = each.substr(kTokenPrefix.size());
  }
  return offer;
}

template <typename Fields>
void set_safe_headers(Fields& response, std::string_view host) {
  // Nothing from elsewhere, no inline script: a name that holds markup stays a name.
  response.set(
      "Content-Security-Policy",
      fmt::format("default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' "
                  "data:; font-src 'self'; connect-src 'self' ws://{}; base-uri 'none'; "
                  "form-action 'none'; frame-ancestors 'none'",
                  host));
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-cache");
}

}  // namespace

void HttpSession::read() {
  parser_.emplace();
  parser_->header_limit(kMaxHeader);
  parser_->body_limit(0);
  stream_.expires_after(hub_.options.limits.http_timeout);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](error_code error, std::size_t) {
                     if (error == http::error::end_of_stream || error == beast::error::timeout)
                       return;
                     if (error) {
                       self->request_ = {};
                       self->request_.keep_alive(false);
                       // A peer that is gone hears nothing of it.
                       self->refuse(http::status::bad_request, "not understood");
                       return;
                     }
                     self->request_ = self->parser_->release();
                     self->handle();
                   });
}

void HttpSession::handle() {
  const auto host = view(request_[http::field::host]);
  if (!hub_.access.is_our_host(host)) {
    return refuse(http::status::misdirected_request, "this server has another address");
  }
  if (!beast::websocket::is_upgrade(request_)) return serve_asset();
  const auto path = view(request_.target());
  if (path != "/live" && path != "/watch") return refuse(http::status::not_found, "no such page");
  if (!hub_.access.is_our_origin(view(request_[http::field::origin]), host))
    return refuse(http::status::forbidden, "only this server's own page may connect");
  const auto offer = offered(view(request_[http::field::sec_websocket_protocol]));
  if (!offer.speaks_ours) return refuse(http::status::bad_request, "offer subprotocol lifeline.v1");
  const auto role =
      hub_.access.admit(path == "/live" ? Role::commander : Role::viewer, offer.token);
  if (!role) return refuse(http::status::unauthorized, "this needs a token");
  if (hub_.live.size() >= hub_.options.limits.watchers)
    return refuse(http::status::service_unavailable, "too many pages are open");
  go_live(*role);
}

void HttpSession::go_live(Role role) {
  auto session = std::make_shared<LiveSession>(hub_, std::move(seat_), std::move(stream_), role);
  hub_.live.emplace(++hub_.last_client, session);
  hub_.feed.set_watchers(hub_.live.size());
  session->start(std::move(request_));
}

void HttpSession::serve_asset() {
  if (request_.method() != http::verb::get && request_.method() != http::verb::head)
    return refuse(http::status::method_not_allowed, "only GET");
  // Looked up as it came, never as a path of files; what stands behind '?' is the page's own.
  std::string_view path = view(request_.target());
  path = path.substr(0, path.find('?'));
  if (path == "/") path = "/index.html";
  const auto asset = std::find_if(hub_.options.assets.begin(), hub_.options.assets.end(),
                                  [&](const Asset& each) { return each.path == path; });
  if (asset == hub_.options.assets.end()) return refuse(http::status::not_found, "no such page");
  http::response<http::string_body> response(http::status::ok, request_.version());
  response.set(http::field::content_type,
               boost::beast::string_view(asset->type.data(), asset->type.size()));
  if (request_.method() == http::verb::get) {
    response.body().assign(reinterpret_cast<const char*>(asset->bytes.data()), asset->bytes.size());
    response.prepare_payload();
  } else {
    response.content_length(asset->bytes.size());
  }
  respond(std::move(response));
}

void HttpSession::refuse(http::status status, const std::string& why) {
  http::response<http::string_body> response(status, 11);
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  if (status == http::status::method_not_allowed) response.set(http::field::allow, "GET, HEAD");
  response.body() = why + "\n";
  response.prepare_payload();
  respond(std::move(response));
}

void HttpSession::respond(http::response<http::string_body> response) {
  const auto host = view(request_[http::field::host]);
  set_safe_headers(response, hub_.access.is_our_host(host) ? host : std::string_view("localhost"));
  response.keep_alive(request_.keep_alive() && response.result() == http::status::ok);
  auto kept = std::make_shared<http::response<http::string_body>>(std::move(response));
  const bool is_head = request_.method() == http::verb::head;
  auto serializer = std::make_shared<http::response_serializer<http::string_body>>(*kept);
  serializer->split(is_head);
  const auto done = [self = shared_from_this(), kept, serializer](error_code error, std::size_t) {
    if (!error && kept->keep_alive()) return self->read();
    error_code ignored;
    self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  };
  if (is_head) {
    http::async_write_header(stream_, *serializer, done);
  } else {
    http::async_write(stream_, *serializer, done);
  }
}

}  // namespace lifeline::dashboard
