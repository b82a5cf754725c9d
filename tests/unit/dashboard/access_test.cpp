#include "coordinator/dashboard/access.hpp"

#include <gtest/gtest.h>

namespace lifeline::dashboard {
namespace {

TEST(ListenAddressText, GivesAddressAndPort) {
  EXPECT_EQ(parse_listen_address("127.0.0.1:80")->value(), (ListenAddress{"127.0.0.1", 80}));
  EXPECT_EQ(parse_listen_address("[::1]:8642")->value(), (ListenAddress{"::1", 8642}));
  EXPECT_EQ(parse_listen_address("[::1]:8642")->value().text(), "[::1]:8642");
  EXPECT_FALSE(parse_listen_address("off")->has_value());
}

TEST(ListenAddressText, ThatIsNoneIsRefusedWithAnExample) {
  for (const char* text : {"", "8642", "localhost:80", "127.0.0.1:", "127.0.0.1:65536", "::1:80",
                           "127.0.0.1:80x", "1.2.3.4.5:1", "off:1", "127.0.0.1:-1"}) {
    const auto parsed = parse_listen_address(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().code, ErrorCode::wrong_use);
    EXPECT_NE(parsed.error().text.find("127.0.0.1:8642"), std::string::npos);
  }
}

TEST(DashboardAccess, OnLoopbackNeedsNoTokenButThisServersName) {
  const Access access({"127.0.0.1", 8642});
  EXPECT_FALSE(access.needs_token());
  EXPECT_EQ(access.admit(Role::commander, ""), Role::commander);
  EXPECT_EQ(access.admit(Role::viewer, ""), Role::viewer);
  EXPECT_TRUE(access.is_our_host("127.0.0.1:8642"));
  EXPECT_TRUE(access.is_our_host("localhost:8642"));
  for (const char* host : {"", "evil.example:8642", "127.0.0.1", "127.0.0.1:8643", "localhost",
                           "127.0.0.1:8642.evil.example", "x127.0.0.1:8642"})
    EXPECT_FALSE(access.is_our_host(host)) << host;
}

TEST(DashboardAccess, TakesPagesOfThisVeryServerAlone) {
  const Access access({"127.0.0.1", 8642});
  EXPECT_TRUE(access.is_our_origin("http://127.0.0.1:8642", "127.0.0.1:8642"));
  for (const char* origin :
       {"", "null", "http://127.0.0.1", "https://127.0.0.1:8642", "http://localhost:8642",
        "http://127.0.0.1:8642/", "http://127.0.0.1:8642.evil.example", "http://evil.example"})
    EXPECT_FALSE(access.is_our_origin(origin, "127.0.0.1:8642")) << origin;
  EXPECT_FALSE(access.is_our_origin("http://evil.example:8642", "evil.example:8642"));
}

TEST(DashboardAccess, ElsewhereNeedsTheTokenOfTheRole) {
  const Access access({"0.0.0.0", 8642});
  ASSERT_TRUE(access.needs_token());
  EXPECT_EQ(access.commander_token().size(), 32U);
  EXPECT_NE(access.commander_token(), access.viewer_token());
  EXPECT_NE(access.commander_token(), Access({"0.0.0.0", 8642}).commander_token());
  EXPECT_EQ(access.admit(Role::commander, access.commander_token()), Role::commander);
  EXPECT_EQ(access.admit(Role::viewer, access.commander_token()), Role::viewer);
  EXPECT_EQ(access.admit(Role::viewer, access.viewer_token()), Role::viewer);
  EXPECT_FALSE(access.admit(Role::commander, access.viewer_token()));
  EXPECT_FALSE(access.admit(Role::viewer, ""));
  EXPECT_FALSE(access.admit(Role::commander, access.commander_token().substr(1)));
}

TEST(DashboardAccess, OnAllAddressesIsReachedByAddressAndNotByName) {
  const Access access({"0.0.0.0", 8642});
  EXPECT_TRUE(access.is_our_host("192.168.1.7:8642"));
  EXPECT_TRUE(access.is_our_host("[fe80::1]:8642"));
  EXPECT_FALSE(access.is_our_host("rebound.example:8642"));
  EXPECT_FALSE(Access({"192.168.1.7", 8642}).is_our_host("192.168.1.8:8642"));
}

}  // namespace
}  // namespace lifeline::dashboard
