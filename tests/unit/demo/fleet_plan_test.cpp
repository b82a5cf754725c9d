#include "deploy/demo/fleet_plan.hpp"

#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline::demo {
namespace {

using testing::HasSubstr;

std::vector<Timestamp> stamps_at(std::initializer_list<double> seconds) {
  std::vector<Timestamp> stamps;
  for (const double s : seconds) stamps.emplace_back(from_seconds(s));
  return stamps;
}

/// A log of `scans` scans, one every 4 seconds.
std::string write_log(const std::string& name, int scans) {
  const std::string path = testing::TempDir() + name;
  std::ofstream log(path);
  for (int i = 0; i < scans; ++i) {
    log << "FLASER 180";
    for (int beam = 0; beam < 180; ++beam) log << " 2.5";
    log << " 0 0 0 0 0 0 " << 1000 + 4 * i << " host " << 4 * i << "\n";
  }
  return path;
}

TEST(HelmetName, is_another_one_for_each_helmet) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kMostHelmets; ++i) names.insert(helmet_name(i));
  EXPECT_EQ(names.size(), kMostHelmets);
  EXPECT_EQ(helmet_name(2), "charlie");
}

TEST(PlanWalk, gives_each_helmet_a_walker_of_its_own_in_the_same_building) {
  const auto fleet = plan_walk({.plan = "office", .duration_s = 120.0, .speed = 2.5, .seed = 7}, 2);
  ASSERT_TRUE(fleet);
  ASSERT_EQ(fleet->helmets.size(), 2U);
  EXPECT_EQ(fleet->helmets[0].source,
            "sim:office?walkers=2&walker=0&seed=7&duration=120&victims=3&tags=1&rate=x2.5");
  EXPECT_EQ(fleet->helmets[1].source,
            "sim:office?walkers=2&walker=1&seed=7&duration=120&victims=3&tags=1&rate=x2.5");
  EXPECT_DOUBLE_EQ(fleet->play_s, 48.0);
}

TEST(PlanWalk, knows_what_is_to_be_found_and_where) {
  const auto fleet = plan_walk({.duration_s = 120.0}, 2);
  ASSERT_TRUE(fleet);
  ASSERT_EQ(fleet->finds.size(), 4U);
  EXPECT_EQ(fleet->finds.front().kind, "victim");
  EXPECT_EQ(fleet->finds.back().kind, "uwb_tag");
  for (const TrueFind& find : fleet->finds) {
    EXPECT_GT(find.x_m, 0.0);
    EXPECT_LT(find.x_m, 22.0);
    EXPECT_GT(find.y_m, 0.0);
    EXPECT_LT(find.y_m, 16.0);
  }
}

TEST(PlanWalk, names_a_plan_that_is_not_there) {
  const auto fleet = plan_walk({.plan = "/lifeline/none.json", .duration_s = 1.0}, 1);
  ASSERT_FALSE(fleet);
  EXPECT_NE(fleet.error().text.find("/lifeline/none.json"), std::string::npos);
}

TEST(CutLog, gives_every_scan_to_exactly_one_piece) {
  const auto pieces = cut_log(stamps_at({0, 1, 2, 3, 4, 5, 6}), 3);
  ASSERT_TRUE(pieces);
  ASSERT_EQ(pieces->size(), 3U);
  EXPECT_EQ(pieces->front().from, 0U);
  EXPECT_EQ(pieces->back().to, 7U);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_EQ((*pieces)[i].from, (*pieces)[i - 1].to);
  for (const LogPiece& piece : *pieces) EXPECT_GE(piece.to - piece.from, 2U);
}

TEST(CutLog, measures_the_recorded_time_within_each_piece) {
  const auto pieces = cut_log(stamps_at({10, 12, 20, 50}), 2);
  ASSERT_TRUE(pieces);
  EXPECT_DOUBLE_EQ((*pieces)[0].recorded_s, 2.0);
  EXPECT_DOUBLE_EQ((*pieces)[1].recorded_s, 30.0);
}

TEST(CutLog, measures_to_the_latest_scan_where_times_go_back) {
  const auto pieces = cut_log(stamps_at({10, 19, 17}), 1);
  ASSERT_TRUE(pieces);
  EXPECT_DOUBLE_EQ(pieces->front().recorded_s, 9.0);
}

TEST(CutLog, refuses_pieces_of_a_single_scan) {
  const auto pieces = cut_log(stamps_at({1, 2, 3}), 2);
  ASSERT_FALSE(pieces);
  EXPECT_THAT(pieces.error().text, HasSubstr("3 scans"));
}

TEST(PlanLog, plays_each_piece_in_about_the_time_given) {
  const std::string path = write_log("plan.log", 20);
  const auto fleet = plan_log(path, 2, 9.0);
  ASSERT_TRUE(fleet) << fleet.error().text;
  ASSERT_EQ(fleet->helmets.size(), 2U);
  EXPECT_EQ(fleet->helmets[0].source, "carmen:" + path + "?from=0&to=10&prior=odom&rate=x4.00");
  EXPECT_EQ(fleet->helmets[1].source, "carmen:" + path + "?from=10&to=20&prior=odom&rate=x4.00");
  EXPECT_DOUBLE_EQ(fleet->play_s, 9.0);
}

TEST(PlanLog, names_a_log_that_is_too_short) {
  const std::string path = write_log("short.log", 3);
  const auto fleet = plan_log(path, 2, 9.0);
  ASSERT_FALSE(fleet);
  EXPECT_THAT(fleet.error().text, HasSubstr(path));
  EXPECT_THAT(fleet.error().text, HasSubstr("too few"));
}

TEST(PlanLog, names_a_log_that_is_not_there) {
  const auto fleet = plan_log("/nowhere/at/all.log", 2, 9.0);
  ASSERT_FALSE(fleet);
  EXPECT_EQ(fleet.error().code, ErrorCode::not_found);
  EXPECT_THAT(fleet.error().text, HasSubstr("/nowhere/at/all.log"));
}

}  // namespace
}  // namespace lifeline::demo
