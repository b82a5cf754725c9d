#include "common/net/rtps_ports.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lifeline::net {

int rtps_port_base(std::uint32_t domain) {
  return static_cast<int>(7400 + 250 * domain);
}

std::pair<std::uint16_t, std::uint16_t> rtps_unicast_ports(std::uint32_t domain, int participant) {
  const int first = rtps_port_base(domain) + 10 + 2 * participant;
  return {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(first + 1)};
}

bool udp_port_is_free(std::uint16_t port) {
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (handle < 0) return false;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(port);
  const bool bound = bind(handle, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(handle);
  return bound;
}

}  // namespace lifeline::net
