#include "common/files/map_file.hpp"

#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "idl/map_file.pb.h"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::files {
namespace {

using ::testing::HasSubstr;

const LayerKey kLayer{AgentId::parse("alpha").value(), {3}, {-2}};

TsdGrid two_tiles() {
  TsdGrid grid({.cell_size_m = 0.05, .truncation_m = 0.15});
  grid.at({0, 0}) = dequantise(support::wall_tile(0.3));
  grid.at({-7, 5}) = dequantise(support::wall_tile(2.0));
  return grid;
}

class MapFile : public ::testing::Test {
 protected:
  MapFile() {
    const std::vector<StampedPose> walk{{Timestamp(Duration(1'699'999'999'123'456'789)), {1, 2, 3}},
                                        {Timestamp(Duration(1)), {-1.5, 1e-12, -0.5}}};
    EXPECT_TRUE(save_map(file_, kLayer, two_tiles(), walk));
    EXPECT_TRUE(message_.ParseFromString(support::content_of(file_)));
  }

  /// What load_map says of the message as it was changed.
  std::string error_of_message() {
    (void)folder_.write("m.lifemap", message_.SerializeAsString());
    const auto map = load_map(file_);
    return map ? "loaded" : map.error().text;
  }

  support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "m.lifemap";
  proto::MapFile message_;
};

TEST_F(MapFile, GivesLayerCellsAndTrajectoryBack) {
  const auto map = load_map(file_);
  ASSERT_TRUE(map) << map.error().text;
  EXPECT_EQ(map->layer, kLayer);
  EXPECT_EQ(map->grid.geometry(), two_tiles().geometry());
  ASSERT_EQ(map->grid.tiles(), two_tiles().tiles());
  for (const TileIndex tile : map->grid.tiles()) {
    EXPECT_EQ(quantise(*map->grid.find(tile)), quantise(*two_tiles().find(tile)));
  }
  ASSERT_EQ(map->trajectory.size(), 2U);
  EXPECT_EQ(map->trajectory[0].stamp.time_since_epoch().count(), 1'699'999'999'123'456'789);
  EXPECT_EQ(map->trajectory[1].pose.x_m, -1.5);
  EXPECT_EQ(map->trajectory[1].pose.yaw_rad, -0.5);
}

TEST_F(MapFile, SavingWhatWasLoadedGivesTheSameFile) {
  const auto map = load_map(file_);
  ASSERT_TRUE(map);
  ASSERT_TRUE(save_map(folder_.path() / "again.lifemap", map->layer, map->grid, map->trajectory));
  EXPECT_EQ(support::content_of(folder_.path() / "again.lifemap"), support::content_of(file_));
}

TEST_F(MapFile, AnEmptyMapSurvives) {
  ASSERT_TRUE(save_map(file_, kLayer, TsdGrid(), {}));
  const auto map = load_map(file_);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->grid.tile_count(), 0U);
}

TEST_F(MapFile, AFolderThatCannotBeWrittenIsNamed) {
  const auto saved = save_map(folder_.path() / "no" / "m.lifemap", kLayer, two_tiles(), {});
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().text, HasSubstr("no/m.lifemap: cannot be written"));
}

TEST_F(MapFile, RefusesWhatIsNoMapFile) {
  EXPECT_EQ(load_map(folder_.path() / "none").error().code, ErrorCode::not_found);
  for (const std::string& bad :
       {std::string("no map"), std::string(1000, '\xff'), std::string("\x4a\x7f", 2)}) {
    EXPECT_THAT(load_map(folder_.write("b", bad)).error().text,
                HasSubstr("b: not a whole map file"));
  }
  EXPECT_THAT(load_map(folder_.write("b", "")).error().text, HasSubstr("b: map file of version 0"));
}

TEST_F(MapFile, EveryTruncationIsRefused) {
  const std::string content = support::content_of(file_);
  for (std::size_t size = 0; size < content.size(); ++size) {
    EXPECT_FALSE(load_map(folder_.write("t.lifemap", content.substr(0, size)))) << size;
  }
}

TEST_F(MapFile, RefusesAnotherVersion) {
  message_.set_format_version(2);
  EXPECT_THAT(error_of_message(),
              HasSubstr("m.lifemap: map file of version 2, this program reads 1"));
}

TEST_F(MapFile, RefusesLayersThatCannotBe) {
  message_.set_agent_id("a b");
  EXPECT_THAT(error_of_message(), HasSubstr("agent id holds a character"));
  message_.set_agent_id("alpha");
  message_.set_floor(40'000);
  EXPECT_THAT(error_of_message(), HasSubstr("floor 40000 does not exist"));
}

TEST_F(MapFile, RefusesGeometriesThatMakeNoMapOrDifferFromTheTiles) {
  message_.set_cell_size_um(0);
  EXPECT_THAT(error_of_message(), HasSubstr("make no map"));
  message_.set_cell_size_um(100'000);
  EXPECT_THAT(error_of_message(), HasSubstr("map of other cell size"));
}

TEST_F(MapFile, RefusesTilesOutOfRangeTwiceOrDamaged) {
  message_.mutable_tiles(0)->set_x(512);
  EXPECT_THAT(error_of_message(), HasSubstr("tile (512, 5) lies outside"));
  message_.mutable_tiles(0)->set_x(0);
  message_.mutable_tiles(0)->set_y(0);
  EXPECT_THAT(error_of_message(), HasSubstr("tile (0, 0) stands twice"));
  message_.mutable_tiles(0)->set_payload("broken");
  EXPECT_THAT(error_of_message(), HasSubstr("m.lifemap: tile refused"));
}

TEST_F(MapFile, RefusesPosesThatAreNotFinite) {
  message_.mutable_trajectory(1)->set_x_m(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(error_of_message(), HasSubstr("not finite"));
  message_.mutable_trajectory(1)->set_x_m(1e9);
  EXPECT_THAT(error_of_message(), HasSubstr("far off"));
}

TEST_F(MapFile, RefusesMoreTilesThanItHasMemoryFor) {
  std::string content;
  for (int i = 0; i < 40'000; ++i) content += std::string("\x4a\x00", 2);  // an empty tile
  EXPECT_THAT(load_map(folder_.write("b", content)).error().text,
              HasSubstr("40000 tiles and 0 poses, at most 32768"));
}

}  // namespace
}  // namespace lifeline::files
