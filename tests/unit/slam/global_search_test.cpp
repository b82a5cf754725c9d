#include "agents/slam/global_search.hpp"

#include <gtest/gtest.h>

#include "tests/support/whole_search.hpp"
#include "tests/unit/slam/walked_wing.hpp"

namespace lifeline::slam {
namespace {

using support::search_all;
using support::take_map;

class GlobalSearchInTheWing : public ::testing::Test {
 protected:
  GlobalSearchInTheWing() {
    Walk walk(wing(), through_the_wing());
    for (int k = 0; k < walk.way.scans(); ++k) (void)walk.step(k);
    map.own() = copy_of(walk.slam.layer());
  }
  /// What is seen from place k of the way.
  [[nodiscard]] std::vector<Eigen::Vector2d> seen_from(int k) const {
    std::vector<Eigen::Vector2d> points;
    for (const Beam2& beam : support::scan_of(wing(), way.at(k)).beams) {
      points.emplace_back(beam.x_m, beam.y_m);
    }
    return points;
  }
  [[nodiscard]] Pose2 truth(int k) const { return way.at(0).inverse() * way.at(k); }

  Way way = through_the_wing();
  WorkingMap map{kGeometry};
  GlobalSearch search{{}};
};

TEST_F(GlobalSearchInTheWing, FindsEveryPlaceAtAnyHeading) {
  take_map(search, map);
  for (int k = 0; k < way.scans(); k += 23) {
    const auto found = search_all(search, seen_from(k), 0.0, M_PI);
    ASSERT_FALSE(found.candidates.empty()) << k;
    const Pose2 off = truth(k).inverse() * found.candidates.front().T_map_head;
    EXPECT_LT(off.translation().norm(), 0.2) << k;
    EXPECT_LT(std::abs(off.yaw_rad), 0.06) << k;
    EXPECT_TRUE(found.complete) << k;
  }
}

TEST_F(GlobalSearchInTheWing, LooksNowhereOutsideTheHeadingsGiven) {
  take_map(search, map);
  const double yaw_rad = truth(50).yaw_rad;
  for (const GlobalCandidate& there :
       search_all(search, seen_from(50), yaw_rad + 2.0, 0.3).candidates) {
    EXPECT_LT(std::abs(normalise_angle(there.T_map_head.yaw_rad - yaw_rad - 2.0)), 0.4);
  }
}

TEST_F(GlobalSearchInTheWing, GivesPlacesApartBestFirst) {
  take_map(search, map);
  const auto found = search_all(search, seen_from(100), 0.0, M_PI).candidates;
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_LE(found[i].agreement, found[i - 1].agreement);
  }
}

TEST_F(GlobalSearchInTheWing, NothingToCompareFindsNothing) {
  EXPECT_TRUE(search_all(search, seen_from(0), 0.0, M_PI).candidates.empty());
  take_map(search, map);
  EXPECT_TRUE(search_all(search, {}, 0.0, M_PI).candidates.empty());
  const WorkingMap empty(kGeometry);
  take_map(search, empty);
  EXPECT_TRUE(search_all(search, seen_from(0), 0.0, M_PI).candidates.empty());
}

TEST_F(GlobalSearchInTheWing, AMapTooLargeForTheFieldIsSearchedMoreCoarsely) {
  GlobalSearch coarse({.field = {.max_cells = 10'000}});
  take_map(coarse, map);
  const auto found = search_all(coarse, seen_from(60), 0.0, M_PI);
  ASSERT_FALSE(found.candidates.empty());
  EXPECT_LT((found.candidates.front().T_map_head.translation() - truth(60).translation()).norm(),
            0.5);
}

TEST_F(GlobalSearchInTheWing, SaysWhenItCouldNotLookEverywhere) {
  GlobalSearch hasty({.max_nodes = 4});
  take_map(hasty, map);
  EXPECT_FALSE(search_all(hasty, seen_from(60), 0.0, M_PI).complete);
}

}  // namespace
}  // namespace lifeline::slam
