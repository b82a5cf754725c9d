// Direct alignment, the correlative search, and the tracker that uses both.
#include <cmath>

#include <gtest/gtest.h>

#include "agents/slam/correlative_search.hpp"
#include "agents/slam/direct_matcher.hpp"
#include "agents/slam/map_tracker.hpp"
#include "common/grid/tsd_update.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"
#include "tests/support/poses.hpp"

namespace lifeline::slam {
namespace {

using support::FlatWorld;
using support::scan_of;
using support::small_flat;

/// A map of `world`, seen from `poses`.
WorkingMap map_of(const FlatWorld& world, const std::vector<Pose2>& poses) {
  WorkingMap map(kGeometry);
  TsdUpdater updater(kGeometry, {});
  for (const Pose2& T : poses) {
    (void)updater.push(extract_surface(scan_of(world, T)), T, 1.0, map.own());
  }
  return map;
}

WorkingMap flat_map() {
  return map_of(small_flat(), {{0.0, 0.0, 0.0}, {0.8, 0.6, 1.0}, {-1.0, 1.0, 2.0}, {1.0, -1.0}});
}

TsdView view_of(const WorkingMap& map) {
  TsdView view;
  view.assign(map, {0.0, 0.0}, 20.0);
  return view;
}

TEST(DirectMatcher, AlignsToAFewMillimetres) {
  const WorkingMap map = flat_map();
  const TsdView view = view_of(map);
  DirectMatcher matcher({});
  for (const Pose2& truth : {Pose2{0.2, 0.1, 0.3}, Pose2{0.5, 0.5, -2.0}, Pose2{-0.6, 0.8, 1.4}}) {
    matcher.set_scan(extract_surface(scan_of(small_flat(), truth)));
    const Pose2 start = truth * Pose2{0.06, -0.05, 0.03};
    const Pose2 found = matcher.align(view, Prediction{start, 0.3, 0.2});
    EXPECT_LT(apart_m(found, truth), 0.008);
    EXPECT_LT(apart_rad(found, truth), 0.003);
  }
}

TEST(DirectMatcher, EvidenceIsGoodAtTheTruthAndPoorElsewhere) {
  const WorkingMap map = flat_map();
  const TsdView view = view_of(map);
  DirectMatcher matcher({});
  const Pose2 truth{0.2, 0.1, 0.3};
  matcher.set_scan(extract_surface(scan_of(small_flat(), truth)));
  const Prediction prior{truth, 0.2, 0.1};
  const MatchEvidence good = matcher.judge(view, truth, prior);
  EXPECT_GT(good.inlier_share(), 0.95);
  EXPECT_LT(good.mean_error_m, 0.01);
  const MatchEvidence poor = matcher.judge(view, truth * Pose2{0.8, 0.5, 0.6}, prior);
  EXPECT_LT(poor.inlier_share(), 0.4);
  EXPECT_GT(poor.conflicts, poor.known / 3);
  EXPECT_GT(matcher.agreement(view, truth), 0.8);
  EXPECT_LT(matcher.agreement(view, truth * Pose2{0.8, 0.5, 0.6}), 0.2);
}

TEST(DirectMatcher, ACorridorLeavesItsLengthToThePrediction) {
  const FlatWorld corridor = FlatWorld().add(-40.0, 1.0, 40.0, 1.0).add(-40.0, -1.0, 40.0, -1.0);
  const WorkingMap map = map_of(corridor, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}});
  const TsdView view = view_of(map);
  DirectMatcher matcher({});
  matcher.set_scan(extract_surface(scan_of(corridor, {1.5, 0.1, 0.05})));
  const Prediction prior{{1.3, 0.0, 0.0}, 0.2, 0.1};
  const Pose2 found = matcher.align(view, prior);
  EXPECT_NEAR(found.y_m, 0.1, 0.005);
  EXPECT_NEAR(found.yaw_rad, 0.05, 0.002);
  EXPECT_NEAR(found.x_m, 1.3, 0.08);
  const MatchEvidence evidence = matcher.judge(view, found, prior);
  EXPECT_GT(evidence.weakest_sigma_m, 5.0 * std::sqrt(evidence.covariance(1, 1)));
}

