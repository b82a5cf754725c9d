#include <ostream>

#include <gtest/gtest.h>

#include "agents/slam/motion_model.hpp"
#include "tests/unit/slam/walked_wing.hpp"

namespace lifeline::slam {
namespace {

struct Gap {
  int from;   ///< place of the way
  int scans;  ///< that never came, while the wearer walked on
  friend void PrintTo(const Gap& gap, std::ostream* out) {
    *out << gap.scans << " scans missed from " << gap.from << " on";
  }
};

class MissedScans : public testing::TestWithParam<Gap> {};

TEST_P(MissedScans, LeadNobodyAstray) {
  const auto [from, scans] = GetParam();
  Walk walk(wing(), through_the_wing());
  for (int k = 0; k < from; ++k) ASSERT_FALSE(walk.step(k).lost);
  walk.miss(scans);
  SlamStep step;
  for (int k = from + scans; k < from + scans + 60; ++k) {
    step = walk.step(k);
    if (step.pushed > 0) {
      EXPECT_LT(walk.off_m(step, k), 0.08) << k;
    }
    if (step.lost) {
      EXPECT_EQ(step.trust_percent, 0) << k;
    }
  }
  EXPECT_FALSE(step.lost);
  EXPECT_EQ(step.verdict, Verdict::accepted);
}

INSTANTIATE_TEST_SUITE_P(Gaps, MissedScans,
                         testing::Values(Gap{60, 6}, Gap{60, 12}, Gap{60, 30}, Gap{150, 6},
                                         Gap{150, 12}, Gap{150, 20}, Gap{150, 40}, Gap{240, 12},
                                         Gap{240, 20}, Gap{240, 40}, Gap{300, 10}, Gap{300, 30}));

MotionModel after_steps_of(Duration elapsed) {
  MotionModel motion{MotionConfig{}};
  MotionPrior prior;
  prior.elapsed = elapsed;
  for (int i = 0; i < 5; ++i) motion.matched({0.1 * i, 0.0, 0.0}, prior);
  return motion;
}

TEST(MotionModel, ALidarAtWorkThatStopsForHalfASecondLeavesAGap) {
  const MotionModel motion = after_steps_of(std::chrono::milliseconds(100));
  EXPECT_FALSE(motion.is_gap(std::chrono::milliseconds(400)));
  EXPECT_TRUE(motion.is_gap(std::chrono::milliseconds(600)));
}

TEST(MotionModel, KeyframesThatComeSeldomLeaveNone) {
  const MotionModel motion = after_steps_of(std::chrono::seconds(1));
  EXPECT_FALSE(motion.is_gap(std::chrono::seconds(5)));
}

TEST(MotionModel, ManyGapsMakeNoKeyframesOfALidarAtWork) {
  MotionModel motion = after_steps_of(std::chrono::milliseconds(100));
  MotionPrior late, usual;
  late.elapsed = std::chrono::seconds(1);
  usual.elapsed = std::chrono::milliseconds(100);
  for (int i = 0; i < 20; ++i) {
    motion.matched({}, late);
    motion.matched({}, usual);
  }
  EXPECT_TRUE(motion.is_gap(std::chrono::seconds(1)));
}

}  // namespace
}  // namespace lifeline::slam
