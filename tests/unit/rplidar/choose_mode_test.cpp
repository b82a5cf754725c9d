#include <gmock/gmock.h>

#include "agents/rplidar/device.hpp"
#include "agents/rplidar/frames.hpp"

namespace lifeline::rplidar {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// As an A3 has them; what its maker recommends comes in ultra capsules.
const ScanModes kModes{{{0, "Standard", 252.0, 25.0, 0x81},
                        {1, "Express", 126.0, 25.0, 0x82},
                        {2, "Boost", 63.0, 25.0, 0x84},
                        {3, "Sensitivity", 63.0, 25.0, 0x84}},
                       3};

TEST(ChooseMode, takes_the_typical_one_if_it_can_be_decoded_or_else_the_fastest_that_can) {
  const auto mode = choose_mode(kModes, "", "/dev/lidar");
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->name, frame_format(AnswerType::ultra_capsules) ? "Sensitivity" : "Express");
  ScanModes slow = kModes;
  slow.typical = 0;
  EXPECT_EQ(choose_mode(slow, "", "/dev/lidar")->name, "Standard");
}

TEST(ChooseMode, takes_the_one_asked_for_in_any_case) {
  EXPECT_EQ(choose_mode(kModes, "sTANDARD", "/dev/lidar")->id, 0);
}

TEST(ChooseMode, lists_the_modes_where_it_has_not_the_one_asked_for) {
  const auto mode = choose_mode(kModes, "Turbo", "/dev/lidar");
  ASSERT_FALSE(mode);
  EXPECT_EQ(mode.error().code, ErrorCode::wrong_use);
  EXPECT_THAT(mode.error().text,
              AllOf(HasSubstr("/dev/lidar: has no scan mode 'Turbo'"),
                    HasSubstr("Standard (4.0k samples/s)"), HasSubstr("Express (7.9k samples/s)")));
}

TEST(ChooseMode, says_how_to_get_a_mode_that_this_build_does_not_decode) {
  if (frame_format(AnswerType::ultra_capsules)) GTEST_SKIP() << "this build decodes all of them";
  const auto mode = choose_mode(kModes, "sensitivity", "/dev/lidar");
  ASSERT_FALSE(mode);
  EXPECT_EQ(mode.error().code, ErrorCode::wrong_use);
  EXPECT_THAT(mode.error().text, HasSubstr("LIFELINE_RPLIDAR_ULTRA=ON"));
}

}  // namespace
}  // namespace lifeline::rplidar
