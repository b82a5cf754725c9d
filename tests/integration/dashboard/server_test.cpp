#include "coordinator/dashboard/server.hpp"

#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/dashboard/web_client.hpp"

namespace lifeline::dashboard::test {
namespace {

namespace pb = proto::dashboard;
using ::testing::HasSubstr;

constexpr std::uint8_t kPage[] = {'h', 'e', 'l', 'l', 'o'};
constexpr Asset kAssets[] = {{"/index.html", "text/html; charset=utf-8", kPage}};

class DashboardServer : public ::testing::Test {
 protected:
  std::unique_ptr<Server> open(const ListenAddress& listen, ServerLimits limits = {}) {
    auto opened =
        Server::open({listen, kAssets, {"drill", "vehicle", 7, 0.05, 900.0}, limits}, feed_);
    EXPECT_TRUE(opened) << opened.error().text;
    return *std::move(opened);
  }
  void start(const ListenAddress& listen = {"127.0.0.1", 0}, ServerLimits limits = {}) {
    server_ = open(listen, limits);
    client_.emplace(server_->listen().port);
  }
  [[nodiscard]] std::uint16_t port() const { return server_->listen().port; }

  static pb::ClientFrame roll_call(std::uint32_t id) {
    pb::ClientFrame frame;
    frame.set_request_id(id);
    frame.mutable_raise_alert()->set_kind(pb::ROLL_CALL);
    return frame;
  }
  static std::string poses(double now_s, std::size_t agents) {
    pb::ServerFrame frame;
    frame.mutable_poses()->set_now_s(now_s);
    for (std::size_t i = 0; i < agents; ++i)
      frame.mutable_poses()->add_poses()->set_agent_id(std::string(30, 'a'));
    return frame.SerializeAsString();
  }
  std::vector<ClientOrder> wait_for_orders() {
    for (;;) {
      if (auto orders = feed_.take_orders(); !orders.empty()) return orders;
      std::this_thread::yield();
    }
  }

