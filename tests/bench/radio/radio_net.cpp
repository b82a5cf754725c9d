#include "tests/bench/radio/radio_net.hpp"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace lifeline::bench {
namespace {

/// Runs a shell command whose words we made ourselves; its output is the error's text.
Result<std::string> run(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return fail(ErrorCode::unavailable, "cannot start a shell");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  if (pclose(pipe) != 0) {
    while (!output.empty() && output.back() == '\n') output.pop_back();
    return fail(ErrorCode::unavailable, "{}: {}", command, output);
  }
  return output;
}

Result<void> run_all(const std::vector<std::string>& commands) {
  for (const std::string& command : commands) {
    if (auto done = run(command); !done) return forward_error(done);
  }
  return {};
}

}  // namespace

Result<RadioNet> RadioNet::make(int hosts) {
  RadioNet net(hosts, fmt::format("lifeline{}", getpid()));
  if (auto up = net.set_up(); !up) return forward_error(up);
  return net;
}

RadioNet::RadioNet(RadioNet&& other) noexcept
    : hosts_(other.hosts_), name_(std::exchange(other.name_, {})) {}

RadioNet::~RadioNet() {
  if (name_.empty()) return;
  for (int host = 1; host <= hosts_; ++host)
    (void)run(fmt::format("ip netns del {}", host_name(host)));
  (void)run(fmt::format("ip netns del {}air", name_));
}

std::string RadioNet::host_name(int host) const {
  return fmt::format("{}h{}", name_, host);
}

Result<void> RadioNet::set_up() {
  const std::string air = name_ + "air";
  if (auto up = run_all({"nft --version", "tc -V", fmt::format("ip netns add {}", air),
                         fmt::format("ip -n {} link add near type bridge mcast_snooping 0", air),
                         fmt::format("ip -n {} link add far type bridge mcast_snooping 0", air),
                         fmt::format("ip -n {} link set near up", air),
                         fmt::format("ip -n {} link set far up", air)});
      !up) {
    return up;
  }
  for (int host = 1; host <= hosts_; ++host) {
    const std::string name = host_name(host);
    if (auto up = run_all({fmt::format("ip netns add {}", name),
                           fmt::format("ip -n {} link set lo up", name),
                           fmt::format("ip link add w0 netns {} type veth peer name p{} netns {}",
                                       name, host, air),
                           fmt::format("ip -n {} addr add 10.77.0.{}/24 dev w0", name, host),
                           fmt::format("ip -n {} link set w0 up", name),
                           fmt::format("ip -n {} route add 224.0.0.0/4 dev w0", name),
                           fmt::format("ip -n {} link set p{} master near", air, host),
                           fmt::format("ip -n {} link set p{} up", air, host)});
        !up) {
      return up;
    }
  }
  return {};
}

Result<void> RadioNet::set_loss(double share) {
  const int permille = static_cast<int>(1000.0 * share + 0.5);
  for (int host = 1; host <= hosts_; ++host) {
    const std::string inside = fmt::format("ip netns exec {} nft", host_name(host));
    (void)run(inside + " delete table netdev radio");  // there is none the first time
    if (permille == 0) continue;
    const std::string rules = fmt::format(
        "table netdev radio {{ chain arriving {{ type filter hook ingress device w0 priority 0; "
        "numgen random mod 1000 < {} drop; }}; }};",
        permille);
    if (auto set = run(fmt::format("{} '{}'", inside, rules)); !set) return forward_error(set);
  }
  return {};
}

Result<void> RadioNet::set_rate(int host, std::uint32_t kbit_s) {
  const std::string inside = fmt::format("ip netns exec {} tc qdisc", host_name(host));
  (void)run(inside + " del dev w0 root");
  if (kbit_s == 0) return {};
  return run_all(
      {fmt::format("{} add dev w0 root tbf rate {}kbit burst 16kb latency 200ms", inside, kbit_s)});
}

Result<void> RadioNet::cut(int from, int to) {
  return run_all({fmt::format(
      "ip netns exec {} nft 'table netdev oneway {{ chain arriving {{ type filter hook ingress "
      "device w0 priority 1; ip saddr 10.77.0.{} drop; }}; }};'",
      host_name(to), from)});
}

Result<void> RadioNet::restore(int to) {
  return run_all({fmt::format("ip netns exec {} nft delete table netdev oneway", host_name(to))});
}

Result<void> RadioNet::part(const std::set<int>& hosts) {
  std::vector<std::string> commands;
  for (const int host : hosts)
    commands.push_back(fmt::format("ip -n {}air link set p{} master far", name_, host));
  return run_all(commands);
}

Result<void> RadioNet::heal() {
  std::vector<std::string> commands;
  for (int host = 1; host <= hosts_; ++host)
    commands.push_back(fmt::format("ip -n {}air link set p{} master near", name_, host));
  return run_all(commands);
}

std::uint64_t RadioNet::octets_sent(int host) const {
  const auto text = run(
      fmt::format("ip netns exec {} cat /sys/class/net/w0/statistics/tx_bytes", host_name(host)));
  return text ? std::strtoull(text->c_str(), nullptr, 10) : 0;
}

std::vector<std::string> RadioNet::on(int host, std::vector<std::string> arguments) const {
  std::vector<std::string> whole{"/usr/bin/env", "ip", "netns", "exec", host_name(host)};
  whole.insert(whole.end(), arguments.begin(), arguments.end());
  return whole;
}

}  // namespace lifeline::bench
