#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/dds/profile_facts.hpp"
#include "common/doctor/finding.hpp"

namespace lifeline::doctor {

/// Whether a program finds a place in a DDS domain of this machine: how many others are in it,
/// whether a port is left for it on which it is found, and whether the kernel hands the domain's
/// ports out to others (proc/sys/net/ipv4/ip_local_port_range below `root`).
[[nodiscard]] Findings check_domain(std::uint32_t domain, const dds::ProfileFacts& profile,
                                    const std::filesystem::path& root);

/// Whether a TCP port of an address of this machine can be listened on; `what` says what for, e.g.
/// "dashboard". Port 0 is any free one.
[[nodiscard]] Findings check_tcp_port(const std::string& check, const std::string& address,
                                      std::uint16_t port, const std::string& advice);

}  // namespace lifeline::doctor
