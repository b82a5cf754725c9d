#include "coordinator/dashboard/look_back.hpp"

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coordinator/dashboard/server.hpp"
#include "coordinator/dashboard/timeline.hpp"
#include "tests/integration/dashboard/web_client.hpp"

namespace lifeline::dashboard::test {
namespace {

namespace pb = proto::dashboard;
using ::testing::HasSubstr;
using Kind = pb::ServerFrame;

constexpr double kThen_s = 60.0, kNow_s = 500.0;

std::string poses(double now_s) {
  pb::ServerFrame frame;
  frame.mutable_poses()->set_now_s(now_s);
  return frame.SerializeAsString();
}
std::string alert(std::uint32_t id) {
  pb::ServerFrame frame;
  frame.mutable_alerts()->add_alerts()->set_alert_id(id);
  return frame.SerializeAsString();
}
TileChange tile(int x) {
  return {"", {x, 0}, std::make_shared<const sharing::FusedTile>()};
}

/// What the look backs of a test came to.
struct Looks {
  std::mutex mutex;
  std::vector<Feed*> feeds;
  std::vector<std::string> ends;  ///< a reason for each that ends by itself
  std::atomic<int> asked_to_end{0};
};

/// Shows one minute, without a thread: pictures are put before it is returned.
class FakePast final : public LookBack {
 public:
  FakePast(Looks& looks, Feed& feed) : looks_(looks) {
    // In a wrong order, as far as the page is concerned.
    feed.put(Section::alerts, alert(1));
    feed.put(Section::poses, poses(kThen_s));
    feed.put(tile(1));
    Timeline timeline;
    timeline.at = from_seconds(kThen_s);
    timeline.is_mission_live = true;
    feed.put(Section::timeline, timeline_frame(timeline, 1));
    for (const auto& order : feed.take_orders())
      feed.put(Outcome{order.client, order.request.request_id, ""});
    feed.flush();
    const std::lock_guard lock(looks_.mutex);
    looks_.feeds.push_back(&feed);
  }
  void end() override {
    ++looks_.asked_to_end;
    is_asked_ = true;
  }
  [[nodiscard]] std::optional<std::string> ended() const override {
    if (is_asked_) return "";
    const std::lock_guard lock(looks_.mutex);
    if (looks_.ends.empty()) return std::nullopt;
    return looks_.ends.front();
  }

 private:
  Looks& looks_;
  std::atomic<bool> is_asked_{false};
};

class LookBackOnPages : public ::testing::Test {
 protected:
  void SetUp() override {
    ServerOptions options;
    options.listen = {"127.0.0.1", 0};
    options.look_back = [this](Feed& feed) -> Result<std::unique_ptr<LookBack>> {
      return std::make_unique<FakePast>(looks_, feed);
    };
    open(std::move(options));
  }
  void open(ServerOptions options) {
    auto opened = Server::open(std::move(options), feed_);
    ASSERT_TRUE(opened) << opened.error().text;
    server_ = *std::move(opened);
    say_now(kNow_s);
  }
  /// The mission goes on.
  void say_now(double now_s) {
    feed_.put(Section::poses, poses(now_s));
    feed_.put(tile(2));
    feed_.flush();
  }
  std::unique_ptr<WebClient> page(const char* path = "/live") {
    auto client = std::make_unique<WebClient>(server_->listen().port);
    EXPECT_EQ(client->open({.path = path}), 101U);
    return client;
  }
  static pb::ClientFrame ask(std::uint32_t id) {
    pb::ClientFrame frame;
    frame.set_request_id(id);
    return frame;
  }
  static pb::ClientFrame look_back(double to_s) {
    pb::ClientFrame frame = ask(1);
    frame.mutable_steer()->set_speed(1.0);
    frame.mutable_steer()->set_to_s(to_s);
    return frame;
  }
  static std::string why_not(WebClient& page, const pb::ClientFrame& frame) {
    page.send(frame);
    for (;;) {
      const auto answer = page.read(Kind::kAnswer).answer();
      if (answer.request_id() == frame.request_id()) return answer.why_not();
    }
  }
  static void expect_poses(WebClient& page, double now_s) {
    EXPECT_EQ(page.read(Kind::kPoses).poses().now_s(), now_s);
  }
  /// The first of a map's tiles.
  static pb::Tiles first_tiles(WebClient& page) {
    for (;;) {
      auto tiles = page.read(Kind::kTiles).tiles();
      if (tiles.tiles_size() > 0) return tiles;
    }
  }

