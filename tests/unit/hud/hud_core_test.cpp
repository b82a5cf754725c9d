#include "agents/hud/hud_core.hpp"

#include <gtest/gtest.h>

#include "tests/support/hud_rooms.hpp"
#include "tests/support/hud_samples.hpp"

namespace lifeline::hud {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using wire::AlertKind;
using Kind = HudCommand::Kind;

class HudCoreTest : public testing::Test {
 protected:
  const HudPicture& run(Duration time) {
    const HudPicture* picture = &core_.step(now_);
    for (Duration passed{}; passed < time; passed += milliseconds(33))
      picture = &core_.step(now_ += milliseconds(33));
    return *picture;
  }
  const HudPicture& stand(double x_m, double y_m, Duration time = seconds(1)) {
    facts_.state.T_map_head = {x_m, y_m, 0.0};
    tell();
    return run(time);
  }
  void tell() { core_.put(facts_, now_); }
  void press(Duration how_long) {
    core_.set_button(true, now_);
    run(how_long);
    core_.set_button(false, now_);
    run(milliseconds(300));
  }

  SteadyTime now_{std::chrono::hours(1)};
  HudFacts facts_ = test::sound_facts(now_);
  HudCore core_{0.05};
};

TEST_F(HudCoreTest, ThePictureFollowsTheHeadSmoothlyAndSoon) {
  stand(0.0, 0.0);
  facts_.state.T_map_head = {1.0, 0.0, 0.0};
  tell();
  const double soon = run(milliseconds(66)).T_map_head.x_m;
  EXPECT_GT(soon, 0.2);
  EXPECT_LT(soon, 0.9);
  EXPECT_NEAR(run(milliseconds(500)).T_map_head.x_m, 1.0, 0.01);
}

TEST_F(HudCoreTest, TheWayOutIsTheTrailUntilAFreeWayIsSeen) {
  for (double x = 1.0; x <= 5.0; x += 0.2) stand(x, 1.5, milliseconds(100));
  EXPECT_FALSE(core_.trail().empty());
  const HudPicture& blind = stand(5.0, 1.5);
  ASSERT_TRUE(blind.way_out);
  EXPECT_TRUE(blind.way_out->by_own_trail);
  EXPECT_NEAR(blind.way_out->length_m, 4.0, 0.3);
  core_.put(test::plan_tiles({"############", "#..........#", "#..........#", "#..........#",
                              "#..........#", "############"}));
  const HudPicture& seen = run(seconds(1));
  ASSERT_TRUE(seen.way_out);
  EXPECT_FALSE(seen.way_out->by_own_trail);
  EXPECT_NEAR(seen.way_out->length_m, 4.0, 0.4);
}

TEST_F(HudCoreTest, NoTrailIsLaidWhereThePositionIsLost) {
  stand(1.0, 1.0);
  facts_.state.state = wire::AgentState::lost;
  facts_.state.trust_percent = 0;
  const HudPicture& lost = stand(9.0, 9.0, seconds(4));
  EXPECT_EQ(core_.trail().size(), 1U);
  ASSERT_EQ(lost.bands.size(), 1U);
  EXPECT_EQ(lost.bands[0].kind, BandKind::lost);
  facts_.state.state = wire::AgentState::tracking;
  facts_.state.trust_percent = 90;
  EXPECT_TRUE(stand(2.0, 1.0).bands.empty());
}

TEST_F(HudCoreTest, AfterARestartTheEntryIsWhereTheWalkBegan) {
  HudCore resumed(0.05, {{0.0, 0.0}, {0.1, 0.0}, {1.0, 0.0}, {2.0, 0.0}});
  EXPECT_EQ(resumed.trail().size(), 3U) << "no closer than need be";
  EXPECT_EQ(resumed.trail().front(), Eigen::Vector2d(0.0, 0.0));
}

TEST_F(HudCoreTest, ATrailOfManyHoursStaysWithinBoundsAndKeepsTheEntry) {
  Path long_walk;
  for (int i = 0; i < 100'000; ++i) long_walk.push_back({0.3 * i, 0.0});
  const HudCore core(0.05, long_walk);
  EXPECT_LE(core.trail().size(), 8000U);
  EXPECT_GE(core.trail().size(), 2000U);
  EXPECT_EQ(core.trail().front(), long_walk.front());
  EXPECT_NEAR(core.trail().back().x(), long_walk.back().x(), 10.0);
}

TEST_F(HudCoreTest, ABriefPressChangesTheScaleAndComesRound) {
  stand(0.0, 0.0);
  std::vector<double> scales;
  for (int i = 0; i < 4; ++i) {
    scales.push_back(run({}).metres_ahead);
    press(milliseconds(150));
  }
  EXPECT_EQ(scales, (std::vector<double>{8.0, 16.0, 32.0, 8.0}));
  EXPECT_TRUE(core_.take_commands().empty());
}

TEST_F(HudCoreTest, ABriefPressAnswersWhatWaitsAndLeavesTheScale) {
  facts_.alerts = {test::open_alert(AlertKind::roll_call, "vehicle")};
  stand(0.0, 0.0);
  press(milliseconds(150));
  const auto commands = core_.take_commands();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].kind, Kind::answer);
  EXPECT_EQ(commands[0].alert, (sharing::AlertKey{"vehicle", 1}));
  EXPECT_EQ(run({}).metres_ahead, 8.0);
}

TEST_F(HudCoreTest, HeldItCallsForHelpAndHeldAgainAllIsWell) {
  stand(0.0, 0.0);
  core_.set_button(true, now_);
  EXPECT_GT(run(seconds(1)).hold_share, 0.4);
  run(seconds(1) + milliseconds(100));
  EXPECT_EQ(run({}).hold_share, 0.0);
  core_.set_button(false, now_);
  run(milliseconds(300));
  auto commands = core_.take_commands();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].kind, Kind::mayday);
  auto own = test::open_alert(AlertKind::mayday, "alpha", "alpha");
  own.own = true;
  facts_.alerts = {own};
  stand(0.0, 0.0);
  press(milliseconds(2200));
  commands = core_.take_commands();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].kind, Kind::all_well);
}

}  // namespace
}  // namespace lifeline::hud
