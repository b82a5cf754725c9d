#include "common/doctor/check_network.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <system_error>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lifeline::doctor {
namespace {

constexpr int kUdpHeaders = 28;  // IPv4 and UDP
const std::string kInterfaceCheck = "interface";

int mtu_of(const std::string& name) {
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (handle < 0) return 0;
  ifreq request{};
  name.copy(static_cast<char*>(request.ifr_name), IFNAMSIZ - 1);
  const int mtu = ioctl(handle, SIOCGIFMTU, &request) == 0 ? request.ifr_mtu : 0;
  close(handle);
  return mtu;
}

std::string text_of(const sockaddr* address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const auto* v4 = reinterpret_cast<const sockaddr_in*>(address);
  return inet_ntop(AF_INET, &v4->sin_addr, text.data(), text.size()) == nullptr ? "" : text.data();
}

NetworkInterface describe(const ifaddrs& entry) {
  const auto has = [&](unsigned flag) { return (entry.ifa_flags & flag) != 0; };
  return {entry.ifa_name,
          {},
          has(IFF_UP) && has(IFF_RUNNING),
          has(IFF_LOOPBACK),
          has(IFF_MULTICAST),
          mtu_of(entry.ifa_name)};
}

bool is_named(const NetworkInterface& interface, const std::string& wanted) {
  return interface.name == wanted ||
         std::ranges::find(interface.addresses, wanted) != interface.addresses.end();
}

// What is wrong with one interface that is to carry the mission.
Finding judge(const NetworkInterface& interface, const dds::ProfileFacts& profile) {
  const std::string facts =
      fmt::format("{}, MTU {}", fmt::join(interface.addresses, " "), interface.mtu_octets);
  if (!interface.is_up) {
    return fault(
        kInterfaceCheck, interface.name, facts + ", but down or without a link",
        fmt::format("plug the cable in, join the radio network, or: sudo ip link set {} up",
                    interface.name));
  }
  if (profile.multicast_discovery && !interface.has_multicast && !interface.is_loopback) {
    return fault(kInterfaceCheck, interface.name,
                 facts + ", without multicast, by which others are found",
                 fmt::format("sudo ip link set {} multicast on, or name the others' addresses in "
                             "initialPeersList of the QoS profiles",
                             interface.name));
  }
  const auto datagram = static_cast<int>(profile.max_message_octets) + kUdpHeaders;
  if (interface.mtu_octets > 0 && datagram > interface.mtu_octets) {
    return warning(kInterfaceCheck, interface.name,
                   fmt::format("{}, but datagrams of up to {} octets: one lost fragment loses all",
                               facts, datagram),
                   fmt::format("maxMessageSize {} in the QoS profiles of all machines, or a larger "
                               "MTU",
                               interface.mtu_octets - kUdpHeaders));
  }
  return ok(kInterfaceCheck, interface.name,
            fmt::format("up, {}{}", facts, interface.has_multicast ? ", multicast" : ""));
}

Findings judge_named(const dds::ProfileFacts& profile,
                     const std::vector<NetworkInterface>& interfaces) {
  Findings found;
  for (const std::string& wanted : profile.interfaces) {
    const auto at = std::ranges::find_if(
        interfaces, [&](const auto& interface) { return is_named(interface, wanted); });
    found.push_back(at != interfaces.end()
                        ? judge(*at, profile)
                        : fault(kInterfaceCheck, wanted,
                                "no interface of this machine has this address, which the QoS "
                                "profiles keep to",
                                "correct interfaceWhiteList in the QoS profiles; `ip address` "
                                "lists what there is"));
  }
  return found;
}

Findings check_limit(const std::filesystem::path& root, const std::string& name,
                     std::uint32_t wanted) {
  const std::filesystem::path file = root / "proc/sys/net/core" / name;
  std::uint64_t granted = 0;
  const std::string where = "net.core." + name;
  if (!(std::ifstream(file) >> granted)) {
    return {warning("buffers", where, fmt::format("{} cannot be read", file.string()),
                    "look with: sysctl " + where)};
  }
  if (granted >= wanted)
    return {ok("buffers", where, fmt::format("{} octets, {} asked for", granted, wanted))};
  return {warning(
      "buffers", where,
      fmt::format("{} octets, but the QoS profiles ask for {}: bursts are lost and "
                  "repaired",
                  granted, wanted),
      fmt::format("sudo sysctl -w {}={} (and in /etc/sysctl.d to keep it)", where, wanted))};
}

}  // namespace

Result<std::vector<NetworkInterface>> read_interfaces() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) {
    return fail(ErrorCode::unavailable, "network interfaces: {}; look with: ip address",
                std::generic_category().message(errno));
  }
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, freeifaddrs);
  std::vector<NetworkInterface> interfaces;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    auto known = std::ranges::find(interfaces, entry->ifa_name, &NetworkInterface::name);
    if (known == interfaces.end()) known = interfaces.insert(known, describe(*entry));
    known->addresses.push_back(text_of(entry->ifa_addr));
  }
  return interfaces;
}

Findings check_interfaces(const dds::ProfileFacts& profile,
                          const std::vector<NetworkInterface>& interfaces) {
  if (!profile.udp) return {};
  if (!profile.interfaces.empty()) return judge_named(profile, interfaces);
  Findings found;
  bool reaches_others = false;
  for (const NetworkInterface& interface : interfaces) {
    if (interface.is_loopback) continue;
    found.push_back(judge(interface, profile));
    reaches_others = reaches_others || found.back().level != Level::fault;
  }
  // One of several that is down hurts nobody.
  for (Finding& finding : found) {
    if (reaches_others && finding.level == Level::fault) finding.level = Level::warning;
  }
  if (found.empty()) {
    found.push_back(fault(kInterfaceCheck, "all",
                          "none but loopback has an IPv4 address: no other machine "
                          "is reached",
                          "join the network, or take config/qos/loopback.xml for one machine "
                          "alone"));
  }
  return found;
}

Findings check_counted_interface(const std::string& name,
                                 const std::vector<NetworkInterface>& interfaces) {
  if (name == "none") return {};
  const auto at = std::ranges::find(interfaces, name, &NetworkInterface::name);
  if (at != interfaces.end()) return {ok(kInterfaceCheck, name, "its counter holds the budget")};
  return {fault(kInterfaceCheck, name,
                "sharing.interface names it, but no such interface has an address here",
                "correct sharing.interface; `ip address` lists what there is")};
}

Findings check_socket_buffers(const dds::ProfileFacts& profile, const std::filesystem::path& root) {
  if (!profile.udp) return {};
  Findings found;
  if (profile.receive_buffer_octets > 0)
    append(found, check_limit(root, "rmem_max", profile.receive_buffer_octets));
  if (profile.send_buffer_octets > 0)
    append(found, check_limit(root, "wmem_max", profile.send_buffer_octets));
  return found;
}

}  // namespace lifeline::doctor
