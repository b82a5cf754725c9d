#include "coordinator/leadership.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace lifeline {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Coordinators that hear each other's status once a second, unless cut off.
class LeadershipTest : public testing::Test {
 protected:
  struct One {
    std::string id;
    std::uint64_t incarnation;
    Leadership leadership;
    bool is_cut_off = false;
  };

  One& start(const std::string& id, bool standby = false, std::uint64_t incarnation = 1) {
    all_.push_back(std::make_unique<One>(
        One{id, incarnation, Leadership({.standby = standby}, id, incarnation, now_)}));
    return *all_.back();
  }
  void stop(const One& gone) {
    std::erase_if(all_, [&](const auto& one) { return one.get() == &gone; });
  }
  /// Never more than one leads for longer than statuses are on their way.
  void pass(Duration time) {
    for (Duration passed{}; passed < time; passed += kStep) {
      now_ += kStep;
      if (++steps_ % 10 == 0) tell_all();
      int leaders = 0;
      for (auto& one : all_) {
        if (one->is_cut_off) continue;
        leaders += one->leadership.step(now_) ? 1 : 0;
      }
      several_for_ = leaders > 1 ? several_for_ + kStep : Duration{};
      EXPECT_LE(several_for_, seconds(2));
    }
  }

 private:
  static constexpr Duration kStep = milliseconds(100);

  void tell_all() {
    for (const auto& from : all_) {
      for (const auto& to : all_) {
        if (from == to || from->is_cut_off || to->is_cut_off) continue;
        wire::AgentStatus status;
        status.agent_id = from->id;
        status.envelope.incarnation = from->incarnation;
        status.role = wire::Role::coordinator;
        status.state = from->leadership.state();
        to->leadership.hear(status, now_);
      }
    }
  }

  SteadyTime now_{std::chrono::hours(1)};
  int steps_ = 0;
  Duration several_for_{};
  std::vector<std::unique_ptr<One>> all_;
};

TEST_F(LeadershipTest, APrimaryListensFirstAndThenLeads) {
  One& primary = start("coordinator");
  pass(milliseconds(1900));
  EXPECT_FALSE(primary.leadership.leads());
  pass(milliseconds(200));
  EXPECT_TRUE(primary.leadership.leads());
  EXPECT_EQ(primary.leadership.state(), wire::AgentState::tracking);
}

TEST_F(LeadershipTest, AStandbyLeadsOnlyWhileNoPrimaryDoes) {
  One& primary = start("coordinator");
  One& standby = start("standby", true);
  pass(seconds(10));
  EXPECT_TRUE(primary.leadership.leads());
  EXPECT_FALSE(standby.leadership.leads());
  EXPECT_EQ(standby.leadership.leader(), "coordinator");
  stop(primary);
  pass(seconds(4));
  EXPECT_TRUE(standby.leadership.leads());
  EXPECT_EQ(standby.leadership.state(), wire::AgentState::weak);
  One& again = start("coordinator", false, 2);
  pass(seconds(4));
  EXPECT_TRUE(again.leadership.leads());
  EXPECT_FALSE(standby.leadership.leads());
}

TEST_F(LeadershipTest, ASecondPrimaryFollowsTheOneThatLeads) {
  One& first = start("zulu");
  pass(seconds(5));
  One& second = start("alpha");
  pass(seconds(10));
  EXPECT_TRUE(first.leadership.leads());
  EXPECT_FALSE(second.leadership.leads());
  stop(first);
  pass(seconds(4));
  EXPECT_TRUE(second.leadership.leads());
}

TEST_F(LeadershipTest, OfTwoThatStartAtOnceOneGivesWay) {
  One& alpha = start("alpha");
  One& zulu = start("zulu");
  pass(seconds(10));
  EXPECT_TRUE(alpha.leadership.leads());
  EXPECT_FALSE(zulu.leadership.leads());
}

TEST_F(LeadershipTest, OfTwoWithOneNameOneGivesWay) {
  One& older = start("coordinator", false, 5);
  One& younger = start("coordinator", false, 3);
  pass(seconds(10));
  EXPECT_NE(older.leadership.leads(), younger.leadership.leads());
}

TEST_F(LeadershipTest, AfterAPartitionOneGivesWay) {
  One& primary = start("coordinator");
  One& standby = start("standby", true);
  pass(seconds(6));
  standby.is_cut_off = true;
  pass(seconds(2));
  standby.is_cut_off = false;
  primary.is_cut_off = true;
  pass(seconds(5));
  EXPECT_TRUE(standby.leadership.leads());
  primary.is_cut_off = false;
  pass(seconds(3));
  EXPECT_TRUE(primary.leadership.leads());
  EXPECT_FALSE(standby.leadership.leads());
}

TEST_F(LeadershipTest, WhoYieldsListensAnew) {
  One& primary = start("coordinator");
  pass(seconds(3));
  primary.leadership.yield(SteadyTime(std::chrono::hours(1)) + seconds(3));
  EXPECT_FALSE(primary.leadership.leads());
  pass(milliseconds(1800));
  EXPECT_FALSE(primary.leadership.leads());
  pass(milliseconds(400));
  EXPECT_TRUE(primary.leadership.leads());
}

TEST_F(LeadershipTest, HelmetsAreNoCoordinators) {
  One& standby = start("standby", true);
  wire::AgentStatus helmet;
  helmet.agent_id = "alpha";
  helmet.state = wire::AgentState::tracking;
  for (int i = 0; i < 60; ++i) {
    standby.leadership.hear(helmet, SteadyTime(std::chrono::hours(1)) + milliseconds(100 * i));
    pass(milliseconds(100));
  }
  EXPECT_TRUE(standby.leadership.leads());
}

}  // namespace
}  // namespace lifeline
