// config/qos/loopback.xml touches no network.

#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "common/dds/channel.hpp"
#include "tests/integration/dds/processes.hpp"

namespace lifeline::test {
namespace {

/// The inodes of all sockets that this process holds.
std::set<std::string> own_sockets() {
  std::set<std::string> inodes;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    const auto target = std::filesystem::read_symlink(entry.path(), gone).string();
    constexpr std::string_view kPrefix = "socket:[";
    if (!gone && target.starts_with(kPrefix)) {
      inodes.insert(target.substr(kPrefix.size(), target.size() - kPrefix.size() - 1));
    }
  }
  return inodes;
}

/// The local addresses of this process's sockets in one of /proc/net's tables, as written there.
std::multiset<std::string> local_addresses(const std::string& table) {
  std::multiset<std::string> addresses;
  const auto own = own_sockets();
  std::ifstream file("/proc/self/net/" + table);
  std::string line;
  std::getline(file, line);  // heading
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::array<std::string, 10> word;
    for (auto& w : word) words >> w;
    if (own.contains(word[9])) addresses.insert(word[1].substr(0, word[1].find(':')));
  }
  return addresses;
}

std::string multicast_groups() {
  std::ostringstream text;
  text << std::ifstream("/proc/self/net/igmp").rdbuf();
  return text.str();
}

TEST(LoopbackOnly, every_socket_is_bound_to_127_0_0_1) {
  const TestDomain domain;
  const auto groups_before = multicast_groups();
  const auto qos = LIFELINE_SOURCE_DIR "/config/qos/loopback.xml";
  const auto alpha = dds::Participant::create({domain.id(), qos, "alpha"}).value();
  const auto bravo = dds::Participant::create({domain.id(), qos, "bravo"}).value();
  const auto out = dds::make_outbox<wire::Alert>(*alpha).value();
  const auto in = dds::make_inbox<wire::Alert>(*bravo).value();
  ASSERT_TRUE(out->put(wire::Alert{}));
  ASSERT_TRUE(bravo->wait_for_data(kPatience));

  const auto addresses = local_addresses("udp");

  EXPECT_GE(addresses.size(), 4U);  // metatraffic and data of each
  for (const auto& address : addresses) EXPECT_EQ(address, "0100007F");
  for (const auto* table : {"udp6", "tcp", "tcp6"}) EXPECT_TRUE(local_addresses(table).empty());
  EXPECT_EQ(multicast_groups(), groups_before);
}

}  // namespace
}  // namespace lifeline::test
