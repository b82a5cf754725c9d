#include "coordinator/looking_back/look_back.hpp"

#include <gmock/gmock.h>

#include "idl/dashboard.pb.h"
#include "tests/support/recorded_mission.hpp"

namespace lifeline::test {
namespace {

namespace pb = proto::dashboard;
using dashboard::Section;

class LookBackTest : public RecordedMission {
 protected:
  void open() {
    feed_.set_watchers(1);
    auto opened = look_back_at(recording_.get())(feed_);
    ASSERT_TRUE(opened) << opened.error().text;
    past_ = *std::move(opened);
  }
  void go_to(Duration to, bool is_paused = true) {
    ASSERT_TRUE(feed_.put(dashboard::ClientOrder{1, {1, dashboard::Steer{is_paused, 1.0, to}}}));
  }
  /// Where the page is told that it is, once `until` says yes.
  template <typename Until>
  pb::Timeline wait(Until until) {
    for (int i = 0; i < 5000; ++i) {
      auto news = feed_.take();
      for (auto& change : news.tiles) {
        if (change.cells) shown_.insert(change.tile.x);
      }
      if (const auto& told = news.sections[static_cast<std::size_t>(Section::timeline)]) {
        pb::ServerFrame frame;
        EXPECT_TRUE(frame.ParseFromString(*told));
        if (until(frame.timeline())) return frame.timeline();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ADD_FAILURE() << "not within ten seconds";
    return {};
  }
  std::optional<std::string> wait_for_the_end() {
    for (int i = 0; i < 5000 && !past_->ended(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return past_->ended();
  }

  dashboard::Feed feed_;
  std::unique_ptr<dashboard::LookBack> past_;  // ends before its feed
  std::set<int> shown_;
};

TEST_F(LookBackTest, WithoutARecordingItSaysHowToMakeOne) {
  const auto opened = look_back_at(nullptr)(feed_);
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().text, testing::HasSubstr("--record FOLDER"));
}

TEST_F(LookBackTest, ShowsAnEarlierTimeOfAMissionThatGoesOn) {
  begin();
  put_tile(1, 1);
  for (int i = 0; i < 50; ++i) step();
  put_tile(2, 1);
  wait_until_written();
  open();
  go_to(std::chrono::seconds(2));
  const auto there =
      wait([](const pb::Timeline& at) { return at.at_s() > 1.5 && !at.is_seeking(); });
  EXPECT_TRUE(there.is_mission_live());
  EXPECT_TRUE(there.is_paused());
  EXPECT_LT(there.at_s(), 4.0);
  (void)wait([&](const pb::Timeline&) { return !shown_.empty(); });
  EXPECT_EQ(shown_, std::set<int>{1}) << "the second tile was not known then";

  for (int i = 0; i < 50; ++i) step();
  wait_until_written();
  const auto longer =
      wait([&](const pb::Timeline& at) { return at.length_s() > there.length_s() + 4.0; });
  EXPECT_EQ(longer.at_s(), there.at_s()) << "it stays where it is while the mission goes on";
  past_->end();
  EXPECT_EQ(wait_for_the_end(), "") << "as it was asked to";
}

TEST_F(LookBackTest, SaysWhyItEndsWithTheRecording) {
  begin();
  put_tile(1, 1);
  wait_until_written();
  open();
  go_to(Duration{0}, false);
  (void)wait([](const pb::Timeline& at) { return !at.is_paused(); });
  ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
  EXPECT_THAT(wait_for_the_end().value_or(""), testing::HasSubstr("is closed"));
}

}  // namespace
}  // namespace lifeline::test
