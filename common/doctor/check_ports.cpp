#include "common/doctor/check_ports.hpp"

#include <fstream>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <fmt/format.h>

#include "common/net/rtps_ports.hpp"
#include "common/net/tcp_listener.hpp"

namespace lifeline::doctor {
namespace {

const std::string kDomainCheck = "domain";

Findings check_port_range(std::uint32_t domain, int last_port, const std::string& where,
                          const std::filesystem::path& root) {
  const std::filesystem::path file = root / "proc/sys/net/ipv4/ip_local_port_range";
  int lowest = 0, highest = 0;
  if (!(std::ifstream(file) >> lowest >> highest)) return {};
  const int first_port = net::rtps_port_base(domain);
  if (last_port < lowest || first_port > highest) return {};
  return {warning(kDomainCheck, where,
                  fmt::format("its ports {} to {} lie among those that the kernel hands out ({} to "
                              "{}): another program may happen to hold one",
                              first_port, last_port, lowest, highest),
                  "take a domain below 100")};
}

}  // namespace

Findings check_domain(std::uint32_t domain, const dds::ProfileFacts& profile,
                      const std::filesystem::path& root) {
  const std::string where = fmt::format("DDS domain {}", domain);
  // Beyond this range participants on ports are not called by others, unless by multicast.
  constexpr int kByMulticast = 100;
  const int places =
      profile.multicast_discovery ? kByMulticast : static_cast<int>(profile.peers_range);
  int taken = 0;
  for (int i = 0; i < places; ++i) {
    const auto [meta, user] = net::rtps_unicast_ports(domain, i);
    taken += net::udp_port_is_free(meta) && net::udp_port_is_free(user) ? 0 : 1;
  }
  Findings found = check_port_range(
      domain, net::rtps_unicast_ports(domain, places > 0 ? places - 1 : 0).second, where, root);
  if (taken >= places) {
    found.push_back(fault(kDomainCheck, where,
                          fmt::format("all {} places on this machine are taken", places),
                          "end programs that are not needed, or take another domain on all "
                          "machines"));
  } else if (taken == 0) {
    found.push_back(ok(kDomainCheck, where, "no other program of this machine is in it"));
  } else {
    found.push_back(
        ok(kDomainCheck, where,
           fmt::format("{} other program{} of this machine in it, {} place{} left", taken,
                       taken == 1 ? "" : "s", places - taken, places - taken == 1 ? "" : "s")));
  }
  return found;
}

Findings check_tcp_port(const std::string& check, const std::string& address, std::uint16_t port,
                        const std::string& advice) {
  const std::string where = fmt::format("{}:{}", address, port);
  boost::system::error_code error;
  const auto parsed = boost::asio::ip::make_address(address, error);
  if (error) return {fault(check, where, "is no IP address", advice)};
  boost::asio::io_context context;
  net::TcpListener listener(context);
  if (error = listener.open({parsed, port}); error)
    return {fault(check, where, error.message(), advice)};
  return {ok(check, where, "free")};
}

}  // namespace lifeline::doctor
