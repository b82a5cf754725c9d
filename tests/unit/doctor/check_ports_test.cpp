#include "common/doctor/check_ports.hpp"

#include <arpa/inet.h>
#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/net/rtps_ports.hpp"
#include "common/net/tcp_listener.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::doctor {
namespace {

using testing::HasSubstr;

/// A port that another program holds.
class HeldPort {
 public:
  explicit HeldPort(std::uint16_t port) : handle_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    is_held_ = bind(handle_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~HeldPort() { close(handle_); }
  HeldPort(const HeldPort&) = delete;
  HeldPort& operator=(const HeldPort&) = delete;
  [[nodiscard]] bool is_held() const { return is_held_; }

 private:
  int handle_;
  bool is_held_ = false;
};

// Above the ports that the kernel hands out, and no domain of a mission that runs beside.
constexpr std::uint32_t kDomain = 230;

dds::ProfileFacts two_places() {
  dds::ProfileFacts profile;
  profile.udp = true;
  profile.peers = {"127.0.0.1"};
  profile.peers_range = 2;
  return profile;
}

class CheckDomain : public testing::Test {
 protected:
  CheckDomain() { std::filesystem::create_directories(root_.path() / "proc/sys/net/ipv4"); }
  void hand_out(const std::string& range) {
    std::ignore = root_.write("proc/sys/net/ipv4/ip_local_port_range", range);
  }
  support::TemporaryFolder root_;
};

TEST_F(CheckDomain, CountsWhoIsInItAndSeesThatNoPlaceIsLeft) {
  auto found = check_domain(kDomain, two_places(), root_.path());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, Level::ok);
  EXPECT_THAT(found[0].what, HasSubstr("no other program"));

  const HeldPort first(net::rtps_unicast_ports(kDomain, 0).first);
  ASSERT_TRUE(first.is_held());
  found = check_domain(kDomain, two_places(), root_.path());
  EXPECT_EQ(found[0].level, Level::ok);
  EXPECT_THAT(found[0].what, HasSubstr("1 other program of this machine in it, 1 place left"));

  const HeldPort second(net::rtps_unicast_ports(kDomain, 1).second);
  ASSERT_TRUE(second.is_held());
  found = check_domain(kDomain, two_places(), root_.path());
  EXPECT_EQ(found[0].level, Level::fault);
  EXPECT_THAT(found[0].what, HasSubstr("all 2 places"));
}

TEST_F(CheckDomain, PortsThatTheKernelHandsOutAreWarnedOf) {
  hand_out("32768\t60999\n");
  EXPECT_EQ(check_domain(kDomain, two_places(), root_.path())[0].level, Level::ok);
  const auto found = check_domain(110, two_places(), root_.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, Level::warning);
  EXPECT_THAT(found[0].what, HasSubstr("34900 to 34913"));
}

TEST_F(CheckDomain, ARangeThatIsNoneIsPassedOver) {
  hand_out("many");
  EXPECT_EQ(check_domain(110, two_places(), root_.path()).size(), 1U);
}

TEST(CheckTcpPort, IsFreeOrInUseOrNotOurs) {
  boost::asio::io_context context;
  net::TcpListener other(context);
  ASSERT_FALSE(other.open({boost::asio::ip::make_address("127.0.0.1"), 0}));
  const auto taken = check_tcp_port("dashboard", "127.0.0.1", other.endpoint().port(), "go away");
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].level, Level::fault);
  EXPECT_THAT(taken[0].what, HasSubstr("in use"));
  EXPECT_EQ(taken[0].advice, "go away");
  EXPECT_EQ(check_tcp_port("dashboard", "127.0.0.1", 0, "")[0].level, Level::ok);
  // An address of documentation's own (RFC 5737): no machine has it.
  EXPECT_EQ(check_tcp_port("dashboard", "203.0.113.1", 8642, "")[0].level, Level::fault);
  EXPECT_THAT(check_tcp_port("dashboard", "vehicle", 8642, "")[0].what, HasSubstr("no IP address"));
}

}  // namespace
}  // namespace lifeline::doctor
