#include "coordinator/looking_back/recording_player.hpp"

#include <gmock/gmock.h>

#include "idl/dashboard.pb.h"
#include "tests/support/recorded_mission.hpp"

namespace lifeline::test {
namespace {

using dashboard::Section;
using dashboard::Steer;

/// A mission of ten tiles, a second or two apart, and a page's feed that is told of it.
class RecordingPlayerTest : public RecordedMission {
 protected:
  void SetUp() override {
    begin();
    for (int tile = 1; tile <= kTiles; ++tile) {
      put_tile(tile, 1);
      for (int i = 0; i < 9; ++i) step();
      put_pose(tile);
    }
    ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
    feed_.set_watchers(1);
  }
  void play(const dashboard::Timeline& begun) {
    auto player = RecordingPlayer::open([this] { return Replay::open(recording_->bag().string()); },
                                        feed_, begun);
    ASSERT_TRUE(player) << player.error().text;
    player_ = *std::move(player);
  }
  static dashboard::Timeline paused() {
    dashboard::Timeline begun;
    begun.is_paused = true;
    return begun;
  }
  void ask(decltype(dashboard::ClientRequest::content) content) {
    ASSERT_TRUE(feed_.put(dashboard::ClientOrder{1, {++asked_, std::move(content)}}));
  }
  /// Until it is where it was sent, and the page was told so.
  void arrive() {
    turn();
    for (int i = 0; i < 1000 && player_->timeline().is_seeking; ++i) turn();
    ASSERT_FALSE(player_->timeline().is_seeking);
    turn();
  }
  void turn() {
    ASSERT_TRUE(player_->turn());
    auto news = feed_.take();
    for (auto& change : news.tiles) {
      if (change.map != "alpha/1") continue;
      if (change.cells)
        shown_.insert(change.tile.x);
      else
        shown_.erase(change.tile.x);
    }
    for (const auto& outcome : news.outcomes) answers_.push_back(outcome.why_not);
  }
  [[nodiscard]] double at_s() const { return to_seconds(player_->timeline().at); }

  static constexpr int kTiles = 10;
  dashboard::Feed feed_;
  std::unique_ptr<RecordingPlayer> player_;
  std::set<int> shown_;
  std::vector<std::string> answers_;
  std::uint32_t asked_ = 0;
};

TEST_F(RecordingPlayerTest, StandsAtTheBeginningUntilItIsToldWhereToGo) {
  play(paused());
  turn();
  turn();
  EXPECT_EQ(at_s(), 0.0);
  EXPECT_TRUE(shown_.empty());
  EXPECT_GE(player_->timeline().length, std::chrono::seconds(kTiles));
}

TEST_F(RecordingPlayerTest, GoesToATimeAndBackAndShowsWhatWasKnownThen) {
  play(paused());
  ask(Steer{true, 1.0, std::chrono::milliseconds(5500)});
  arrive();
  EXPECT_THAT(at_s(), testing::AllOf(testing::Ge(5.5), testing::Lt(7.0)));
  const std::set<int> then = shown_;
  EXPECT_THAT(then, testing::Contains(1));
  EXPECT_THAT(then, testing::Not(testing::Contains(kTiles)));
  ask(Steer{true, 1.0, player_->timeline().length});
  arrive();
  EXPECT_THAT(shown_, testing::Contains(kTiles));
  ask(Steer{true, 1.0, std::chrono::milliseconds(5500)});
  arrive();
  EXPECT_EQ(shown_, then) << "the same picture again";
  EXPECT_THAT(answers_, testing::Each(""));
  EXPECT_EQ(answers_.size(), 3U);
}

TEST_F(RecordingPlayerTest, TimesBeyondTheEndAreTheEnd) {
  play(paused());
  ask(Steer{true, 1.0, std::chrono::hours(1000)});
  arrive();
  EXPECT_EQ(player_->timeline().at, player_->timeline().length);
}

TEST_F(RecordingPlayerTest, TheNewestWishWinsAndAStopDoesNotUndoIt) {
  play(paused());
  ask(Steer{true, 1.0, player_->timeline().length});
  ask(Steer{true, 1.0, std::chrono::seconds(3)});
  ask(Steer{true, 2.0, std::nullopt});
  arrive();
  EXPECT_THAT(at_s(), testing::AllOf(testing::Ge(3.0), testing::Lt(4.5)));
  EXPECT_EQ(player_->timeline().speed, 2.0);
}

TEST_F(RecordingPlayerTest, NothingElseIsOrderedInARecording) {
  play(paused());
  ask(dashboard::RaiseAlert{});
  turn();
  ASSERT_EQ(answers_.size(), 1U);
  EXPECT_THAT(answers_[0], testing::HasSubstr("what is done is done"));
}

TEST_F(RecordingPlayerTest, PlaysByItselfAtTheSpeedThatIsAskedFor) {
  dashboard::Timeline fastest;
  fastest.speed = 0.0;
  play(fastest);
  for (int i = 0; i < 1000 && !player_->is_at_end(); ++i) turn();
  turn();
  EXPECT_EQ(shown_.size(), static_cast<std::size_t>(kTiles));
}

}  // namespace
}  // namespace lifeline::test
