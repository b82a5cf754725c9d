#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/result.hpp"

namespace lifeline::dashboard {

/// The port of the page where none is given.
inline constexpr std::uint16_t kDefaultPort = 8642;

/// Where the page is served.
struct ListenAddress {
  std::string address = "127.0.0.1";  ///< an IP address
  std::uint16_t port = kDefaultPort;  ///< 0: any free one
  bool operator==(const ListenAddress&) const = default;

  /// Only programs of this machine can reach it.
  [[nodiscard]] bool is_loopback() const;
  /// "127.0.0.1:8642", "[::1]:8642": as it stands in a browser's address.
  [[nodiscard]] std::string text() const;
};

/// `ADDRESS:PORT`, `[V6]:PORT` or `off` (empty). wrong_use where it is none of them.
[[nodiscard]] Result<std::optional<ListenAddress>> parse_listen_address(std::string_view text);

}  // namespace lifeline::dashboard
