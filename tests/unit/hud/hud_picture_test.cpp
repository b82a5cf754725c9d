#include "agents/hud/hud_picture.hpp"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/hud_samples.hpp"

namespace lifeline::hud {
namespace {

using std::chrono::seconds;
using testing::ElementsAre;
using wire::AlertKind;

class HudPictureTest : public testing::Test {
 protected:
  HudPicture compose() { return compose_picture(facts_, view_, now_); }
  void add_mate(const std::string& id, double x_m, double y_m, Duration age = {},
                std::uint8_t trust = 80) {
    facts_.mates.push_back({id, Pose2{x_m, y_m, 0.0}, trust, now_ - age});
  }
  std::vector<std::string> titles() {
    std::vector<std::string> titles;
    for (const auto& band : compose().bands) titles.push_back(band.title);
    return titles;
  }

  SteadyTime now_{std::chrono::hours(1)};
  HudFacts facts_ = test::sound_facts(now_);
  std::optional<WayOut> way_out_;
  HudView view_{{}, &way_out_, 8.0, 0.0, std::nullopt};
};

TEST_F(HudPictureTest, TrustIsShownInFourSteps) {
  for (const auto& [percent, bars] :
       {std::pair{1, 1}, {25, 1}, {26, 2}, {50, 2}, {75, 3}, {76, 4}, {100, 4}}) {
    facts_.state.trust_percent = static_cast<std::uint8_t>(percent);
    EXPECT_EQ(compose().trust_bars, bars) << percent;
  }
  facts_.state.trust_percent = 0;
  EXPECT_EQ(compose().trust_bars, 0);
  EXPECT_FALSE(compose().position_known);
}

TEST_F(HudPictureTest, LinkBarsFallWithWhoIsStillHeard) {
  EXPECT_EQ(compose().link_bars, 4);
  facts_.pose_loss = 0.2;
  EXPECT_EQ(compose().link_bars, 3);
  facts_.pose_loss = 0.6;
  EXPECT_EQ(compose().link_bars, 2);
  facts_.pose_loss = 0.0;
  facts_.tiles_behind = 50;
  EXPECT_EQ(compose().link_bars, 3);
  facts_.command_at = now_ - seconds(3);
  EXPECT_EQ(compose().link_bars, 2) << "team-mates alone";
  facts_.mate_at = now_ - seconds(4);
  EXPECT_EQ(compose().link_bars, 1);
  now_ += seconds(3);
  EXPECT_EQ(compose().link_bars, 0);
}

TEST_F(HudPictureTest, TheMapsAgeGrowsWhenNobodyIsHeard) {
  facts_.shares = true;
  now_ += seconds(14);
  facts_.mapped_at = now_;
  EXPECT_TRUE(compose().shared);
  EXPECT_DOUBLE_EQ(compose().map_age_s.value(), 14.0);
  facts_.shares = false;
  EXPECT_DOUBLE_EQ(compose().map_age_s.value(), 0.0) << "the own map is as new as its scans";
  facts_.mapped_at.reset();
  EXPECT_FALSE(compose().map_age_s) << "nothing was mapped yet";
}

TEST_F(HudPictureTest, MatesAreNamedDimmedWhenOldAndAskedForWhenTheyKnowNoPlace) {
  add_mate("ff12", 3.0, 4.0);
  add_mate("bravo", 1.0, 0.0, seconds(35));
  add_mate("charlie", 1.0, 0.0, {}, 0);
  facts_.mates.push_back({"unplaced", std::nullopt, 90, now_});
  const auto mates = compose().mates;
  ASSERT_EQ(mates.size(), 3U) << "who lies on no common map has no place";
  EXPECT_EQ(mates[0].mark.label, "F12");
  EXPECT_DOUBLE_EQ(mates[0].distance_m.value(), 5.0);
  EXPECT_FALSE(mates[0].stale);
  EXPECT_TRUE(mates[1].stale);
  EXPECT_DOUBLE_EQ(mates[1].age_s, 35.0);
  EXPECT_TRUE(mates[1].heading_rad);
  EXPECT_FALSE(mates[2].heading_rad);
}

TEST_F(HudPictureTest, AMaydayNamesWhoWhereAndWhichWay) {
  add_mate("bravo", 0.0, 6.0);
  auto mayday = test::open_alert(AlertKind::mayday, "bravo", "bravo");
  mayday.text = "no air";
  facts_.alerts.push_back(mayday);
  const auto picture = compose();
  ASSERT_EQ(picture.bands.size(), 1U);
  const HudBand& band = picture.bands[0];
  EXPECT_EQ(band.title, "MAYDAY bravo");
  EXPECT_EQ(band.detail, "no air");
  EXPECT_DOUBLE_EQ(band.distance_m.value(), 6.0);
  EXPECT_NEAR(band.bearing_rad.value(), std::numbers::pi / 2.0, 1e-9) << "to the left";
  EXPECT_TRUE(band.waits);
  EXPECT_TRUE(picture.mates[0].calls_for_help);
  EXPECT_FALSE(picture.hold_cancels) << "it is not one's own";
}

TEST_F(HudPictureTest, AMaydayFlashesUntilItIsAnswered) {
  facts_.alerts.push_back(test::open_alert(AlertKind::mayday, "bravo", "bravo"));
  const bool now = compose().bands.at(0).flash;
  now_ += std::chrono::milliseconds(500);
  EXPECT_NE(compose().bands.at(0).flash, now);
  facts_.alerts[0].answered = true;
  EXPECT_FALSE(compose().bands.at(0).flash);
  now_ += std::chrono::milliseconds(500);
  EXPECT_FALSE(compose().bands.at(0).flash);
}

TEST_F(HudPictureTest, AMaydayFromNowhereSaysThat) {
  facts_.alerts.push_back(test::open_alert(AlertKind::mayday, "bravo", "bravo"));
  EXPECT_EQ(compose().bands.at(0).detail, "place unknown");
  EXPECT_FALSE(compose().bands.at(0).distance_m);
}

TEST_F(HudPictureTest, WhatWaitsForAnAnswerComesFirst) {
  auto own = test::open_alert(AlertKind::mayday, "alpha", "alpha");
  own.own = true;
  auto seen = test::open_alert(AlertKind::mayday, "bravo", "bravo");
  seen.answered = true;
  facts_.alerts = {own, seen, test::open_alert(AlertKind::roll_call, "vehicle"),
                   test::open_alert(AlertKind::mayday, "zulu", "zulu"),
                   test::open_alert(AlertKind::evacuate, "vehicle")};
  EXPECT_THAT(titles(),
              ElementsAre("EVACUATE", "MAYDAY zulu", "PAR?", "MAYDAY SENT", "MAYDAY bravo"));
  EXPECT_TRUE(compose().hold_cancels);
}

TEST_F(HudPictureTest, ARollCallThatWasAnsweredIsGoneAndAnEvacuationStays) {
  facts_.alerts = {test::open_alert(AlertKind::roll_call, "vehicle"),
                   test::open_alert(AlertKind::evacuate, "vehicle")};
  for (auto& alert : facts_.alerts) alert.answered = true;
  EXPECT_THAT(titles(), ElementsAre("EVACUATE"));
}

TEST_F(HudPictureTest, TheOwnMaydaySaysWhetherTheCommandHasSeenIt) {
  auto own = test::open_alert(AlertKind::mayday, "alpha", "alpha");
  own.own = true;
  facts_.alerts = {own};
  EXPECT_EQ(compose().bands.at(0).detail, "nobody has answered yet");
  facts_.alerts[0].seen_by_command = true;
  EXPECT_EQ(compose().bands.at(0).detail, "command has seen it");
}

TEST_F(HudPictureTest, WhereThePositionIsLostNoWayIsShown) {
  way_out_ = WayOut{{{0.0, 0.0}, {10.0, 0.0}}, 10.0, false};
  add_mate("bravo", 3.0, 4.0);
  EXPECT_TRUE(compose().way_out);
  facts_.state.state = wire::AgentState::lost;
  facts_.state.trust_percent = 0;
  view_.lost_since = now_ - seconds(12);
  const auto picture = compose();
  EXPECT_FALSE(picture.way_out);
  EXPECT_FALSE(picture.heading_known);
  EXPECT_EQ(picture.trust_bars, 0);
  EXPECT_FALSE(picture.mates.at(0).distance_m) << "from where?";
  ASSERT_EQ(picture.bands.size(), 1U);
  EXPECT_EQ(picture.bands[0].title, "POSITION LOST");
  EXPECT_EQ(picture.bands[0].detail, "for 12 s");
}

TEST_F(HudPictureTest, WhereToSearchIsShownWhileNothingMoreUrgentIs) {
  facts_.search = SearchFacts{{3.0, 4.0}, 6.5};
  ASSERT_TRUE(compose().search);
  EXPECT_EQ(compose().search->p_map_m, Eigen::Vector2d(3.0, 4.0));
  EXPECT_EQ(compose().search->distance_m, 6.5);
  facts_.alerts = {test::open_alert(AlertKind::roll_call, "vehicle")};
  EXPECT_TRUE(compose().search);
  for (const AlertKind kind : {AlertKind::mayday, AlertKind::evacuate}) {
    facts_.alerts = {test::open_alert(kind, "vehicle", "bravo")};
    facts_.alerts[0].answered = true;
    EXPECT_FALSE(compose().search) << "answered, but not over";
  }
  facts_.alerts.clear();
  facts_.state.state = wire::AgentState::lost;
  facts_.state.trust_percent = 0;
  EXPECT_FALSE(compose().search) << "from where?";
}

TEST_F(HudPictureTest, TheHeadingIsUnknownWhereNeitherSensorNorMatchTellsIt) {
  facts_.state.attitude = wire::SensorHealth::silent;
  EXPECT_TRUE(compose().heading_known) << "a good match tells it";
  facts_.state.state = wire::AgentState::weak;
  EXPECT_FALSE(compose().heading_known);
  EXPECT_TRUE(compose().position_known);
}

TEST_F(HudPictureTest, TheArrowPointsAlongTheWayAndNotAtItsEnd) {
  view_.T_map_head = {0.0, 0.0, std::numbers::pi / 2.0};
  way_out_ = WayOut{{{0.0, 0.0}, {6.0, 0.0}, {6.0, 20.0}}, 26.0, true};
  const auto way = compose().way_out.value();
  EXPECT_NEAR(way.bearing_rad, -std::numbers::pi / 2.0, 1e-9) << "to the right";
  EXPECT_TRUE(way.by_own_trail);
  EXPECT_FALSE(way.arrived);
}

}  // namespace
}  // namespace lifeline::hud
