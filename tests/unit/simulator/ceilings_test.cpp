#include "agents/sources/simulator/ceilings.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "agents/sources/simulator/draw.hpp"

namespace lifeline::sources {
namespace {

CeilingArea area(double x0, double y0, double x1, double y1, double height_m) {
  return {Eigen::AlignedBox2d(Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)), height_m};
}

const Eigen::Vector2d kOrigin(0.0, 0.0), kAlongX(1.0, 0.0);

TEST(Ceilings, OneHeightIsMetWhereTheRayHasRisenToIt) {
  EXPECT_DOUBLE_EQ(Ceilings(2.7).meets_m(kOrigin, kAlongX, 1.7, 0.1), 10.0);
}

TEST(Ceilings, ALowerRoomBehindIsMetAtItsEdgeAndAHigherOneLater) {
  const Ceilings lower(2.7, {area(4.0, -1.0, 8.0, 1.0, 2.0)});
  const Ceilings higher(2.7, {area(4.0, -1.0, 30.0, 1.0, 3.2)});

  EXPECT_NEAR(lower.meets_m(kOrigin, kAlongX, 1.7, 0.1), 4.0, 1e-5);
  EXPECT_NEAR(higher.meets_m(kOrigin, kAlongX, 1.7, 0.1), 15.0, 1e-9);
}

TEST(Ceilings, UnderALowCeilingTheRayEndsThere) {
  const Ceilings low(2.7, {area(-1.0, -1.0, 8.0, 1.0, 2.2)});
  EXPECT_NEAR(low.meets_m(kOrigin, kAlongX, 1.7, 0.1), 5.0, 1e-9);
}

TEST(Ceilings, NeverAnAnswerThatASlowWalkAlongTheRayContradicts) {
  Draw draw(7);
  constexpr double kStepM = 0.001;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<CeilingArea> areas;
    for (int i = 0; i < 3; ++i) {
      const double x = 4.0 * i - 6.0;
      areas.push_back(area(x, draw.between(-6.0, -1.0), x + 3.5, draw.between(1.0, 6.0),
                           draw.between(2.1, 3.3)));
    }
    const Ceilings ceilings(2.7, areas);
    const Eigen::Vector2d origin(draw.between(-5.0, 5.0), draw.between(-5.0, 5.0));
    const double angle = draw.between(-3.1, 3.1), slope = draw.between(0.05, 0.5);
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    double slow_m = 0.0;
    while (1.7 + slope * slow_m < ceilings.height_m(origin + slow_m * along)) slow_m += kStepM;
    EXPECT_NEAR(ceilings.meets_m(origin, along, 1.7, slope), slow_m, 2.0 * kStepM) << trial;
  }
}

}  // namespace
}  // namespace lifeline::sources
