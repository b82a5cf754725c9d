#pragma once

#include <cstdint>
#include <functional>

#include "common/base/result.hpp"
#include "common/net/rtps_ports.hpp"

namespace lifeline::demo {

/// Says whether nobody on this machine holds a UDP port.
using PortProbe = std::function<bool(std::uint16_t)>;

/// A DDS domain that no participant on this machine uses, out of 20 to 99 (below, people choose by
/// hand; above, the ports are those that the kernel hands out), tried in turn from a place that
/// `salt` picks. A domain is taken where one of its two multicast ports or one of the unicast ports
/// of its first `participants` participants is (RTPS 2.2, section 9.6.1.1). unavailable when all
/// are taken.
[[nodiscard]] Result<std::uint32_t> pick_free_domain(
    std::uint64_t salt, int participants, const PortProbe& is_free = net::udp_port_is_free);

}  // namespace lifeline::demo
