// A shortcut through a recording comes to where playing all of it comes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"
#include "tests/support/recorded_mission.hpp"

namespace lifeline::test {
namespace {

class ShortcutTest : public RecordedMission {
 protected:
  /// Tiles that change again and again, two ways, statuses, a directive in the middle, a find.
  void SetUp() override {
    begin();
    for (int second = 0; second < kSeconds; ++second) {
      put_tile(second % 7, static_cast<std::uint64_t>(second) + 1);
      put_status(second);
      for (int i = 0; i < 5; ++i) put_pose(second < 20 ? second + 0.01 * i : 20.0 + 0.001 * i);
      if (second == kSeconds / 2) put_directive();
      if (second == kSeconds / 3) put(detection(alpha_, 1, 2.0, 3.0));
    }
    ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
  }
  void put_status(int second) {
    wire::AgentStatus status;
    status.envelope = envelope("alpha", static_cast<std::uint64_t>(second) + 1);
    status.agent_id = "alpha";
    status.map_id = 1;
    put(status);
  }
  void put_directive() {
    wire::MergeDirective directive;
    directive.epoch = 4;
    wire::DirectiveMember member;
    member.layer = {"alpha", 1, 0};
    member.T_common_map = sharing::to_fixed(Pose2{2.0, 0.5, 0.1});
    directive.members.push_back(member);
    recording_->step({}, {coordinator_->store(), directive, coordinator_->common_map()});
  }
  [[nodiscard]] std::unique_ptr<Replay> open() const {
    return Replay::open(recording_->bag().string()).value();
  }
  static void play(Replay& replay, Duration to) {
    while (replay.elapsed() < to && replay.step().value()) {
    }
  }
  static void go(Replay& replay, Duration to) {
    while (replay.take_shortcut(replay.first() + to).value()) {
    }
  }
  static void expect_same(const Replay& fast, const Replay& whole) {
    const Coordinator &a = fast.coordinator(), &b = whole.coordinator();
    EXPECT_EQ(fast.common_map_sha256(), whole.common_map_sha256());
    EXPECT_EQ(a.store().digest(layer("alpha")), b.store().digest(layer("alpha")));
    EXPECT_EQ(a.paths(), b.paths());
    EXPECT_EQ(a.detections().size(), b.detections().size());
    EXPECT_EQ(a.directive().epoch, b.directive().epoch);
    ASSERT_NE(a.poses().find("alpha"), nullptr);
    EXPECT_EQ(a.poses().find("alpha")->loss, b.poses().find("alpha")->loss);
    EXPECT_LE(abs(a.poses().find("alpha")->heard_at - b.poses().find("alpha")->heard_at),
              std::chrono::seconds(1));
  }

  static constexpr int kSeconds = 50;
};

TEST_F(ShortcutTest, ComesToTheSameStateAsPlayingAll) {
  for (const int to_s : {3, 30, 40}) {
    const auto fast = open(), whole = open();
    const Duration to = std::chrono::seconds(to_s);
    go(*fast, to);
    play(*fast, to + std::chrono::seconds(1));
    play(*whole, to + std::chrono::seconds(1));
    SCOPED_TRACE(to_s);
    EXPECT_EQ(fast->elapsed(), whole->elapsed());
    expect_same(*fast, *whole);
  }
}

TEST_F(ShortcutTest, GoesOnFromWhereItIs) {
  const auto fast = open(), whole = open();
  play(*fast, std::chrono::seconds(7));
  go(*fast, std::chrono::seconds(22));
  go(*fast, std::chrono::seconds(40));
  while (fast->step().value()) {
  }
  while (whole->step().value()) {
  }
  EXPECT_FALSE(whole->common_map_sha256().empty());
  expect_same(*fast, *whole);
}

TEST_F(ShortcutTest, EndsWhereTheRecordingDoes) {
  const auto fast = open(), whole = open();
  go(*fast, std::chrono::hours(5));
  EXPECT_FALSE(fast->step().value());
  while (whole->step().value()) {
  }
  EXPECT_EQ(fast->elapsed(), whole->elapsed());
  EXPECT_EQ(fast->messages(), whole->messages());
  expect_same(*fast, *whole);
}

TEST(Digest, OfATileTheNewestWholeRevisionIsLeftAndWhatCameBehindIt) {
  Digest digest({});
  const auto take = [&](std::uint64_t revision, std::uint8_t part) {
    wire::TsdTile tile;
    tile.layer = {"alpha", 1, 0};
    tile.revision = revision;
    tile.part = part;
    tile.parts = 2;
    digest.take({}, {}, Heard(tile));
  };
  take(1, 0), take(1, 1);
  take(2, 0);  // its other part is lost
  take(4, 1), take(4, 0);
  take(3, 0);  // late
  take(5, 1);  // its other part may come yet
  std::vector<std::uint64_t> left;
  for (const auto& entry : digest.entries()) {
    if (entry.heard) left.push_back(std::get<wire::TsdTile>(*entry.heard).revision);
  }
  EXPECT_THAT(left, testing::ElementsAre(4, 4, 5));
}

}  // namespace
}  // namespace lifeline::test
