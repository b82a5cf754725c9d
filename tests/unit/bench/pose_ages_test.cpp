#include "tests/bench/radio/pose_ages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline::bench {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

auto about(double value_s) {
  return DoubleNear(value_s, 1e-9);
}

TEST(PoseAges, OnArrivalAreHowLongEachTook) {
  EXPECT_THAT(ages_on_arrival_s({{1.0, 1.2}, {2.0, 2.5}}), ElementsAre(about(0.2), about(0.5)));
}

TEST(PoseAges, ShownGrowUntilTheNextOneArrives) {
  EXPECT_THAT(ages_shown_s({{1.0, 1.25}, {1.2, 1.4}}, 1.6),
              ElementsAre(about(0.25), about(0.35), about(0.25), about(0.35)));
}

TEST(PoseAges, ShownGrowWhileNoneArrives) {
  const auto ages_s = ages_shown_s({{1.0, 1.05}}, 11.0);
  ASSERT_THAT(ages_s, testing::SizeIs(100));
  EXPECT_NEAR(ages_s.back(), 9.95, 1e-6);
}

TEST(PoseAges, OfNoPoseAreNone) {
  EXPECT_THAT(ages_shown_s({}, 10.0), IsEmpty());
}

}  // namespace
}  // namespace lifeline::bench
