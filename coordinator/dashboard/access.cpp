#include "coordinator/dashboard/access.hpp"

#include <boost/asio/ip/address.hpp>
#include <fmt/format.h>

#include "common/base/ids.hpp"

namespace lifeline::dashboard {
namespace {

std::string draw_token() {
  return fmt::format("{:016x}{:016x}", random_incarnation().value, random_incarnation().value);
}

// Takes as long whatever the difference is.
bool same(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

}  // namespace

Access::Access(ListenAddress listen) : listen_(std::move(listen)) {
  if (listen_.is_loopback()) return;
  commander_token_ = draw_token();
  viewer_token_ = draw_token();
}

bool Access::is_our_host(std::string_view host) const {
  const std::string port = fmt::format(":{}", listen_.port);
  if (host == listen_.text()) return true;
  if (!host.ends_with(port)) return false;
  std::string_view name = host.substr(0, host.size() - port.size());
  if (listen_.is_loopback()) return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
  if (name.size() > 2 && name.front() == '[' && name.back() == ']')
    name = name.substr(1, name.size() - 2);
  boost::system::error_code error;
  const auto any = boost::asio::ip::make_address(listen_.address, error);
  if (error || !any.is_unspecified()) return false;
  // Bound to all of the machine's addresses: any of them, but no name.
  (void)boost::asio::ip::make_address(std::string(name), error);
  return !error;
}

bool Access::is_our_origin(std::string_view origin, std::string_view host) const {
  return is_our_host(host) && origin == fmt::format("http://{}", host);
}

std::optional<Role> Access::admit(Role wanted, std::string_view token) const {
  if (!needs_token()) return wanted;
  if (same(token, commander_token_)) return wanted;
  if (wanted == Role::viewer && same(token, viewer_token_)) return wanted;
  return std::nullopt;
}

}  // namespace lifeline::dashboard
