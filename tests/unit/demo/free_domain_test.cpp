#include "deploy/demo/free_domain.hpp"

#include <set>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lifeline::demo {
namespace {

bool nothing_is_taken(std::uint16_t) {
  return true;
}

TEST(PickFreeDomain, lies_away_from_the_domains_that_people_choose) {
  for (std::uint64_t salt = 0; salt < 200; ++salt) {
    const auto domain = pick_free_domain(salt, 4, nothing_is_taken);
    ASSERT_TRUE(domain);
    EXPECT_GE(*domain, 20U);
    EXPECT_LE(*domain, 99U);
  }
}

TEST(PickFreeDomain, differs_with_the_salt) {
  EXPECT_NE(pick_free_domain(1, 4, nothing_is_taken).value(),
            pick_free_domain(2, 4, nothing_is_taken).value());
}

TEST(PickFreeDomain, passes_over_a_domain_whose_discovery_port_is_taken) {
  const auto domain =
      pick_free_domain(0, 4, [](std::uint16_t port) { return port != 7400 + 250 * 20; });
  ASSERT_TRUE(domain);
  EXPECT_EQ(*domain, 21U);
}

TEST(PickFreeDomain, passes_over_a_domain_whose_second_participant_is_there) {
  const auto domain =
      pick_free_domain(0, 2, [](std::uint16_t port) { return port != 7400 + 250 * 20 + 12; });
  ASSERT_TRUE(domain);
  EXPECT_EQ(*domain, 21U);
}

TEST(PickFreeDomain, begins_again_at_the_first_domain_behind_the_last) {
  const auto domain =
      pick_free_domain(79, 1, [](std::uint16_t port) { return port != 7400 + 250 * 99; });
  ASSERT_TRUE(domain);
  EXPECT_EQ(*domain, 20U);
}

TEST(PickFreeDomain, says_so_when_all_are_taken) {
  const auto domain = pick_free_domain(5, 1, [](std::uint16_t) { return false; });
  ASSERT_FALSE(domain);
  EXPECT_EQ(domain.error().code, ErrorCode::unavailable);
}

TEST(UdpPortIsFree, sees_a_port_that_somebody_holds) {
  const int handle = socket(AF_INET, SOCK_DGRAM, 0);
  ASSERT_GE(handle, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(handle, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  socklen_t length = sizeof address;
  ASSERT_EQ(getsockname(handle, reinterpret_cast<sockaddr*>(&address), &length), 0);
  const std::uint16_t port = ntohs(address.sin_port);
  EXPECT_FALSE(net::udp_port_is_free(port));
  close(handle);
  EXPECT_TRUE(net::udp_port_is_free(port));
}

}  // namespace
}  // namespace lifeline::demo
