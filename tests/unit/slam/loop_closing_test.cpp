#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "agents/slam/covariance.hpp"
#include "agents/slam/keyframe_log.hpp"
#include "agents/slam/loop_closer.hpp"
#include "agents/slam/packed_surface.hpp"
#include "agents/slam/pose_graph.hpp"
#include "agents/slam/story.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"
#include "tests/support/poses.hpp"

namespace lifeline::slam {
namespace {

std::vector<SurfacePiece> surfaces(const support::FlatWorld& world, const Pose2& pose) {
  return extract_surface(support::scan_of(world, pose));
}

TEST(PackedSurface, KeepsPiecesToItsPrecision) {
  const auto pieces = surfaces(support::small_flat(), {0.3, 0.2, 0.7});
  std::vector<SurfacePiece> back;
  PackedSurface(pieces).unpack(back);
  ASSERT_EQ(back.size(), pieces.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_LE((back[i].point - pieces[i].point).cwiseAbs().maxCoeff(), 0.00101F);
    EXPECT_GT(back[i].normal.dot(pieces[i].normal), 0.99999F);
    EXPECT_NEAR(back[i].left_m, pieces[i].left_m, 0.00101F);
    EXPECT_NEAR(back[i].right_m, pieces[i].right_m, 0.00101F);
    EXPECT_NEAR(back[i].quality, pieces[i].quality, 0.004F);
    EXPECT_EQ(back[i].link, pieces[i].link);
    EXPECT_EQ(back[i].has_normal, pieces[i].has_normal);
  }
}

TEST(PackedSurface, LeavesOutWhatIsTooFarAway) {
  std::vector<SurfacePiece> pieces(2);
  pieces[0].point = {70.0F, 0.0F};
  pieces[1].point = {60.0F, 0.0F};
  for (SurfacePiece& piece : pieces) piece.normal = {-1.0F, 0.0F};
  EXPECT_EQ(PackedSurface(pieces).size(), 1U);
}

TEST(PoseGraph, SpreadsTheContradictionOfALoopOverThePath) {
  // Twenty steps straight on that were really 1 % longer, and a loop that knows.
  std::vector<Pose2> poses{{}};
  std::vector<GraphEdge> edges;
  for (std::size_t i = 1; i <= 20; ++i) {
    edges.push_back({i - 1, i, {1.0, 0.0, 0.0}, diagonal_covariance(0.02, 0.002), false});
    poses.push_back(poses.back() * edges.back().T_from_to);
  }
  edges.push_back({0, 20, {20.2, 0.0, 0.0}, diagonal_covariance(0.005, 0.001), true});
  optimise(poses, edges, {});
  EXPECT_EQ(poses.front().x_m, 0.0);
  EXPECT_NEAR(poses[20].x_m, 20.2, 0.02);
  EXPECT_NEAR(poses[10].x_m, 10.1, 0.02);
}

TEST(PoseGraph, FindsRandomPosesAgainInSpiteOfAFalseLoop) {
  std::mt19937 random(5);
  std::normal_distribution<double> unit(0.0, 1.0);
  std::vector<Pose2> truth{{}}, poses{{}};
  std::vector<GraphEdge> edges;
  const auto measured = [&](std::size_t from, std::size_t to, double xy_m, double yaw_rad) {
    const Pose2 noise{xy_m * unit(random), xy_m * unit(random), yaw_rad * unit(random)};
    edges.push_back({from, to, truth[from].inverse() * truth[to] * noise,
                     diagonal_covariance(xy_m, yaw_rad), to != from + 1});
  };
  for (std::size_t i = 1; i < 60; ++i) {
    truth.push_back(truth.back() * Pose2{0.5, 0.0, 2.0 * std::numbers::pi / 30.0});
    measured(i - 1, i, 0.02, 0.01);
    poses.push_back(poses.back() * edges.back().T_from_to);
  }
  for (std::size_t i = 32; i < 60; i += 4) measured(i - 30, i, 0.01, 0.002);
  edges.push_back({3, 40, {2.0, 2.0, 1.0}, diagonal_covariance(0.01, 0.002), true});
  optimise(poses, edges, {});
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_LT(apart_m(poses[i], truth[i]), 0.15) << i;
}

Story story_at(double x_m, double score) {
  Story story{MotionModel({}), score, {}};
  story.motion.reset({x_m, 0.0, 0.0});
  StoryStep step;
  step.match.T_map_head = {x_m, 0.0, 0.0};
  story.steps.push_back(step);
  return story;
}

TEST(Stories, KeepsTheLikelyOnesAndOneOfThoseThatEndAlike) {
  std::vector<Story> stories{story_at(0.5, 9.0), story_at(0.0, 10.0), story_at(0.02, 9.5),
                             story_at(1.0, -5.0)};
  keep_likely(stories, {});
  ASSERT_EQ(stories.size(), 2U);
  EXPECT_EQ(stories[0].score, 10.0);
  EXPECT_EQ(stories[1].score, 9.0);
}

TEST(Stories, SettlingTheOldestScanDropsThoseThatTellItOtherwise) {
  std::vector<Story> stories{story_at(0.0, 10.0), story_at(0.5, 9.0), story_at(0.0, 8.0)};
  EXPECT_FALSE(agree_on_oldest(stories));
  settle_oldest(stories);
  ASSERT_EQ(stories.size(), 2U);
  EXPECT_TRUE(stories[0].steps.empty());
}

/// Keyframes on a way round a block of rooms, as a tracker with a yaw drift would place them.
struct DriftingWalk {
  support::FlatWorld world = support::FlatWorld()
                                 .add_box(0.0, 0.0, 16.0, 12.0)
                                 .add_box(4.0, 4.0, 12.0, 8.0)
                                 .add_box(1.0, 10.5, 1.5, 11.0)
                                 .add_box(14.2, 0.8, 15.0, 1.2)
                                 .add(16.0, 10.0, 14.0, 12.0)
                                 .add(7.0, 0.0, 7.5, 0.6);
  std::vector<Pose2> truth;
  std::vector<Keyframe> keyframes;