  Feed feed_;
  std::unique_ptr<Server> server_;
  std::optional<WebClient> client_;
};

TEST_F(DashboardServer, ServesThePageUnderAPolicyThatRunsNothingElse) {
  start();
  const auto page = client_->get("/");
  EXPECT_EQ(page.result_int(), 200U);
  EXPECT_EQ(page.body(), "hello");
  const std::string policy(page["Content-Security-Policy"]);
  EXPECT_THAT(policy, HasSubstr("default-src 'none'; script-src 'self'; style-src 'self'"));
  EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_EQ(page["X-Content-Type-Options"], "nosniff");
  EXPECT_EQ(client_->get("/index.html?x=1").body(), "hello");
  const auto head = client_->get("/", http::verb::head);
  EXPECT_EQ(head.result_int(), 200U);
  EXPECT_TRUE(head.body().empty());
}

TEST_F(DashboardServer, KnowsNoPathsButItsPages) {
  start();
  for (const char* path : {"/../etc/passwd", "/%2e%2e/etc/passwd", "//index.html", "/index.html/",
                           "/..%2f..%2fetc/passwd", "/./index.html", "/index.html%00", "/live/x",
                           "http://127.0.0.1/index.html", "*"})
    EXPECT_NE(client_->get(path).result_int(), 200U) << path;
}

TEST_F(DashboardServer, TakesNoOtherRequests) {
  start();
  for (const auto verb :
       {http::verb::post, http::verb::put, http::verb::delete_, http::verb::options})
    EXPECT_EQ(client_->get("/", verb).result_int(), 405U);
  EXPECT_EQ(client_->send_raw("\x16\x03\x01 no http\r\n\r\n").result_int(), 400U);
  EXPECT_EQ(
      client_->send_raw("GET / HTTP/1.1\r\nX: " + std::string(9000, 'x') + "\r\n\r\n").result_int(),
      400U);
  EXPECT_EQ(client_->get("/").result_int(), 200U) << "and goes on";
}

TEST_F(DashboardServer, AnswersToNoOtherName) {
  start();
  EXPECT_EQ(client_->get("/", http::verb::get, "rebound.example").result_int(), 421U);
  EXPECT_EQ(client_->get("/", http::verb::get, "").result_int(), 421U);
}

TEST_F(DashboardServer, TakesWebSocketsOfItsOwnPageAlone) {
  start();
  EXPECT_EQ(client_->open({}), 101U);
  for (const char* origin :
       {"", "null", "http://evil.example", "https://127.0.0.1", "http://127.0.0.1.evil.example"})
    EXPECT_EQ(client_->open({.path = "/live", .origin = origin}), 403U) << origin;
  EXPECT_EQ(client_->open({.path = "/live", .origin = {}, .protocols = ""}), 400U);
  EXPECT_EQ(client_->open({.path = "/live", .origin = {}, .protocols = "chat, token.x"}), 400U);
  EXPECT_EQ(client_->open({.path = "/other"}), 404U);
}

TEST_F(DashboardServer, HandsOrdersOnAndAnswersToTheirPage) {
  start();
  ASSERT_EQ(client_->open({}), 101U);
  const auto hello = client_->read().hello();
  EXPECT_TRUE(hello.may_command());
  EXPECT_EQ(hello.mission_id(), "drill");
  EXPECT_EQ(hello.cell_size_um(), 50'000U);
  client_->send(roll_call(12));
  const auto orders = wait_for_orders();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(std::get<RaiseAlert>(orders[0].request.content).kind, wire::AlertKind::roll_call);
  feed_.put(Outcome{orders[0].client, 12, "not now"});
  feed_.flush();
  const auto answer = client_->read(pb::ServerFrame::kAnswer).answer();
  EXPECT_EQ(answer.request_id(), 12U);
  EXPECT_FALSE(answer.is_done());
  EXPECT_EQ(answer.why_not(), "not now");
}

TEST_F(DashboardServer, WhoOnlyLooksCommandsNothing) {
  start();
  ASSERT_EQ(client_->open({.path = "/watch"}), 101U);
  EXPECT_FALSE(client_->read().hello().may_command());
  client_->send(roll_call(1));
  EXPECT_FALSE(client_->read(pb::ServerFrame::kAnswer).answer().is_done());
  EXPECT_TRUE(feed_.take_orders().empty());
}

TEST_F(DashboardServer, ClosesOnFramesThatAreNone) {
  start();
  const auto code_for = [&](const std::string& octets, bool binary) {
    EXPECT_EQ(client_->open({}), 101U);
    client_->send(octets, binary);
    return client_->close_code();
  };
  EXPECT_EQ(code_for("\xff\xff\xff", true), 1007U);
  EXPECT_EQ(code_for("", true), 1007U) << "asks for nothing";
  EXPECT_EQ(code_for("{}", false), 1003U);
  EXPECT_EQ(code_for(std::string(kMaxClientFrame + 1, 'x'), true), 1009U);
  EXPECT_EQ(client_->open({}), 101U) << "others are still served";
}

TEST_F(DashboardServer, ClosesOnAFloodOfFrames) {
  ServerLimits limits;
  limits.frames_per_s = 0.001;
  limits.frames_at_once = 10;
  start({"127.0.0.1", 0}, limits);
  ASSERT_EQ(client_->open({}), 101U);
  pb::ClientFrame watch;
  watch.mutable_watch();
  for (int i = 0; i < 11; ++i) client_->send(watch);
  EXPECT_EQ(client_->close_code(), 1008U);
}

TEST_F(DashboardServer, LimitsHowManyLookAndConnect) {
  ServerLimits limits;
  limits.watchers = 2;
  limits.connections = 4;
  start({"127.0.0.1", 0}, limits);
  WebClient second(port()), third(port());
  ASSERT_EQ(client_->open({}), 101U);
  ASSERT_EQ(second.open({}), 101U);
  EXPECT_EQ(third.open({}), 503U);
}

TEST_F(DashboardServer, ASlowPageGetsTheNewestAndNoQueue) {
  start();
  ASSERT_EQ(client_->open({}), 101U);
  (void)client_->read();
  constexpr int kRounds = 2000;  // 60 MB in all: far more than any socket holds
  for (int i = 1; i <= kRounds; ++i) {
    feed_.put(Section::poses, poses(i, 1000));
    feed_.flush();
    if (i % 10 == 0) std::this_thread::yield();
  }
  int frames = 0;
  for (double now_s = 0; now_s < kRounds; ++frames) {
    const double next = client_->read(pb::ServerFrame::kPoses).poses().now_s();
    ASSERT_GT(next, now_s) << "never an old one";
    now_s = next;
  }
  EXPECT_LT(frames, kRounds) << "what is old is left out";
}

TEST_F(DashboardServer, SaysTilesOfTheMapsThatAPageAsksFor) {
  start();
  auto cells = std::make_shared<sharing::FusedTile>();
  (*cells)[0] = {5, 6};
  feed_.put(TileChange{"", {1, -2}, cells});
  feed_.put(TileChange{"alpha/1", {3, 4}, cells});
  feed_.flush();
  ASSERT_EQ(client_->open({}), 101U);
  auto tiles = client_->read(pb::ServerFrame::kTiles).tiles();
  if (tiles.tiles_size() == 0) tiles = client_->read(pb::ServerFrame::kTiles).tiles();
  ASSERT_EQ(tiles.tiles_size(), 1);
  EXPECT_EQ(tiles.map(), "");
  EXPECT_EQ(tiles.tiles(0).y(), -2);
  EXPECT_EQ(tiles.tiles(0).cells(), pack_tile(*cells));
  pb::ClientFrame watch;
  watch.mutable_watch()->add_maps("alpha/1");
  client_->send(watch);
  tiles = client_->read(pb::ServerFrame::kTiles).tiles();
  EXPECT_EQ(tiles.map(), "alpha/1");
  EXPECT_TRUE(tiles.from_start());
}

TEST_F(DashboardServer, ElsewhereThanOnLoopbackATokenIsNeeded) {
  start({"0.0.0.0", 0});
  const auto& access = server_->access();
  const auto knock = [&](const char* path, const std::string& token) {
    return client_->open({.path = path, .origin = {}, .protocols = "lifeline.v1, token." + token});
  };
  EXPECT_EQ(client_->open({}), 401U);
  EXPECT_EQ(knock("/live", std::string(32, '0')), 401U);
  EXPECT_EQ(knock("/live", access.viewer_token()), 401U);
  EXPECT_EQ(knock("/watch", access.viewer_token()), 101U);
  EXPECT_EQ(knock("/live", access.commander_token()), 101U);
}

TEST_F(DashboardServer, APortThatIsTakenIsSaidInOneLine) {
  start();
  Feed other;
  const auto second = Server::open({{"127.0.0.1", port()}, kAssets, {}, {}}, other);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().text, HasSubstr("Address already in use"));
  EXPECT_THAT(second.error().text, HasSubstr("--dashboard, or off"));
}

TEST_F(DashboardServer, CanBeOpenedAgainAtOnceWithPagesStillThere) {
  start();
  ASSERT_EQ(client_->open({}), 101U);
  const ListenAddress same = server_->listen();
  server_.reset();
  server_ = open(same);
  WebClient again(same.port);
  EXPECT_EQ(again.open({}), 101U);
}

}  // namespace
}  // namespace lifeline::dashboard::test
