#include "deploy/demo/free_domain.hpp"

namespace lifeline::demo {
namespace {

constexpr std::uint32_t kFirstDomain = 20;
constexpr std::uint32_t kDomains = 80;

bool domain_is_free(std::uint32_t domain, int participants, const PortProbe& is_free) {
  const int base = net::rtps_port_base(domain);
  const auto free_at = [&](int port) { return is_free(static_cast<std::uint16_t>(port)); };
  if (!free_at(base) || !free_at(base + 1)) return false;
  for (int i = 0; i < participants; ++i) {
    const auto [meta, user] = net::rtps_unicast_ports(domain, i);
    if (!is_free(meta) || !is_free(user)) return false;
  }
  return true;
}

}  // namespace

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
