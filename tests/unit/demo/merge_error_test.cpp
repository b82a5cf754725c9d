#include "deploy/demo/merge_error.hpp"

#include <gtest/gtest.h>

#include "common/base/angles.hpp"

namespace lifeline::demo {
namespace {

TEST(MergeError, is_nothing_for_the_truth_itself) {
  const Pose2 T_a_b{1.0, 2.0, 3.0};
  const MergeError error = merge_error(T_a_b, T_a_b, {4.0, 5.0});
  EXPECT_DOUBLE_EQ(error.at_centre_m, 0.0);
  EXPECT_DOUBLE_EQ(error.at_origin_m, 0.0);
  EXPECT_DOUBLE_EQ(error.angle_deg, 0.0);
}

TEST(MergeError, of_a_shift_is_the_same_everywhere) {
  const MergeError error = merge_error({1.3, 2.4, 0.7}, {1.0, 2.0, 0.7}, {20.0, -7.0});
  EXPECT_NEAR(error.at_centre_m, 0.5, 1e-12);
  EXPECT_NEAR(error.at_origin_m, 0.5, 1e-12);
}

TEST(MergeError, of_a_turn_grows_with_the_distance_from_the_origin) {
  const MergeError error = merge_error({0.0, 0.0, 1.0 * kDegree}, {}, {10.0, 0.0});
  EXPECT_NEAR(error.at_centre_m, 2.0 * 10.0 * std::sin(0.5 * kDegree), 1e-12);
  EXPECT_DOUBLE_EQ(error.at_origin_m, 0.0);
  EXPECT_NEAR(error.angle_deg, 1.0, 1e-12);
}

TEST(MergeError, turns_the_short_way_round) {
  const MergeError error =
      merge_error({0.0, 0.0, 179.0 * kDegree}, {0.0, 0.0, -179.0 * kDegree}, {0.0, 0.0});
  EXPECT_NEAR(error.angle_deg, 2.0, 1e-9);
}

TEST(AllInOneMap, holds_when_a_chain_of_merges_ties_all_together) {
  EXPECT_TRUE(all_in_one_map({"a", "b", "c", "d"}, {{"c", "d"}, {"b", "c"}, {"a", "b"}}));
}

TEST(AllInOneMap, fails_when_one_helmet_is_left_over) {
  EXPECT_FALSE(all_in_one_map({"a", "b", "c"}, {{"a", "b"}}));
}

TEST(AllInOneMap, fails_for_two_separate_groups) {
  EXPECT_FALSE(all_in_one_map({"a", "b", "c", "d"}, {{"a", "b"}, {"c", "d"}}));
}

TEST(AllInOneMap, holds_for_a_single_helmet_and_fails_for_none) {
  EXPECT_TRUE(all_in_one_map({"a"}, {}));
  EXPECT_FALSE(all_in_one_map({}, {}));
}

}  // namespace
}  // namespace lifeline::demo
