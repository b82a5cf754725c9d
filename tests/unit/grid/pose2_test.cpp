#include "common/grid/pose2.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "common/grid/point_transform.hpp"

namespace lifeline {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_near(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
  EXPECT_NEAR(normalise_angle(a.yaw_rad - b.yaw_rad), 0.0, 1e-12);
}

TEST(NormaliseAngle, BringsEveryAngleIntoOneTurn) {
  EXPECT_DOUBLE_EQ(normalise_angle(0.5), 0.5);
  EXPECT_NEAR(normalise_angle(0.5 + 20.0 * kPi), 0.5, 1e-12);
  EXPECT_NEAR(normalise_angle(-3.5), 2.0 * kPi - 3.5, 1e-12);
  EXPECT_DOUBLE_EQ(normalise_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(normalise_angle(-kPi), kPi);
}

TEST(Pose2, TakesPointsToTheOtherFrame) {
  // The head stands at (2, 1) and looks along y: what is ahead of it lies further up.
  const Pose2 T_map_head{2.0, 1.0, kPi / 2.0};
  const Eigen::Vector2d p_map = T_map_head * Eigen::Vector2d(3.0, 0.5);
  EXPECT_NEAR(p_map.x(), 1.5, 1e-12);
  EXPECT_NEAR(p_map.y(), 4.0, 1e-12);
}

TEST(Pose2, ChainsLikeItsPoints) {
  const Pose2 T_a_b{1.0, -2.0, 2.5}, T_b_c{-0.3, 0.7, 1.9};
  const Eigen::Vector2d p_c(0.4, 5.0);
  EXPECT_LT(((T_a_b * T_b_c) * p_c - T_a_b * (T_b_c * p_c)).norm(), 1e-12);
  EXPECT_LE((T_a_b * T_b_c).yaw_rad, kPi);
}

TEST(Pose2, ItsInverseUndoesIt) {
  const Pose2 T_a_b{1.0, -2.0, 2.5};
  expect_near(T_a_b * T_a_b.inverse(), {});
  expect_near(T_a_b.inverse() * T_a_b, {});
}

TEST(Pose2, KnowsWhetherItIsFinite) {
  EXPECT_TRUE(Pose2{}.is_finite());
  EXPECT_FALSE((Pose2{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}.is_finite()));
  EXPECT_FALSE((Pose2{0.0, 0.0, std::numeric_limits<double>::infinity()}.is_finite()));
}

TEST(PointTransform, TakesPointsAlongAsThePoseDoesToTheBit) {
  for (const Pose2& T : {Pose2{}, Pose2{1.5, -2.25, 0.3}, Pose2{-40.0, 0.125, -3.1}}) {
    const PointTransform transform(T);
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(3.7, -0.2)}) {
      EXPECT_EQ(transform * p, T * p);
      EXPECT_EQ(transform.turned(p), (Pose2{0.0, 0.0, T.yaw_rad} * p));
    }
  }
}

}  // namespace
}  // namespace lifeline
