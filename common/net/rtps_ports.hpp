#pragma once

#include <cstdint>
#include <utility>

namespace lifeline::net {

/// The first UDP port of a DDS domain, 0 to 232; it and the next are for multicast (RTPS 2.2,
/// section 9.6.1.1).
[[nodiscard]] int rtps_port_base(std::uint32_t domain);

/// The unicast ports of a domain's participant of this number on its machine, from 0: for
/// discovery, and for samples.
[[nodiscard]] std::pair<std::uint16_t, std::uint16_t> rtps_unicast_ports(std::uint32_t domain,
                                                                         int participant);

/// True where a UDP port can be bound by us alone.
[[nodiscard]] bool udp_port_is_free(std::uint16_t port);

}  // namespace lifeline::net
