#include "agents/sources/simulator/picture_plan.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

using ::testing::HasSubstr;

/// `.` is floor; row by row from above.
files::GreyImage drawn(const std::vector<std::string>& rows) {
  files::GreyImage picture{.width = static_cast<int>(rows.front().size()),
                           .height = static_cast<int>(rows.size()),
                           .shades = {},
                           .alphas = {}};
  for (const std::string& row : rows) {
    for (const char pixel : row) picture.shades.push_back(pixel == '.' ? 255 : 0);
  }
  return picture;
}

TEST(PlanFromPicture, BordersBecomeTheLongestPossibleWalls) {
  const FloorPlan plan = plan_from_picture(drawn({"#####",  //
                                                  "#...#",  //
                                                  "#...#",  //
                                                  "#####"}),
                                           "p")
                             .value();
  EXPECT_EQ(plan.walls.size(), 4U);
  EXPECT_NEAR(plan.floor_area_m2(), 6 * 0.05 * 0.05, 1e-12);
  EXPECT_NEAR((plan.bounds().min() - Eigen::Vector2d(0.05, 0.05)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((plan.bounds().max() - Eigen::Vector2d(0.20, 0.15)).norm(), 0.0, 1e-12);
}

TEST(PlanFromPicture, FirstRowIsTheTopAndThePicturesEdgeIsAWall) {
  const FloorPlan plan = plan_from_picture(drawn({"..#",  //
                                                  "###"}),
                                           "p")
                             .value();
  EXPECT_TRUE(plan.is_floor({0.025, 0.075}));
  EXPECT_FALSE(plan.is_floor({0.025, 0.025}));
  EXPECT_EQ(plan.walls.size(), 4U);
}

TEST(PlanFromPicture, FloorBeginsAtTheThreshold) {
  auto picture = drawn({".."});
  picture.shades = {250, 249};
  const FloorPlan plan = plan_from_picture(picture, "p").value();
  EXPECT_TRUE(plan.is_floor({0.025, 0.025}));
  EXPECT_FALSE(plan.is_floor({0.075, 0.025}));
}

TEST(PlanFromPicture, WhatIsNotOpaqueCountsAsWhite) {
  auto picture = drawn({"##"});
  picture.alphas = {0, 255};
  const FloorPlan plan = plan_from_picture(picture, "p").value();
  EXPECT_TRUE(plan.is_floor({0.025, 0.025}));
  EXPECT_FALSE(plan.is_floor({0.075, 0.025}));
}

TEST(PlanFromPicture, RandomPicturesGiveTheirOwnFloorBack) {
  Draw draw(3);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<std::string> rows(9, std::string(13, '#'));
    for (auto& row : rows) {
      for (char& pixel : row) pixel = draw.chance(0.5) ? '.' : '#';
    }
    const FloorPlan plan = plan_from_picture(drawn(rows), "p").value();
    int floor_pixels = 0;
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 13; ++x) {
        const bool floor =
            rows[static_cast<std::size_t>(8 - y)][static_cast<std::size_t>(x)] == '.';
        EXPECT_EQ(plan.is_floor({0.05 * x + 0.025, 0.05 * y + 0.025}), floor);
        floor_pixels += floor ? 1 : 0;
      }
    }
    EXPECT_NEAR(plan.floor_area_m2(), floor_pixels * 0.0025, 1e-9);
  }
}

TEST(PlanFromPicture, RefusesPicturesWithoutFloorAndThoseThatAreTooLarge) {
  EXPECT_THAT(plan_from_picture(drawn({"##"}), "dark").error().text, HasSubstr("dark: no pixel"));
  files::GreyImage wide{.width = 4001, .height = 1, .shades = {}, .alphas = {}};
  wide.shades.assign(4001, 255);
  EXPECT_THAT(plan_from_picture(wide, "wide").error().text, HasSubstr("200 m on a side"));
}

TEST(ReadPicturePlan, SaysWhatIsWrongWithAFile) {
  const support::TemporaryFolder folder;
  const auto file = folder.write("broken.png", "this is no picture");
  EXPECT_THAT(read_picture_plan(file).error().text, HasSubstr("broken.png"));
  EXPECT_EQ(read_picture_plan(file).error().code, ErrorCode::unsupported);
  const auto cut_off = folder.write("cut_off.png", "\x89PNG\r\n\x1a\n and no more");
  EXPECT_THAT(read_picture_plan(cut_off).error().text, HasSubstr("cut_off.png"));
  EXPECT_EQ(read_picture_plan(cut_off).error().code, ErrorCode::bad_data);
  EXPECT_EQ(read_picture_plan(folder.path() / "none.png").error().code, ErrorCode::not_found);
}

TEST(ReadPicturePlan, RealBuildingsCanBeWalkedIn) {
  const std::string folder = LIFELINE_SOURCE_DIR "/../shared/data/floorplans/buildings/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the buildings' pictures are not here";
  for (const char* name : {"lab_intel.png", "NLB_furnitures.png", "office_a.png"}) {
    const auto scans =
        support::scans_of("sim:" + folder + name + "?duration=2&beams=90&head=natural");
    EXPECT_EQ(scans.size(), 20U) << name;
  }
}

}  // namespace
}  // namespace lifeline::sources
