#include "agents/sources/simulator/simulated_source.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "agents/sensing/head_projection.hpp"
#include "common/base/quantile.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Error open_error(const std::string& source) {
  const auto opened = open_simulated_source(parse_source_spec(source).value());
  EXPECT_FALSE(opened.has_value()) << source;
  return opened ? Error{} : opened.error();
}

bool same_scans(const std::vector<sensing::RawScan>& a, const std::vector<sensing::RawScan>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& u, const auto& v) {
    return u.ranges_m == v.ranges_m && u.stamp == v.stamp &&
           u.attitude->yaw_rad == v.attitude->yaw_rad &&
           u.T_world_head_truth->x_m == v.T_world_head_truth->x_m &&
           u.T_world_head_truth->y_m == v.T_world_head_truth->y_m &&
           u.T_world_head_truth->yaw_rad == v.T_world_head_truth->yaw_rad;
  });
}

TEST(SimulatedSource, GivesTenScansASecondForAsLongAsAsked) {
  const auto scans = support::scans_of("sim:office?duration=3&beams=90");

  ASSERT_EQ(scans.size(), 30U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(scans[i].ranges_m.size(), 90U);
    EXPECT_EQ(scans[i].stamp - scans[0].stamp,
              std::chrono::milliseconds(100) * static_cast<int>(i));
    EXPECT_TRUE(scans[i].attitude.has_value());
    EXPECT_TRUE(scans[i].T_world_head_truth.has_value());
    EXPECT_FALSE(scans[i].T_odom_head.has_value());
  }
}

TEST(SimulatedSource, IsAnRplidarA3ByDefault) {
  const auto scans = support::scans_of("sim:office", 1);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].ranges_m.size(), 1600U);
  EXPECT_DOUBLE_EQ(scans[0].range_max_m, 25.0);
  EXPECT_EQ(scans[0].sweep_time, Duration::zero());
}

TEST(SimulatedSource, WithoutADurationTheWalkEndsWhenEverythingWasSeen) {
  const auto scans = support::scans_of("sim:office?width=10&depth=10&beams=8");
  EXPECT_GT(scans.size(), 200U);
  EXPECT_LT(scans.size(), 3000U);
}

TEST(SimulatedSource, IsTheSameBitForBitForTheSameOptions) {
  const std::string source =
      "sim:office?seed=3&walk_seed=5&walker=1&walkers=2&duration=5&beams=100";
  EXPECT_TRUE(same_scans(support::scans_of(source), support::scans_of(source)));
}

TEST(SimulatedSource, EverySeedMatters) {
  const auto scans = support::scans_of("sim:office?duration=2&beams=100");
  for (const char* option : {"seed=9", "walk_seed=9", "walker=1", "walkers=3&walker=2"}) {
    const auto others = support::scans_of(std::string("sim:office?duration=2&beams=100&") + option);
    EXPECT_FALSE(same_scans(scans, others)) << option;
  }
}

TEST(SimulatedSource, TheWalksSeedIsTheBuildingsWhereItIsNotGiven) {
  const std::string source = "sim:office?duration=2&beams=100&seed=5";
  EXPECT_TRUE(same_scans(support::scans_of(source), support::scans_of(source + "&walk_seed=5")));
  EXPECT_FALSE(same_scans(support::scans_of(source), support::scans_of(source + "&walk_seed=1")));
}

TEST(SimulatedSource, WalkersOfOneBuildingSeeTheSameWalls) {
  const auto spec = parse_source_spec("sim:office?seed=4").value();
  const FloorPlan plan = load_plan(spec).value();
  for (const char* walker : {"0", "1", "2"}) {
    const auto scans = support::scans_of(
        std::string("sim:office?seed=4&duration=4&beams=60&noise=0&dropout=0&walkers=3&walker=") +
        walker);
    for (const auto& scan : scans) {
      for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
        const double angle = scan.first_angle_rad + scan.angle_step_rad * static_cast<double>(i);
        const double range = scan.ranges_m[i];
        if (!std::isfinite(range)) continue;
        const Eigen::Vector2d p_world =
            *scan.T_world_head_truth *
            Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle));
        double off = 1.0;
        for (const auto& wall : plan.walls) off = std::min(off, distance_to(wall, p_world));
        EXPECT_LT(off, 0.001);
      }
    }
  }
}

/// Distance of every hit from the nearest wall, after the helmet's own projection.
std::vector<double> hits_off_walls(const std::string& source,
                                   const sensing::ProjectionConfig& config) {
  const FloorPlan plan = load_plan(parse_source_spec(source).value()).value();
  std::vector<double> off;
  for (const auto& scan : support::scans_of(source)) {
    for (const Beam2& beam : sensing::project_scan(scan, config).beams) {
      if (beam.kind != BeamKind::hit) continue;
      const Eigen::Vector2d p_world =
          *scan.T_world_head_truth * Eigen::Vector2d(beam.x_m, beam.y_m);
      double nearest = 1e3;
      for (const auto& wall : plan.walls) nearest = std::min(nearest, distance_to(wall, p_world));
      off.push_back(nearest);
    }
  }
  return off;
}

