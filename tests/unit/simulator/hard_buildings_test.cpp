// What makes a building hard, through the source as its users name it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/paper_buildings.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

std::string refused(const std::string& source) {
  const auto opened = open_simulated_source(parse_source_spec(source).value());
  return opened ? "" : opened.error().text;
}

double share_without_reading(const std::string& source) {
  double none = 0.0, all = 0.0;
  for (const auto& scan : support::scans_of(source, 50)) {
    for (const float range_m : scan.ranges_m) {
      none += range_m > 0.0F && std::isfinite(range_m) ? 0.0 : 1.0;
      all += 1.0;
    }
  }
  return none / all;
}

TEST(HardBuilding, EachHardshipChangesTheScansAndNeitherWalkNorNoise) {
  const std::string base = "sim:office?duration=12&beams=60&doors=timetable&head=nodding";
  const auto plain = support::scans_of(base);
  for (const char* more :
       {"&glass=0.6", "&black=0.3", "&people=12", "&smoke=3", "&ceiling_spread=0.5"}) {
    const auto hard = support::scans_of(base + more), again = support::scans_of(base + more);
    ASSERT_EQ(hard.size(), plain.size()) << more;
    bool differs = false;
    for (std::size_t i = 0; i < hard.size(); ++i) {
      EXPECT_EQ(hard[i].T_world_head_truth->x_m, plain[i].T_world_head_truth->x_m) << more;
      EXPECT_EQ(hard[i].attitude->yaw_rad, plain[i].attitude->yaw_rad) << more;
      EXPECT_EQ(hard[i].ranges_m, again[i].ranges_m) << more;
      differs = differs || hard[i].ranges_m != plain[i].ranges_m;
    }
    EXPECT_TRUE(differs) << more;
  }
}

TEST(HardBuilding, BlackFacesTakeReadingsAway) {
  const std::string base = "sim:office?beams=180&dropout=0";
  EXPECT_EQ(share_without_reading(base), 0.0);
  EXPECT_GT(share_without_reading(base + "&black=0.5"), 0.2);
}

TEST(HardBuilding, NobodyComesCloserThanPeopleMakeWay) {
  const auto alone = support::scans_of("sim:testbed?duration=30&beams=90&noise=0&dropout=0");
  const auto crowd =
      support::scans_of("sim:testbed?duration=30&beams=90&noise=0&dropout=0&people=8");
  int nearer = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    for (std::size_t k = 0; k < 90; ++k) {
      if (crowd[i].ranges_m[k] == alone[i].ranges_m[k]) continue;
      EXPECT_LT(crowd[i].ranges_m[k], alone[i].ranges_m[k]);
      EXPECT_GE(crowd[i].ranges_m[k], 0.7F - 0.221F);
      ++nearer;
    }
  }
  EXPECT_GT(nearer, 100);
}

TEST(HardBuilding, WhoCrawlsIsLowAndSlow) {
  const auto upright = support::scans_of("sim:office?duration=20&beams=4&head=natural");
  const auto crawling = support::scans_of("sim:office?duration=20&beams=4&head=crawling");
  const auto way_m = [](const std::vector<sensing::RawScan>& scans) {
    double sum = 0.0;
    for (std::size_t i = 1; i < scans.size(); ++i) {
      sum += (scans[i].T_world_head_truth->translation() -
              scans[i - 1].T_world_head_truth->translation())
                 .norm();
    }
    return sum;
  };
  EXPECT_LT(way_m(crawling), 0.6 * way_m(upright));
  EXPECT_GT(way_m(crawling), 2.0);
  // 0.6 m above the floor, a beam ahead of a nose that is 15 deg down ends within 2.6 m.
  int low = 0;
  for (const auto& scan : crawling) {
    if (scan.attitude->pitch_rad < 0.26) continue;
    EXPECT_LT(scan.ranges_m[2], 2.7F);
    ++low;
  }
  EXPECT_GT(low, 0);
}

TEST(HardBuilding, WhatCannotBeIsRefusedInOneLine) {
  EXPECT_NE(refused("sim:office?glass=2").find("glass"), std::string::npos);
  EXPECT_NE(refused("sim:office?ceiling_spread=1").find("lower than 2 m"), std::string::npos);
  EXPECT_NE(refused("sim:meeting?width=30").find("size of its own"), std::string::npos);
  EXPECT_NE(refused("sim:office?smoke=0").find("smoke"), std::string::npos);
}

TEST(PaperBuilding, EveryRoomOfEachCanBeWalkedIntoWhateverTheSeed) {
  for (const NamedBuilding& named : kPaperBuildings) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      const FloorPlan plan = generate_paper_building(named.building, seed);
      const auto space = FreeSpace::make(plan);
      ASSERT_TRUE(space) << plan.name;
      for (const Eigen::AlignedBox2d& room : plan.rooms) {
        bool entered = false;
        for (std::size_t i = 0; i < space->size() && !entered; ++i) {
          const CellIndex cell = space->cell(i);
          entered = space->is_walkable(cell) && room.contains(space->centre(cell));
        }
        EXPECT_TRUE(entered) << plan.name << ": a room at " << room.center().transpose();
      }
    }
  }
}

TEST(PaperBuilding, HasWhatThePaperSaysOfIt) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const FloorPlan testbed = generate_paper_building(PaperBuilding::testbed, seed);
    const FloorPlan rearranged = generate_paper_building(PaperBuilding::rearranged, seed);
    const FloorPlan meeting = generate_paper_building(PaperBuilding::meeting, seed);
    const FloorPlan karaoke = generate_paper_building(PaperBuilding::karaoke, seed);

    EXPECT_NEAR(testbed.bounds().sizes().maxCoeff(), 14.0, 1e-9);
    EXPECT_NEAR(rearranged.bounds().sizes().maxCoeff(), 14.0, 1e-9);
    EXPECT_NEAR(karaoke.bounds().sizes().maxCoeff(), 18.0, 1e-9);
    EXPECT_GE(testbed.rooms.size(), 4U);
    EXPECT_NE(testbed.walls.size(), 0U);
    EXPECT_FALSE(testbed.rooms.size() == rearranged.rooms.size() &&
                 testbed.rooms.front().isApprox(rearranged.rooms.front()));
    EXPECT_GE(meeting.panes.size(), 3U) << seed;
    EXPECT_GE(std::count(meeting.materials.begin(), meeting.materials.end(), Material::glass), 2)
        << seed;
    EXPECT_TRUE(std::all_of(karaoke.doorways.begin(), karaoke.doorways.end(),
                            [](const Doorway& door) { return door.glass; }));
    EXPECT_EQ(karaoke.ceilings.size(), karaoke.rooms.size());
  }
}

TEST(PaperBuilding, NoPaneIsWalkedThrough) {
  const FloorPlan plan = generate_paper_building(PaperBuilding::meeting, 3);
  const auto scans = support::scans_of("sim:meeting?seed=3&beams=4");
  for (const auto& scan : scans) {
    for (const WallSegment& pane : plan.panes) {
      ASSERT_GE(distance_to(pane, scan.T_world_head_truth->translation()), 0.24);
    }
  }
}

}  // namespace
}  // namespace lifeline::sources