  explicit DriftingWalk(double drift_rad_m) {
    Pose2 placed;
    const double side_x = 12.0, side_y = 8.0, round = 2 * (side_x + side_y);
    for (double s = 0.0; s < 1.3 * round; s += 0.5) {
      truth.push_back(on_the_way(std::fmod(s, round), side_x, side_y));
      const Pose2 step =
          truth.size() < 2 ? Pose2{} : truth[truth.size() - 2].inverse() * truth.back();
      const Pose2 drifted = step * Pose2{0.0, 0.0, truth.size() < 2 ? 0.0 : 0.5 * drift_rad_m};
      placed = placed * drifted;
      Keyframe keyframe;
      keyframe.index = static_cast<KeyframeIndex>(keyframes.size());
      keyframe.T_map_head = placed;
      keyframe.T_previous_this = drifted;
      keyframe.step_covariance = diagonal_covariance(0.01, 0.002);
      keyframe.surface = PackedSurface(surfaces(world, truth.back()));
      keyframes.push_back(std::move(keyframe));
    }
  }

  /// Anticlockwise, in the middle of the corridors, looking ahead.
  static Pose2 on_the_way(double s, double side_x, double side_y) {
    if (s < side_x) return {2.0 + s, 2.0, 0.0};
    if (s < side_x + side_y) return {14.0, 2.0 + s - side_x, std::numbers::pi / 2};
    if (s < 2 * side_x + side_y) return {14.0 - (s - side_x - side_y), 10.0, std::numbers::pi};
    return {2.0, 10.0 - (s - 2 * side_x - side_y), -std::numbers::pi / 2};
  }
  [[nodiscard]] Pose2 true_in_map(std::size_t i) const { return truth[0].inverse() * truth[i]; }
};

TEST(LoopCloser, ComingBackCorrectsTheDriftOfTheWholeRound) {
  DriftingWalk walk(0.002);  // 0.11 deg a metre: half a metre after the round
  const double before_m =
      apart_m(walk.keyframes.back().T_map_head, walk.true_in_map(walk.truth.size() - 1));
  ASSERT_GT(before_m, 0.3);
  LoopCloser closer({}, kGeometry, {}, {}, {}, {});
  std::optional<MapCorrection> last;
  for (Keyframe& keyframe : walk.keyframes) {
    if (closer.take(std::move(keyframe))) last = closer.correction();
  }
  if (auto correction = closer.finish()) last = std::move(correction);
  ASSERT_TRUE(last.has_value());
  EXPECT_GT(closer.loops(), 2U);
  ASSERT_EQ(last->T_map_head.size(), walk.truth.size());
  for (std::size_t i = 0; i < walk.truth.size(); ++i) {
    EXPECT_LT(apart_m(last->T_map_head[i], walk.true_in_map(i)), 0.12) << i;
  }
  EXPECT_GT(known_area_m2(last->layer), 100.0);
}

TEST(LoopCloser, AStraightWayHasNoLoops) {
  DriftingWalk walk(0.002);
  walk.keyframes.resize(60);  // three sides
  LoopCloser closer({}, kGeometry, {}, {}, {}, {});
  for (Keyframe& keyframe : walk.keyframes) {
    EXPECT_FALSE(closer.take(std::move(keyframe)));
  }
  EXPECT_EQ(closer.loops(), 0U);
  EXPECT_FALSE(closer.finish().has_value());
}

TEST(LoopCloser, AKeyframeThatFitsElsewhereIsMovedInTheEnd) {
  DriftingWalk walk(0.0);
  walk.keyframes.resize(30);
  const std::size_t wrong = 15;
  const Pose2 off{0.35, 0.1, 0.02};
  Keyframe &astray = walk.keyframes[wrong], &after = walk.keyframes[wrong + 1];
  astray.T_map_head = astray.T_map_head * off;
  astray.T_previous_this = astray.T_previous_this * off;
  after.T_previous_this = off.inverse() * after.T_previous_this;
  // The tracker had its doubts.
  astray.step_covariance = after.step_covariance = diagonal_covariance(0.3, 0.03);
  LoopCloser closer({}, kGeometry, {}, {}, {}, {});
  for (Keyframe& keyframe : walk.keyframes) {
    EXPECT_FALSE(closer.take(std::move(keyframe)));
  }
  const auto correction = closer.finish();
  ASSERT_TRUE(correction.has_value());
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_LT(apart_m(correction->T_map_head[i], walk.true_in_map(i)), 0.05) << i;
  }
}

TEST(KeyframeLog, ACorrectionMovesWhatItDidNotKnowAlong) {
  KeyframeLog log({});
  for (int i = 0; i < 3; ++i) {
    log.keep({}, {1.0 * i, 0.0, 0.0}, Eigen::Matrix3d::Zero(), {});
  }
  const auto taken = log.take();
  ASSERT_EQ(taken.size(), 3U);
  EXPECT_EQ(taken[2].T_previous_this.x_m, 1.0);
  MapCorrection correction{{{0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}}, TsdGrid(kGeometry)};
  const auto T_new_old = log.rebase(correction);
  ASSERT_TRUE(T_new_old.has_value());
  EXPECT_NEAR(T_new_old->y_m, 0.5, 1e-12);
  EXPECT_NEAR(log.poses()[2].y_m, 0.5, 1e-12);
  ASSERT_EQ(log.unknown_to(correction).size(), 1U);
  EXPECT_EQ(log.unknown_to(correction)[0].index, 2U);
}

TEST(KeyframeLog, ACorrectionOlderThanItsMemoryIsRefused) {
  KeyframeLog log({});
  for (std::size_t i = 0; i < KeyframeLog::kRecent + 5; ++i) {
    log.keep({}, {static_cast<double>(i), 0.0, 0.0}, Eigen::Matrix3d::Zero(), {});
  }
  MapCorrection old{{{0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}}, TsdGrid(kGeometry)};
  EXPECT_FALSE(log.rebase(old).has_value());
  EXPECT_EQ(log.poses()[1].y_m, 0.0);
}

}  // namespace
}  // namespace lifeline::slam
