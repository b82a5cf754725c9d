#include "agents/sources/carmen_line.hpp"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/angles.hpp"
#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using ::testing::Each;
using ::testing::FloatEq;
using ::testing::StartsWith;

std::string line_refusal(const std::string& line) {
  const auto scan = parse_flaser(line);
  return scan ? "accepted" : scan.error().text;
}

/// A good line of 180 beams with field `index` (0 is FLASER) replaced.
std::string with_field(std::size_t index, const std::string& text) {
  std::string line = test::flaser_line(180, 1, "5.5");
  std::size_t begin = 0;
  for (; index > 0; --index) begin = line.find(' ', begin) + 1;
  return line.replace(begin, line.find_first_of(" \n", begin) - begin, text);
}

TEST(BeamFan, SpansHalfATurnFromTheRightForEveryKnownCount) {
  struct Expected {
    std::size_t beams;
    double last_deg;
  };
  for (const auto& [beams, last_deg] :
       {Expected{180, 89.0}, {181, 90.0}, {360, 89.5}, {361, 90.0}}) {
    const auto fan = beam_fan(beams);
    ASSERT_TRUE(fan);
    EXPECT_NEAR(fan->first_angle_rad / kDegree, -90.0, 1e-12);
    const double last = fan->first_angle_rad + static_cast<double>(beams - 1) * fan->angle_step_rad;
    EXPECT_NEAR(last / kDegree, last_deg, 1e-9) << beams;
  }
}

TEST(BeamFan, KnowsNoOtherCount) {
  for (const std::size_t beams : {0U, 1U, 179U, 182U, 359U, 362U, 682U}) {
    const auto fan = beam_fan(beams);
    ASSERT_FALSE(fan);
    EXPECT_EQ(fan.error().text, fmt::format("{} beams: only FLASER lines of 180, 181, 360 or 361 "
                                            "are known",
                                            beams));
  }
}

TEST(ParseFlaser, ReadsEveryField) {
  const auto scan = parse_flaser(test::flaser_line(181, 3, "976052890.244111"));
  ASSERT_TRUE(scan) << scan.error().text;
  EXPECT_EQ(scan->ranges_m.size(), 181U);
  EXPECT_THAT(scan->ranges_m, Each(FloatEq(4.0F)));
  EXPECT_EQ(scan->T_world_laser.x_m, 3.0);
  EXPECT_EQ(scan->T_world_laser.y_m, 6.0);
  EXPECT_EQ(scan->T_world_laser.yaw_rad, 0.3);
  EXPECT_EQ(scan->T_odom_laser.x_m, 13.0);
  EXPECT_EQ(scan->T_odom_laser.y_m, 23.0);
  EXPECT_EQ(scan->T_odom_laser.yaw_rad, 0.6);
  EXPECT_EQ(scan->time, std::chrono::nanoseconds(976052890'244111000));
}

TEST(ParseFlaser, BringsAnglesIntoOneTurn) {
  const auto scan = parse_flaser(with_field(2 + 180 + 2, "7.0"));
  ASSERT_TRUE(scan);
  EXPECT_NEAR(scan->T_world_laser.yaw_rad, 7.0 - 2.0 * std::numbers::pi, 1e-12);
}

TEST(ParseFlaser, TakesTabsCarriageReturnsAndRepeatedBlanks) {
  std::string line = test::flaser_line(180, 1, "5.5");
  line.replace(line.find(' '), 1, " \t  ");
  line.back() = '\r';
  EXPECT_TRUE(parse_flaser(line));
}

TEST(ParseFlaser, NamesARangeThatIsNone) {
  EXPECT_EQ(line_refusal(with_field(9, "nan")), "beam 7: range nan is not a usable number");
  EXPECT_EQ(line_refusal(with_field(2, "inf")), "beam 0: range inf is not a usable number");
  EXPECT_EQ(line_refusal(with_field(3, "1e30")), "beam 1: range 1e30 is not a usable number");
  EXPECT_EQ(line_refusal(with_field(4, "-0.5")), "beam 2: range -0.5 is negative");
  EXPECT_EQ(line_refusal(with_field(5, "1.2.3")), "beam 3: range '1.2.3' is not a number");
  EXPECT_EQ(line_refusal(with_field(6, "1e99999")), "beam 4: range '1e99999' is not a number");
}

TEST(ParseFlaser, NamesAPoseOrTimeThatIsNone) {
  EXPECT_EQ(line_refusal(with_field(182, "x")), "x 'x' is not a number");
  EXPECT_EQ(line_refusal(with_field(184, "nan")), "theta nan is not a usable number");
  EXPECT_EQ(line_refusal(with_field(187, "-inf")), "odom_theta -inf is not a usable number");
  EXPECT_EQ(line_refusal(with_field(188, "noon")), "time 'noon' is not a time in seconds");
}

TEST(ParseFlaser, QuotesOnlyTheBeginningOfGarbage) {
  EXPECT_EQ(line_refusal(with_field(182, std::string(5000, 'z'))),
            "x '" + std::string(20, 'z') + "' is not a number");
}

TEST(ParseFlaser, NamesAWrongBeamCount) {
  EXPECT_EQ(line_refusal(test::flaser_line(90, 1, "5.5")),
            "90 beams: only FLASER lines of 180, 181, 360 or 361 are known");
  EXPECT_EQ(line_refusal(with_field(1, "many")), "FLASER beam count 'many' is not a number");
  EXPECT_EQ(line_refusal(with_field(1, "-180")), "FLASER beam count '-180' is not a number");
  EXPECT_EQ(line_refusal("FLASER"), "FLASER beam count '' is not a number");
  EXPECT_THAT(line_refusal(with_field(1, "4294967295")), StartsWith("4294967295 beams: only"));
}

TEST(ParseFlaser, NamesTooFewAndTooManyFields) {
  EXPECT_EQ(line_refusal(with_field(1, "181")),
            "FLASER with 181 beams needs 192 fields and has 191: the line is cut off");
  EXPECT_EQ(line_refusal(with_field(1, "180 1.0")),
            "FLASER with 180 beams needs 191 fields and has 192: the line is of some other format");
}

TEST(CarmenLines, TellsLineKindsApart) {
  EXPECT_TRUE(is_flaser("FLASER 180 1.0"));
  EXPECT_TRUE(is_flaser("  FLASER"));
  EXPECT_FALSE(is_flaser("FLASERS 180"));
  EXPECT_FALSE(is_flaser("ODOM 1 2 3"));
  EXPECT_FALSE(is_flaser(""));
}

TEST(CarmenLines, KnowsAWholeOtherLine) {
  EXPECT_TRUE(is_whole_other_line("ODOM 1 2 3 0 0 0 5.5 host 5.5"));
  EXPECT_FALSE(is_whole_other_line("ODOM 1 2 3 0 0 0 5.5 host"));
  EXPECT_TRUE(is_whole_other_line("# comment"));
  EXPECT_TRUE(is_whole_other_line("   "));
  EXPECT_FALSE(is_whole_other_line("ODO"));
}

}  // namespace
}  // namespace lifeline::sources
