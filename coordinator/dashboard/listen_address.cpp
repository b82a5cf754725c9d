#include "coordinator/dashboard/listen_address.hpp"

#include <charconv>

#include <boost/asio/ip/address.hpp>
#include <fmt/format.h>

#include "common/base/printable.hpp"

namespace lifeline::dashboard {

namespace ip = boost::asio::ip;

bool ListenAddress::is_loopback() const {
  boost::system::error_code error;
  const auto parsed = ip::make_address(address, error);
  return !error && parsed.is_loopback();
}

std::string ListenAddress::text() const {
  const bool is_v6 = address.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", is_v6 ? "[" : "", address, is_v6 ? "]" : "", port);
}

Result<std::optional<ListenAddress>> parse_listen_address(std::string_view text) {
  if (text == "off") return std::nullopt;
  const auto wrong = [&] {
    return fail(ErrorCode::wrong_use,
                "dashboard address '{}' is no ADDRESS:PORT (like 127.0.0.1:{}) and not 'off'",
                printable(std::string(text)), kDefaultPort);
  };
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) return wrong();
  std::string_view host = text.substr(0, colon);
  const std::string_view digits = text.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return wrong();
  }
  ListenAddress listen;
  const auto [end, bad] =
      std::from_chars(digits.data(), digits.data() + digits.size(), listen.port);
  if (bad != std::errc() || end != digits.data() + digits.size()) return wrong();
  boost::system::error_code error;
  listen.address = ip::make_address(std::string(host), error).to_string();
  if (error) return wrong();
  return listen;
}

}  // namespace lifeline::dashboard