TEST(DirectMatcher, BeamsPassNoWallAtTheTruthAndOneWhereTheDeadEndWouldLieFurtherOn) {
  // A dead end looks alike from further in: only the wall that the beams would have had to pass
  // tells.
  const FlatWorld dead_end =
      FlatWorld().add(-6.0, 1.0, 4.0, 1.0).add(-6.0, -1.0, 4.0, -1.0).add(4.0, -1.0, 4.0, 1.0);
  const WorkingMap map = map_of(dead_end, {{0.0, 0.0, 0.0}, {0.5, 0.2, 0.0}});
  const TsdView view = view_of(map);
  DirectMatcher matcher({});
  matcher.set_scan(extract_surface(scan_of(dead_end, {0.3, 0.1, 0.0})));
  EXPECT_LT(matcher.seen_through_walls(view, {0.3, 0.1, 0.0}), 0.02);
  const Pose2 further{1.3, 0.1, 0.0};
  EXPECT_GT(matcher.seen_through_walls(view, further), 0.1);
  EXPECT_EQ(matcher.seen_through_walls(view_of(WorkingMap(kGeometry)), further), 0.0);
}

TEST(DirectMatcher, AnEmptyMapOrScanLeavesThePrediction) {
  const WorkingMap empty(kGeometry);
  DirectMatcher matcher({});
  matcher.set_scan(extract_surface(scan_of(small_flat(), {})));
  const Prediction prior{{1.0, 2.0, 0.5}, 0.2, 0.1};
  EXPECT_LT(apart_m(matcher.align(view_of(empty), prior), prior.T_map_head), 1e-9);
  EXPECT_EQ(matcher.judge(view_of(empty), prior.T_map_head, prior).known, 0);
  matcher.set_scan({});
  EXPECT_LT(apart_m(matcher.align(view_of(flat_map()), prior), prior.T_map_head), 1e-9);
  EXPECT_EQ(matcher.agreement(view_of(flat_map()), prior.T_map_head), 0.0);
}

MatchResult best_of(const std::vector<ScoredMatch>& matches) {
  return matches.front().match;
}

TEST(CorrelativeSearch, FindsThePlaceFarFromThePrediction) {
  const WorkingMap map = flat_map();
  CorrelativeSearch search({});
  for (const Pose2& off : {Pose2{0.5, -0.4, 0.2}, Pose2{-0.6, 0.3, -0.3}, Pose2{0.0, 0.7, 0.1}}) {
    const Pose2 truth{0.3, 0.2, 0.4};
    const auto found =
        search.search(map, extract_surface(scan_of(small_flat(), truth)), {truth * off, 0.4, 0.2});
    ASSERT_FALSE(found.empty());
    EXPECT_LT(apart_m(found.front().T_map_head, truth), 0.12);
    EXPECT_LT(apart_rad(found.front().T_map_head, truth), 0.05);
  }
}

TEST(CorrelativeSearch, CandidatesAreDistinctAndBestFirst) {
  const WorkingMap map = flat_map();
  CorrelativeSearch search({});
  const auto found = search.search(map, extract_surface(scan_of(small_flat(), {0.3, 0.2, 0.4})),
                                   {{0.0, 0.0, 0.3}, 0.5, 0.3});
  ASSERT_GT(found.size(), 1U);
  EXPECT_LE(found.size(), static_cast<std::size_t>(search.config().max_candidates));
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GE(found[i - 1].score, found[i].score);
    EXPECT_TRUE(apart_m(found[i].T_map_head, found[0].T_map_head) > 0.2 ||
                apart_rad(found[i].T_map_head, found[0].T_map_head) > 0.02);
  }
}

TEST(CorrelativeSearch, SeesChangesOnlyOfTilesItWasToldOf) {
  WorkingMap map = flat_map();
  CorrelativeSearch search({});
  const auto pieces = extract_surface(scan_of(small_flat(), {0.3, 0.2, 0.4}));
  const Prediction prediction{{0.3, 0.2, 0.4}, 0.1, 0.05};
  ASSERT_GT(search.search(map, pieces, prediction).front().agreement, 0.5);
  const auto tiles = map.own().tiles();
  map.own().clear();
  search.forget(tiles);
  EXPECT_TRUE(search.search(map, pieces, prediction).empty());
}

