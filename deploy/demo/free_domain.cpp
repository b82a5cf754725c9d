#include "deploy/demo/free_domain.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lifeline::demo {
namespace {

constexpr std::uint32_t kFirstDomain = 20;
constexpr std::uint32_t kDomains = 80;

bool domain_is_free(std::uint32_t domain, int participants, const PortProbe& is_free) {
  const auto base = static_cast<int>(7400 + 250 * domain);
  const auto free_at = [&](int port) { return is_free(static_cast<std::uint16_t>(port)); };
  if (!free_at(base) || !free_at(base + 1)) return false;
  for (int i = 0; i < participants; ++i) {
    if (!free_at(base + 10 + 2 * i) || !free_at(base + 11 + 2 * i)) return false;
  }
  return true;
}

}  // namespace

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

Result<std::uint32_t> pick_free_domain(std::uint64_t salt, int participants,
                                       const PortProbe& is_free) {
  for (std::uint32_t step = 0; step < kDomains; ++step) {
    const auto domain = static_cast<std::uint32_t>(kFirstDomain + (salt + step) % kDomains);
    if (domain_is_free(domain, participants, is_free)) return domain;
  }
  return fail(ErrorCode::unavailable,
              "DDS domains {} to {} are all in use on this machine: stop some of their programs",
              kFirstDomain, kFirstDomain + kDomains - 1);
}

}  // namespace lifeline::demo