/// A helmet's own defaults: the simulated head agrees with them.
const sensing::ProjectionConfig kHeights;

TEST(SimulatedSource, WhatANoddingHeadSeesLiesOnTheWallsAfterProjection) {
  const auto off = hits_off_walls(
      "sim:office?head=natural&duration=40&hz=2&beams=120&noise=0&dropout=0", kHeights);
  ASSERT_GT(off.size(), 5000U);
  EXPECT_LT(quantile(off, 0.5), 0.01);
  EXPECT_LT(quantile(off, 0.99), 0.06);  // 0.2 deg of tilt noise
  EXPECT_LT(quantile(off, 0.999), 0.3);
}

TEST(SimulatedSource, ANoddingHeadMeetsFloorAndCeilingWithinReach) {
  int level_short = 0, leaning_short = 0;
  for (const char* head : {"still", "natural"}) {
    const std::string source = std::string("sim:office?width=40&duration=30&beams=90&head=") + head;
    for (const auto& scan : support::scans_of(source)) {
      const auto beams = sensing::project_scan(scan, kHeights).beams;
      for (std::size_t i = 0; i < beams.size(); ++i) {
        const bool cut = beams[i].kind == BeamKind::invalid && scan.ranges_m[i] > 0.0F &&
                         std::isfinite(scan.ranges_m[i]);
        (std::string(head) == "still" ? level_short : leaning_short) += cut ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(level_short, 0);
  EXPECT_GT(leaning_short, 50);
}

TEST(SimulatedSource, ASweepOfANoddingHeadLiesOnTheWallsOnceItsOwnMotionIsUndone) {
  // Standing still at the start: the second in which nobody walks yet.
  const std::string source =
      "sim:office?head=nodding&sweep=on&duration=1&beams=120&noise=0&dropout=0";
  const auto off = hits_off_walls(source, kHeights);
  ASSERT_GT(off.size(), 500U);
  EXPECT_LT(quantile(off, 0.5), 0.015);
  EXPECT_LT(quantile(off, 0.99), 0.1);  // 0.2 deg of tilt noise, at 25 deg
  std::size_t knots = 0;
  for (const auto& scan : support::scans_of(source)) knots += scan.later_attitudes.size();
  EXPECT_EQ(knots, 90U);
}

TEST(SimulatedSource, WithoutSweepsTheAttitudeIsOneForTheWholeScan) {
  for (const auto& scan : support::scans_of("sim:office?head=nodding&duration=1&beams=8")) {
    EXPECT_TRUE(scan.later_attitudes.empty());
  }
}

TEST(SimulatedSource, TheHeadsAttitudeIsLevelUnlessItMoves) {
  for (const auto& scan : support::scans_of("sim:office?duration=2&beams=8")) {
    EXPECT_EQ(scan.attitude->pitch_rad, 0.0);
    EXPECT_EQ(scan.attitude->roll_rad, 0.0);
  }
  double pitched = 0.0;
  for (const auto& scan : support::scans_of("sim:office?duration=20&beams=8&head=natural")) {
    pitched = std::max(pitched, std::abs(scan.attitude->pitch_rad));
  }
  EXPECT_GT(pitched, 0.07);
}

TEST(SimulatedSource, DoorsChangeWhatIsSeenAndNotTheWalk) {
  const std::string source = "sim:office?duration=30&beams=200&noise=0&dropout=0";
  const auto without = support::scans_of(source);
  for (const char* doors : {"&doors=beside", "&doors=timetable"}) {
    const auto with = support::scans_of(source + doors);
    ASSERT_EQ(with.size(), without.size());
    int changed = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
      EXPECT_EQ(with[i].T_world_head_truth->x_m, without[i].T_world_head_truth->x_m);
      EXPECT_EQ(with[i].attitude->yaw_rad, without[i].attitude->yaw_rad);
      for (std::size_t k = 0; k < with[i].ranges_m.size(); ++k) {
        EXPECT_LE(with[i].ranges_m[k], without[i].ranges_m[k]);  // a closed door only hides
        changed += with[i].ranges_m[k] < without[i].ranges_m[k] ? 1 : 0;
      }
    }
    EXPECT_GT(changed, 100) << doors;
    EXPECT_TRUE(same_scans(with, support::scans_of(source + doors)));
  }
}

TEST(SimulatedSource, WithoutAPriorThereIsNoAttitude) {
  for (const auto& scan : support::scans_of("sim:office?prior=none&duration=1&beams=8")) {
    EXPECT_FALSE(scan.attitude.has_value());
  }
  for (const auto& scan : support::scans_of("sim:office?prior=ahrs&duration=1&beams=8")) {
    EXPECT_TRUE(scan.attitude.has_value());
  }
}

TEST(SimulatedSource, TheAttitudeFollowsTheTruth) {
  const auto scans = support::scans_of("sim:office?duration=60&beams=4");
  const auto offset = [&](const sensing::RawScan& scan) {
    return normalise_angle(scan.attitude->yaw_rad - scan.T_world_head_truth->yaw_rad);
  };
  for (const auto& scan : scans) {
    EXPECT_LT(std::abs(normalise_angle(offset(scan) - offset(scans.front()))), 0.08);
  }
}

TEST(SimulatedSource, HzAndSweepSetTheTimesOfBeams) {
  const auto scans = support::scans_of("sim:office?hz=5&sweep=on&duration=2&beams=100");
  ASSERT_EQ(scans.size(), 10U);
  EXPECT_EQ(scans[1].stamp - scans[0].stamp, std::chrono::milliseconds(200));
  EXPECT_NEAR(to_seconds(scans[0].sweep_time), 0.198, 1e-6);
}

TEST(SimulatedSource, WalksThroughAHouseExpoPlan) {
  const auto files = support::houseexpo_files();
  if (files.empty()) GTEST_SKIP() << "the HouseExpo plans are not here";
  const auto scans = support::scans_of("sim:" + files.front().string() + "?duration=5&beams=90");
  EXPECT_EQ(scans.size(), 50U);
}

TEST(SimulatedSource, AtItsEndItStaysAtItsEnd) {
  auto source = open_simulated_source(parse_source_spec("sim:office?duration=0.1&beams=8").value());
  ASSERT_TRUE((*source)->next().value().has_value());
  for (int i = 0; i < 3; ++i) EXPECT_FALSE((*source)->next().value().has_value());
}

TEST(SimulatedSource, RefusesUnknownAndSenselessOptions) {
  for (const char* options :
       {"duration=0",  "duration=-3", "duration=nan", "duration=inf",  "duration=1e9",
        "duration=x",  "beams=0",     "beams=-1",     "beams=1000000", "beams=3.5",
        "hz=0",        "hz=1e9",      "noise=-1",     "noise=2",       "dropout=2",
        "sweep=maybe", "prior=odom",  "seed=-1",      "seed=abc",      "walk_seed=-1",
        "walker=-1",   "walker=16",   "walkers=0",    "walkers=17",    "walkers=3&walker=3",
        "head=bald",   "ceiling=1",   "doors=ajar",   "width=5",       "depth=1000",
        "speed=3",     "Duration=3"}) {
    const Error error = open_error(std::string("sim:office?") + options);
    EXPECT_EQ(error.code, ErrorCode::wrong_use) << options;
    const std::string text(options);
    const std::size_t last = text.find('&') == std::string::npos ? 0 : text.find('&') + 1;
    EXPECT_THAT(error.text, HasSubstr(text.substr(last, text.find('=', last) - last)));
    EXPECT_THAT(error.text, Not(HasSubstr("\n")));
  }
}

TEST(SimulatedSource, RefusesPlansThatAreNotThere) {
  const support::TemporaryFolder folder;
  const std::string missing = (folder.path() / "none.json").string();
  EXPECT_EQ(open_error("sim:" + missing).code, ErrorCode::not_found);
  EXPECT_THAT(open_error("sim:" + missing).text, HasSubstr(missing));

  EXPECT_EQ(open_error("sim:castle").code, ErrorCode::wrong_use);
  EXPECT_THAT(open_error("sim:castle").text, HasSubstr("no plan 'castle'"));

  EXPECT_EQ(open_error("sim:map.png").code, ErrorCode::not_found);
  EXPECT_EQ(open_error("sim:map.pgm").code, ErrorCode::wrong_use);
}

TEST(SimulatedSource, RefusesPlansThatNobodyCanWalkIn) {
  const support::TemporaryFolder folder;
  const auto file =
      folder.write("slot.json", R"({"verts":[[0,0],[50,0],[50,1],[49,0.3],[0,0.3]]})");
  const Error error = open_error("sim:" + file.string());
  EXPECT_EQ(error.code, ErrorCode::bad_data);
  EXPECT_THAT(error.text, HasSubstr("no floor that is wide enough"));
}

TEST(LoadPlan, GivesTheBuildingTheOptionsName) {
  const auto plan = load_plan(parse_source_spec("sim:office?width=30&depth=12&walker=3").value());
  ASSERT_TRUE(plan.has_value());
  EXPECT_NEAR(plan->bounds().sizes().y(), 12.0, 1e-9);
  EXPECT_GT(plan->bounds().sizes().x(), 20.0);

  EXPECT_FALSE(load_plan(parse_source_spec("sim:office?width=3").value()).has_value());
  EXPECT_FALSE(load_plan(parse_source_spec("sim:none.json").value()).has_value());
}

}  // namespace
}  // namespace lifeline::sources