TEST(CorrelativeSearch, HasNothingToSayWithoutAScan) {
  CorrelativeSearch search({});
  EXPECT_TRUE(search.search(flat_map(), {}, {{}, 0.5, 0.3}).empty());
}

TEST(MapTracker, SearchesWhenThePredictionIsLooseAndFindsTheTruth) {
  const WorkingMap map = flat_map();
  const TsdView view = view_of(map);
  MapTracker tracker({}, {}, {});
  const Pose2 truth{0.3, 0.2, 0.4};
  const MatchResult result =
      best_of(tracker.match(map, view, extract_surface(scan_of(small_flat(), truth)),
                            {truth * Pose2{0.6, -0.5, 0.2}, 0.4, 0.15}));
  EXPECT_EQ(result.source, PoseSource::search);
  EXPECT_EQ(result.verdict, Verdict::accepted);
  EXPECT_LT(apart_m(result.T_map_head, truth), 0.01);
}

TEST(MapTracker, DoesNotSearchWhenThePredictionLeadsToAGoodMatch) {
  const WorkingMap map = flat_map();
  MapTracker tracker({}, {}, {});
  const Pose2 truth{0.3, 0.2, 0.4};
  const MatchResult result =
      best_of(tracker.match(map, view_of(map), extract_surface(scan_of(small_flat(), truth)),
                            {truth * Pose2{0.02, 0.01, 0.01}, 0.03, 0.02}));
  EXPECT_EQ(result.source, PoseSource::map);
  EXPECT_EQ(result.verdict, Verdict::accepted);
}

TEST(MapTracker, RejectsASceneThatTheMapDoesNotShow) {
  const WorkingMap map = flat_map();
  FlatWorld other;
  other.add_box(-1.3, -0.9, 1.1, 1.7);
  MapTracker tracker({}, {}, {});
  const MatchResult result = best_of(
      tracker.match(map, view_of(map), extract_surface(scan_of(other, {})), {{}, 0.1, 0.05}));
  EXPECT_NE(result.verdict, Verdict::accepted);
}

TEST(MapTracker, NamesTheRivalOneDoorFurtherInACorridorOfEqualDoors) {
  // Niches 0.6 m apart on one side of a corridor: one niche further, the scan fits nearly as well.
  FlatWorld corridor;
  for (int i = -12; i < 12; ++i) {
    const double x = 0.6 * i;
    corridor.add(x, 1.0, x + 0.3, 1.0).add(x + 0.3, 1.0, x + 0.3, 1.15);
    corridor.add(x + 0.3, 1.15, x + 0.6, 1.15).add(x + 0.6, 1.15, x + 0.6, 1.0);
  }
  corridor.add(-7.2, -1.0, 7.2, -1.0);
  WorkingMap map(kGeometry);
  TsdUpdater updater(kGeometry, {});
  for (const double x : {-2.0, 0.0, 2.0}) {
    (void)updater.push(extract_surface(scan_of(corridor, {x, 0.0, 0.0})), {x, 0.0, 0.0}, 1.0,
                       map.own());
  }
  MapTracker tracker({}, {}, {});
  const auto matches =
      tracker.match(map, view_of(map), extract_surface(scan_of(corridor, {0.1, 0.0, 0.0})),
                    {{0.3, 0.0, 0.0}, 0.4, 0.02});
  ASSERT_GT(matches.size(), 1U);
  EXPECT_NEAR(matches[0].match.T_map_head.x_m, 0.1, 0.02);
  EXPECT_NEAR(std::abs(matches[1].match.T_map_head.x_m - 0.1), 0.6, 0.05);
  EXPECT_GE(matches[0].score, matches[1].score);
  // The rival makes the place uncertain along the corridor.
  EXPECT_GT(matches[0].match.evidence.covariance(0, 0),
            4.0 * matches[0].match.evidence.covariance(1, 1));
}

TEST(MapTracker, RejectsWhereTheMapKnowsNothing) {
  const WorkingMap empty(kGeometry);
  MapTracker tracker({}, {}, {});
  const MatchResult result = best_of(tracker.match(
      empty, view_of(empty), extract_surface(scan_of(small_flat(), {})), {{}, 0.1, 0.05}));
  EXPECT_EQ(result.verdict, Verdict::rejected);
}

}  // namespace
}  // namespace lifeline::slam