  template <typename Condition>
  static bool within_ten_seconds(Condition condition) {
    for (int i = 0; i < 5000 && !condition(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return condition();
  }
  bool take_order() {
    for (auto& order : feed_.take_orders()) ordered_.push_back(std::move(order));
    return !ordered_.empty();
  }

  Feed feed_;
  Looks looks_;
  std::vector<ClientOrder> ordered_;
  std::unique_ptr<Server> server_;
};

TEST_F(LookBackOnPages, OnePageLooksBackAndAnotherStaysLive) {
  const auto past = page(), live = page();
  expect_poses(*past, kNow_s);
  expect_poses(*live, kNow_s);
  past->send(look_back(kThen_s));
  EXPECT_EQ(past->read(Kind::kTimeline).timeline().at_s(), kThen_s);
  expect_poses(*past, kThen_s);
  const auto tiles = first_tiles(*past);
  EXPECT_TRUE(tiles.from_start());
  EXPECT_EQ(tiles.tiles(0).x(), 1);
  say_now(kNow_s + 1);
  expect_poses(*live, kNow_s + 1);
}

TEST_F(LookBackOnPages, ThePageKnowsThatItLooksBackBeforeItSeesAnything) {
  const auto past = page();
  past->send(look_back(kThen_s));
  for (auto frame = past->read(); frame.content_case() != Kind::kTimeline; frame = past->read()) {
    EXPECT_NE(frame.poses().now_s(), kThen_s);
    for (const auto& each : frame.tiles().tiles()) EXPECT_NE(each.x(), 1);
  }
}

TEST_F(LookBackOnPages, AlertsAreThoseOfNow) {
  const auto past = page();
  EXPECT_EQ(why_not(*past, look_back(kThen_s)), "");
  expect_poses(*past, kThen_s);
  feed_.put(Section::alerts, alert(77));
  say_now(kNow_s + 1);
  EXPECT_EQ(past->read(Kind::kAlerts).alerts().alerts(0).alert_id(), 77U);
}

TEST_F(LookBackOnPages, NothingButAnAnswerToAnAlertIsOrderedFromThePast) {
  const auto past = page();
  EXPECT_EQ(why_not(*past, look_back(kThen_s)), "");
  auto evacuate = ask(2);
  evacuate.mutable_raise_alert()->set_kind(pb::EVACUATE);
  auto merge = ask(3);
  merge.mutable_rule_merge()->set_map_a("alpha/1");
  merge.mutable_rule_merge()->set_map_b("bravo/1");
  auto find = ask(4);
  find.mutable_rule_find()->set_agent_id("alpha");
  for (const auto& order : {evacuate, merge, find})
    EXPECT_THAT(why_not(*past, order), HasSubstr("go back to live first"));
  EXPECT_FALSE(take_order());
  auto answer = ask(5);
  answer.mutable_answer_alert()->set_issuer_id("alpha");
  answer.mutable_answer_alert()->set_state(pb::ACKNOWLEDGED);
  past->send(answer);
  ASSERT_TRUE(within_ten_seconds([this] { return take_order(); }));
  EXPECT_TRUE(std::holds_alternative<AnswerAlert>(ordered_[0].request.content));
}

TEST_F(LookBackOnPages, BackToLiveEverythingIsToldAnew) {
  const auto past = page();
  EXPECT_EQ(why_not(*past, look_back(kThen_s)), "");
  expect_poses(*past, kThen_s);
  auto go_live = ask(2);
  go_live.mutable_go_live();
  past->send(go_live);
  EXPECT_EQ(past->read(Kind::kLive).live().why(), "");
  EXPECT_TRUE(past->read(Kind::kAnswer).answer().is_done());
  expect_poses(*past, kNow_s);
  const auto tiles = first_tiles(*past);
  EXPECT_TRUE(tiles.from_start());
  EXPECT_EQ(tiles.tiles(0).x(), 2);
  auto evacuate = ask(3);
  evacuate.mutable_raise_alert()->set_kind(pb::EVACUATE);
  past->send(evacuate);
  EXPECT_TRUE(within_ten_seconds([this] { return take_order(); }));
  EXPECT_EQ(looks_.asked_to_end, 1);
}

TEST_F(LookBackOnPages, OnlySoManyLookBackAndWhoOnlyLooksLeavesRoom) {
  const auto viewer = page("/watch"), another = page("/watch"), first = page(), second = page();
  EXPECT_EQ(why_not(*viewer, look_back(kThen_s)), "");
  EXPECT_THAT(why_not(*another, look_back(kThen_s)), HasSubstr("others look back already"));
  EXPECT_EQ(why_not(*first, look_back(kThen_s)), "");
  EXPECT_THAT(why_not(*second, look_back(kThen_s)), HasSubstr("others look back already"));
  auto go_live = ask(2);
  go_live.mutable_go_live();
  EXPECT_EQ(why_not(*first, go_live), "");
  EXPECT_EQ(why_not(*second, look_back(kThen_s)), "") << "there is room again";
}

TEST_F(LookBackOnPages, APageThatIsClosedEndsItsLook) {
  auto past = page();
  EXPECT_EQ(why_not(*past, look_back(kThen_s)), "");
  past.reset();
  EXPECT_TRUE(within_ten_seconds([this] { return looks_.asked_to_end == 1; }));
}

TEST_F(LookBackOnPages, WhatEndsByItselfIsSaidAndThePageIsLive) {
  const auto past = page();
  EXPECT_EQ(why_not(*past, look_back(kThen_s)), "");
  expect_poses(*past, kThen_s);
  {
    const std::lock_guard lock(looks_.mutex);
    looks_.ends.push_back("the disk is gone");
  }
  say_now(kNow_s + 1);
  EXPECT_EQ(past->read(Kind::kLive).live().why(), "the disk is gone");
  expect_poses(*past, kNow_s + 1);
}

TEST_F(LookBackOnPages, ALivePageMustSayWhereToGo) {
  const auto live = page();
  auto steer = ask(9);
  steer.mutable_steer()->set_is_paused(true);
  EXPECT_THAT(why_not(*live, steer), HasSubstr("say which time to go to"));
  auto go_live = ask(10);
  go_live.mutable_go_live();
  EXPECT_EQ(why_not(*live, go_live), "") << "it is";
}

TEST_F(LookBackOnPages, TimesThatAreNoneCloseTheConnection) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  for (const double to_s : {std::nan(""), -1.0, 1e12, -kEndless, kEndless}) {
    const auto live = page();
    live->send(look_back(to_s));
    EXPECT_EQ(live->close_code(), 1007U) << to_s;
  }
  EXPECT_TRUE(looks_.feeds.empty());
}

TEST_F(LookBackOnPages, WithoutARecordingThePageIsToldWhatToDo) {
  ServerOptions options;
  options.listen = {"127.0.0.1", 0};
  options.look_back = [](Feed&) -> Result<std::unique_ptr<LookBack>> {
    return fail(ErrorCode::unavailable, "nothing is recorded; start with --record FOLDER");
  };
  server_.reset();
  open(std::move(options));
  const auto live = page();
  EXPECT_THAT(why_not(*live, look_back(kThen_s)), HasSubstr("--record FOLDER"));
  say_now(kNow_s + 1);
  EXPECT_GE(live->read(Kind::kPoses).poses().now_s(), kNow_s) << "it is live as before";
}

TEST_F(LookBackOnPages, AServerThatClosesEndsThemAll) {
  const auto first = page(), second = page();
  EXPECT_EQ(why_not(*first, look_back(kThen_s)), "");
  EXPECT_EQ(why_not(*second, look_back(kThen_s)), "");
  server_.reset();
  EXPECT_THROW(for (;;)(void) first->read(), boost::system::system_error);
}

}  // namespace
}  // namespace lifeline::dashboard::test
