// A helmet closes a loop: part of its layer moves, as one piece. What was measured on the old layer
// must not outlive it.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/fleet/drill.hpp"

namespace lifeline::test {
namespace {

using testing::ElementsAre;

/// The layer with everything but its first columns slipped along x: what lies in between is
/// unknown.
TsdGrid slipped(const TsdGrid& layer, double share_that_stays, int by_cells) {
  std::vector<CellIndex> known;
  for (const TileIndex tile : layer.tiles()) {
    for (int y = 0; y < kTileSide; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        const CellIndex cell{tile.x * kTileSide + x, tile.y * kTileSide + y};
        if (layer.cell(cell).known()) known.push_back(cell);
      }
    }
  }
  std::sort(known.begin(), known.end(), [](CellIndex a, CellIndex b) { return a.x < b.x; });
  const std::int32_t slips_from =
      known[static_cast<std::size_t>(share_that_stays * static_cast<double>(known.size()))].x;
  TsdGrid moved(layer.geometry());
  for (const CellIndex cell : known) {
    const CellIndex to{cell.x + (cell.x >= slips_from ? by_cells : 0), cell.y};
    moved.at(tile_of(to))[offset_in_tile(to)] = layer.cell(cell);
  }
  return moved;
}

struct Slip {
  int cells;             ///< of 5 cm
  Duration followed_in;  ///< of the fleet's clock, after the last corrected tile
  double share_that_stays;
};

void PrintTo(const Slip& slip, std::ostream* out) {
  *out << 5 * slip.cells << " cm";
}

class CorrectedLayerTest : public testing::TestWithParam<Slip> {
 protected:
  CorrectedLayerTest() : drill_(1, {"alpha", "bravo"}) {
    drill_.view("bravo").walker.walker = 2;
    for (const double until_s : {30, 34, 38}) {
      drill_.view("alpha").until_s = drill_.view("bravo").until_s = until_s;
      fleet().helmet("alpha").show(drill_.layer("alpha"));
      fleet().helmet("bravo").show(
          slipped(drill_.layer("bravo"), GetParam().share_that_stays, GetParam().cells));
      fleet().run(std::chrono::seconds(5));
    }
  }
  [[nodiscard]] ScriptedFleet& fleet() { return drill_.fleet(); }
  Drill drill_;
};

TEST_P(CorrectedLayerTest, IsFollowedByItsMergeAtOnce) {
  ASSERT_THAT(fleet().group(), ElementsAre("alpha", "bravo"));
  const double slip_m = 0.05 * GetParam().cells;
  ASSERT_NEAR(drill_.error_m("alpha", "bravo"), slip_m, 0.08) << "merged by what had slipped";
  const auto epoch = fleet().coordinator().directive().epoch;

  fleet().helmet("bravo").show(drill_.layer("bravo"));
  for (Duration waited{};
       fleet().helmet("bravo").sharing().tiles_behind() > 0 || waited < GetParam().followed_in;
       waited += std::chrono::milliseconds(100)) {
    fleet().run(std::chrono::milliseconds(100));
  }
  ASSERT_THAT(fleet().group(), ElementsAre("alpha", "bravo"));
  EXPECT_LT(drill_.error_m("alpha", "bravo"), 0.08);
  EXPECT_GT(fleet().coordinator().directive().epoch, epoch);
  EXPECT_NE(fleet().common_hash({"alpha", "bravo"}), "differ");
}

TEST_P(CorrectedLayerTest, IsMatchedNoMoreThanOnceASecondHoweverManyTilesCome) {
  const std::size_t before = fleet().evidence().size();
  for (int i = 0; i < 20; ++i) {
    fleet().helmet("bravo").show(
        i % 2 == 0 ? drill_.layer("bravo")
                   : slipped(drill_.layer("bravo"), GetParam().share_that_stays, GetParam().cells));
    fleet().run(std::chrono::milliseconds(500));
  }
  EXPECT_LE(fleet().evidence().size() - before, 11U) << "in ten seconds";
}

INSTANTIATE_TEST_SUITE_P(Slips, CorrectedLayerTest,
                         testing::Values(Slip{4, std::chrono::seconds(2), 0.1},
                                         Slip{12, std::chrono::seconds(7), 0.05}),
                         [](const auto& slip) {
                           return "of" + std::to_string(5 * slip.param.cells) + "cm";
                         });

}  // namespace
}  // namespace lifeline::test
