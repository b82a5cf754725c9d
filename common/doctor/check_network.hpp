#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/dds/profile_facts.hpp"
#include "common/doctor/finding.hpp"

namespace lifeline::doctor {

/// A network interface with an IPv4 address.
struct NetworkInterface {
  std::string name;
  std::vector<std::string> addresses;  ///< IPv4, "10.0.0.11"
  bool is_up = false;                  ///< switched on, and its link is there
  bool is_loopback = false;
  bool has_multicast = false;
  int mtu_octets = 0;
};

/// Those of this machine, in its order. unavailable where the system does not say.
[[nodiscard]] Result<std::vector<NetworkInterface>> read_interfaces();

/// Whether some interface carries what the profile asks for: those that it names, or any; up, with
/// multicast where others are found by that, and datagrams that fit whole.
[[nodiscard]] Findings check_interfaces(const dds::ProfileFacts& profile,
                                        const std::vector<NetworkInterface>& interfaces);

/// Whether there is the interface whose counter holds a helmet's budget; `none`: nothing to find.
[[nodiscard]] Findings check_counted_interface(const std::string& name,
                                               const std::vector<NetworkInterface>& interfaces);

/// Whether the kernel grants the socket buffers that the profile asks for
/// (proc/sys/net/core/{r,w}mem_max below `root`).
[[nodiscard]] Findings check_socket_buffers(const dds::ProfileFacts& profile,
                                            const std::filesystem::path& root);

}  // namespace lifeline::doctor
