#include "coordinator/merging/confirmation.hpp"

#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

using test::layer;

class ConfirmationTest : public testing::Test {
 protected:
  static Proposal proposal(const Pose2& T_a_b, double wall_m = 20.0) {
    return {T_a_b, {5.0, 0.0}, wall_m, false};
  }

  LayerPair pair_{layer("alpha"), layer("bravo")}, other_{layer("alpha"), layer("charlie")};
  Pose2 T_right_{1.0, 2.0, 0.5}, T_wrong_{-7.0, 1.0, 3.6};
  Confirmation confirmation_;
};

TEST_F(ConfirmationTest, OneMatchAloneMergesNothing) {
  EXPECT_FALSE(confirmation_.confirm(pair_, proposal(T_right_)));
}

TEST_F(ConfirmationTest, TwoThatAgreeMerge) {
  EXPECT_FALSE(confirmation_.confirm(pair_, proposal(T_right_)));
  EXPECT_TRUE(confirmation_.confirm(pair_, proposal(T_right_ * Pose2{0.1, 0.0, 0.01})));
}

TEST_F(ConfirmationTest, TwoThatDisagreeDoNotAndTheLaterOneCounts) {
  EXPECT_FALSE(confirmation_.confirm(pair_, proposal(T_wrong_)));
  EXPECT_FALSE(confirmation_.confirm(pair_, proposal(T_right_)));
  EXPECT_TRUE(confirmation_.confirm(pair_, proposal(T_right_)));
}

TEST_F(ConfirmationTest, ARefusedMatchInBetweenStartsAnew) {
  EXPECT_FALSE(confirmation_.confirm(pair_, proposal(T_right_)));
  confirmation_.refuse(pair_);
  EXPECT_FALSE(confirmation_.confirm(pair_, proposal(T_right_)));
}

TEST_F(ConfirmationTest, AnotherPairsMatchDoesNotCount) {
  EXPECT_FALSE(confirmation_.confirm(other_, proposal(T_right_)));
  EXPECT_FALSE(confirmation_.confirm(pair_, proposal(T_right_)));
}

TEST_F(ConfirmationTest, MuchAgreeingWallNeedsNoSecondMatch) {
  EXPECT_TRUE(confirmation_.confirm(pair_, proposal(T_right_, 60.0)));
}

TEST_F(ConfirmationTest, FinishedMapsGetNoSecondMatch) {
  Proposal last = proposal(T_right_);
  last.last_chance = true;
  EXPECT_TRUE(confirmation_.confirm(pair_, last));
}

}  // namespace
}  // namespace lifeline::merging
