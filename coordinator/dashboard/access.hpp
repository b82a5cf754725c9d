#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "coordinator/dashboard/listen_address.hpp"

namespace lifeline::dashboard {

/// What a connection may do.
enum class Role { viewer, commander };

/// Who may look and who may command. On the loopback interface everybody who can reach it; anywhere
/// else who shows one of two tokens. Immutable.
class Access {
 public:
  /// Draws tokens from the operating system's random source where the address needs them.
  explicit Access(ListenAddress listen);

  /// Whether a request's Host header names this server: an address of its own and its port. A name
  /// that somebody's DNS server made ours is none.
  [[nodiscard]] bool is_our_host(std::string_view host) const;
  /// Whether a page of `origin` came from where `host` points, over this server.
  [[nodiscard]] bool is_our_origin(std::string_view origin, std::string_view host) const;
  /// What a connection may do that asks for `wanted` and shows `token`; empty: nothing.
  [[nodiscard]] std::optional<Role> admit(Role wanted, std::string_view token) const;

  [[nodiscard]] bool needs_token() const { return !commander_token_.empty(); }
  /// 32 hexadecimal digits; empty where none is needed.
  [[nodiscard]] const std::string& commander_token() const { return commander_token_; }
  [[nodiscard]] const std::string& viewer_token() const { return viewer_token_; }

 private:
  ListenAddress listen_;
  std::string commander_token_;
  std::string viewer_token_;
};

}  // namespace lifeline::dashboard
