#include "common/doctor/check_network.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::doctor {
namespace {

using testing::HasSubstr;

const NetworkInterface kLoopback{"lo", {"127.0.0.1"}, true, true, false, 65536};
const NetworkInterface kRadio{"wlan0", {"10.0.0.11"}, true, false, true, 1500};

dds::ProfileFacts radio_profile() {
  dds::ProfileFacts profile;
  profile.udp = true;
  profile.multicast_discovery = true;
  profile.max_message_octets = 1400;
  profile.receive_buffer_octets = 4194304;
  profile.send_buffer_octets = 4194304;
  return profile;
}

TEST(CheckInterfaces, FindsThisMachinesLoopback) {
  const auto interfaces = read_interfaces();
  ASSERT_TRUE(interfaces) << interfaces.error().text;
  const auto loopback = std::ranges::find(*interfaces, "lo", &NetworkInterface::name);
  ASSERT_NE(loopback, interfaces->end());
  EXPECT_TRUE(loopback->is_up);
  EXPECT_TRUE(loopback->is_loopback);
  EXPECT_GE(loopback->mtu_octets, 1500);
  EXPECT_THAT(loopback->addresses, testing::Contains("127.0.0.1"));
}

TEST(CheckInterfaces, AnInterfaceThatCarriesItAllIsGood) {
  const auto found = check_interfaces(radio_profile(), {kLoopback, kRadio});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, Level::ok);
  EXPECT_EQ(found[0].where, "wlan0");
  EXPECT_EQ(found[0].what, "up, 10.0.0.11, MTU 1500, multicast");
}

TEST(CheckInterfaces, LoopbackAloneReachesNobody) {
  const auto found = check_interfaces(radio_profile(), {kLoopback});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, Level::fault);
  EXPECT_THAT(found[0].advice, HasSubstr("loopback.xml"));
}

TEST(CheckInterfaces, AnInterfaceThatIsDownIsAFaultUnlessAnotherIsUp) {
  NetworkInterface down = kRadio;
  down.name = "eth1";
  down.is_up = false;
  EXPECT_EQ(check_interfaces(radio_profile(), {down})[0].level, Level::fault);
  const auto found = check_interfaces(radio_profile(), {down, kRadio});
  EXPECT_EQ(found[0].level, Level::warning);
  EXPECT_THAT(found[0].advice, HasSubstr("ip link set eth1 up"));
}

TEST(CheckInterfaces, WithoutMulticastOthersAreFoundByTheirAddressesAlone) {
  NetworkInterface deaf = kRadio;
  deaf.has_multicast = false;
  auto profile = radio_profile();
  EXPECT_EQ(check_interfaces(profile, {deaf})[0].level, Level::fault);
  profile.multicast_discovery = false;
  profile.peers = {"10.0.0.10"};
  EXPECT_EQ(check_interfaces(profile, {deaf})[0].level, Level::ok);
}

TEST(CheckInterfaces, DatagramsThatDoNotFitAreWarnedOf) {
  NetworkInterface narrow = kRadio;
  narrow.mtu_octets = 1427;
  const auto found = check_interfaces(radio_profile(), {narrow});
  EXPECT_EQ(found[0].level, Level::warning);
  EXPECT_THAT(found[0].advice, HasSubstr("maxMessageSize 1399"));
  narrow.mtu_octets = 1428;
  EXPECT_EQ(check_interfaces(radio_profile(), {narrow})[0].level, Level::ok);
}

TEST(CheckInterfaces, TheAddressThatAProfileKeepsToMustBeHere) {
  auto profile = radio_profile();
  profile.interfaces = {"10.0.0.11", "10.0.0.99"};
  const auto found = check_interfaces(profile, {kLoopback, kRadio});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, Level::ok);
  EXPECT_EQ(found[1].level, Level::fault);
  EXPECT_EQ(found[1].where, "10.0.0.99");
}

TEST(CheckInterfaces, TheInterfaceThatIsCountedMustBeHere) {
  EXPECT_TRUE(check_counted_interface("none", {kRadio}).empty());
  EXPECT_EQ(check_counted_interface("wlan0", {kRadio})[0].level, Level::ok);
  EXPECT_EQ(check_counted_interface("wlan1", {kRadio})[0].level, Level::fault);
}

TEST(CheckSocketBuffers, WhatTheKernelGrantsIsHeldAgainstTheProfile) {
  const support::TemporaryFolder root;
  std::filesystem::create_directories(root.path() / "proc/sys/net/core");
  std::ignore = root.write("proc/sys/net/core/rmem_max", "4194304\n");
  std::ignore = root.write("proc/sys/net/core/wmem_max", "212992\n");
  const auto found = check_socket_buffers(radio_profile(), root.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, Level::ok);
  EXPECT_EQ(found[1].level, Level::warning);
  EXPECT_THAT(found[1].advice, HasSubstr("sysctl -w net.core.wmem_max=4194304"));
}

TEST(CheckSocketBuffers, LimitsThatCannotBeReadAreSaidToBeSo) {
  const support::TemporaryFolder root;
  const auto found = check_socket_buffers(radio_profile(), root.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, Level::warning);
  EXPECT_THAT(found[0].what, HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace lifeline::doctor
