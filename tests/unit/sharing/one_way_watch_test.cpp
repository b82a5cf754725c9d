// Pairs of which one does not hear the other.
#include "common/sharing/one_way_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

class OneWayWatchTest : public testing::Test {
 protected:
  void say(const std::string& id, std::vector<std::string> hears) {
    wire::AgentStatus status;
    status.envelope = test::envelope(id, ++sequence_);
    status.agent_id = id;
    status.peers_heard = std::move(hears);
    EXPECT_TRUE(roster_.hear(status, now_));
  }
  /// `said` is repeated each second.
  void pass(Duration time, const std::map<std::string, std::vector<std::string>>& said) {
    for (Duration passed{}; passed < time; passed += seconds(1)) {
      now_ += seconds(1);
      for (const auto& [id, hears] : said) say(id, hears);
      watch_.step(now_, roster_);
    }
  }

  SteadyTime now_ = SteadyTime{} + seconds(100);
  Roster roster_;
  OneWayWatch watch_{AgentId::parse("alpha").value()};
  std::uint64_t sequence_ = 0;
};

TEST_F(OneWayWatchTest, SeesNothingWhereAllHearOneAnother) {
  pass(seconds(20), {{"bravo", {"alpha", "charlie"}}, {"charlie", {"alpha", "bravo"}}});
  EXPECT_THAT(watch_.unheard(), IsEmpty());
  EXPECT_THAT(watch_.deaf(), IsEmpty());
}

TEST_F(OneWayWatchTest, NamesWhomOthersHearAndWeDoNotOnceItLasts) {
  pass(seconds(7), {{"bravo", {"alpha", "charlie"}}});
  EXPECT_THAT(watch_.unheard(), IsEmpty());
  pass(seconds(4), {{"bravo", {"alpha", "charlie"}}});
  EXPECT_THAT(watch_.unheard(), ElementsAre("charlie"));
  pass(seconds(1), {{"bravo", {"alpha", "charlie"}}, {"charlie", {"alpha", "bravo"}}});
  EXPECT_THAT(watch_.unheard(), IsEmpty());
}

TEST_F(OneWayWatchTest, NamesWhomWeHearButWhoDoesNotHearUs) {
  pass(seconds(11), {{"bravo", {"alpha", "charlie"}}, {"charlie", {"bravo"}}});
  EXPECT_THAT(watch_.deaf(), ElementsAre("charlie"));
  EXPECT_THAT(watch_.unheard(), IsEmpty());
}

TEST_F(OneWayWatchTest, DoesNotNameOneThatHasGone) {
  pass(seconds(3), {{"bravo", {"alpha", "charlie"}}, {"charlie", {"alpha", "bravo"}}});
  pass(seconds(5), {{"bravo", {"alpha", "charlie"}}});
  pass(seconds(20), {{"bravo", {"alpha"}}});
  EXPECT_THAT(watch_.unheard(), IsEmpty());
  EXPECT_THAT(watch_.deaf(), IsEmpty());
}

TEST_F(OneWayWatchTest, LookersOnSeeWhoDoesNotHearWhom) {
  pass(seconds(1), {{"bravo", {"charlie"}}, {"charlie", {}}});
  EXPECT_THAT(one_way_pairs(roster_, now_), ElementsAre(Pair("charlie", "bravo")));
}

}  // namespace
}  // namespace lifeline::sharing
