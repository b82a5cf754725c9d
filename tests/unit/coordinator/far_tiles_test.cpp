// A peer whose tiles lie so far apart that a dense grid of them would take gigabytes.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coordinator/coordinator.hpp"
#include "coordinator/report.hpp"
#include "tests/support/fleet_channels.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::test {
namespace {

CoordinatorSettings matching_everything() {
  CoordinatorSettings settings{
      {AgentId::parse("vehicle").value(), kMission, Incarnation{3}}, {}, {}, {}};
  settings.schedule.min_explored_percent = 0.0;
  return settings;
}

/// A coordinator, and somebody who publishes tiles.
class FarTiles : public testing::Test {
 protected:
  void publish(const std::string& agent, TileIndex tile) {
    const auto sample =
        tile_sample(layer(agent), tile, ++revision_, support::wall_tile(0.3), GridGeometry{});
    ASSERT_TRUE(tiles_->put(sample));
    run();
  }
  void run() {
    for (int i = 0; i < 50; ++i) {
      clock_.advance(std::chrono::milliseconds(100));
      coordinator_.step();
    }
  }

  ManualClock clock_;
  wire::LoopbackBus bus_;
  InlineMatchWorker worker_{matching::MatchConfig{}};
  Coordinator coordinator_{matching_everything(), coordinator_channels(bus_), worker_, clock_};
  std::unique_ptr<wire::Outbox<wire::TsdTile>> tiles_ = bus_.writer<wire::TsdTile>();
  std::uint64_t revision_ = 0;
};

TEST_F(FarTiles, AreRefusedByTheMatchWithTheReason) {
  publish("near", {0, 0});
  publish("far", {-kMaxTileIndex, -kMaxTileIndex});
  publish("far", {kMaxTileIndex - 1, kMaxTileIndex - 1});
  EXPECT_EQ(coordinator_.store().find(layer("far"))->size(), 2U);
  ASSERT_EQ(coordinator_.newest_matches().size(), 1U);
  const auto& match = coordinator_.newest_matches().begin()->second.result;
  EXPECT_FALSE(match.accepted());
  EXPECT_THAT(match.reason, testing::HasSubstr("65536 x 65536 cells"));
}

TEST_F(FarTiles, CostTheReportThatPictureAlone) {
  publish("near", {0, 0});
  publish("far", {-kMaxTileIndex, 0});
  publish("far", {kMaxTileIndex - 1, 0});
  const support::TemporaryFolder folder;
  const auto written = write_report(folder.path(), coordinator_, Settlement::apart);
  ASSERT_TRUE(written) << written.error().text;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "near.png"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "far.png"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "coordinator.json"));
}

}  // namespace
}  // namespace lifeline::test
