#include "agents/sources/carmen_source.hpp"

#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agents/sources/portable_noise.hpp"
#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using test::carmen_log;
using test::flaser_line;
using test::play;
using test::Played;
using test::RecordingFolder;
using ::testing::HasSubstr;

Timestamp at_ns(std::int64_t nanoseconds) {
  return Timestamp(Duration(nanoseconds));
}

TEST(CarmenSource, PlaysTheScansOfAPlainAndOfACompressedLog) {
  const RecordingFolder folder;
  const std::string log = carmen_log(181, 4);
  for (const std::string& path : {folder.write("a.log", log), folder.write_gz("a.log.gz", log)}) {
    const Played played = play("carmen:" + path);
    ASSERT_EQ(played.error, "");
    ASSERT_EQ(played.scans.size(), 4U);
    const sensing::RawScan& scan = played.scans[2];
    EXPECT_EQ(scan.stamp, at_ns(102'250'000'000));
    EXPECT_EQ(scan.ranges_m, std::vector<float>(181, 3.0F));
    EXPECT_NEAR(scan.first_angle_rad, -std::numbers::pi / 2, 1e-12);
    EXPECT_NEAR(scan.angle_step_rad, std::numbers::pi / 180, 1e-12);
    EXPECT_EQ(scan.sweep_time, Duration{0});
  }
}

TEST(CarmenSource, GivesTheCorrectedPoseAsTruthAndNoPriorByDefault) {
  const RecordingFolder folder;
  const Played played = play("carmen:" + folder.write("a.log", carmen_log(180, 3)));
  ASSERT_EQ(played.scans.size(), 3U);
  ASSERT_TRUE(played.scans[2].T_world_head_truth);
  EXPECT_EQ(played.scans[2].T_world_head_truth->x_m, 2.0);
  EXPECT_EQ(played.scans[2].T_world_head_truth->y_m, 4.0);
  EXPECT_EQ(played.scans[2].T_world_head_truth->yaw_rad, 0.2);
  EXPECT_FALSE(played.scans[2].attitude);
  EXPECT_FALSE(played.scans[2].T_odom_head);
}

TEST(CarmenSource, PriorOdomGivesTheWholeOdometryAndNoAttitude) {
  const RecordingFolder folder;
  const Played played = play("carmen:" + folder.write("a.log", carmen_log(180, 3)) + "?prior=odom");
  ASSERT_EQ(played.scans.size(), 3U);
  ASSERT_TRUE(played.scans[1].T_odom_head);
  EXPECT_EQ(played.scans[1].T_odom_head->x_m, 11.0);
  EXPECT_EQ(played.scans[1].T_odom_head->y_m, 21.0);
  EXPECT_EQ(played.scans[1].T_odom_head->yaw_rad, 0.2);
  EXPECT_FALSE(played.scans[1].attitude);
}

TEST(CarmenSource, PriorYawGivesTheOdometrysHeadingAlone) {
  const RecordingFolder folder;
  const Played played = play("carmen:" + folder.write("a.log", carmen_log(180, 3)) + "?prior=yaw");
  ASSERT_EQ(played.scans.size(), 3U);
  ASSERT_TRUE(played.scans[2].attitude);
  EXPECT_EQ(played.scans[2].attitude->yaw_rad, 0.4);
  EXPECT_EQ(played.scans[2].attitude->roll_rad, 0.0);
  EXPECT_EQ(played.scans[2].attitude->pitch_rad, 0.0);
  EXPECT_FALSE(played.scans[2].T_odom_head);
}

TEST(CarmenSource, PriorAhrsGivesTheCorrectedHeadingWithNoiseOfTheSeed) {
  const RecordingFolder folder;
  const std::string source = "carmen:" + folder.write("a.log", carmen_log(180, 20)) + "?prior=ahrs";
  const Played first = play(source), again = play(source), other = play(source + "&seed=9");
  ASSERT_EQ(first.scans.size(), 20U);
  NoisyYaw expected(1);
  for (std::size_t i = 0; i < 20; ++i) {
    ASSERT_TRUE(first.scans[i].attitude);
    const double yaw_rad = first.scans[i].attitude->yaw_rad;
    EXPECT_EQ(yaw_rad, expected.measure(first.scans[i].T_world_head_truth->yaw_rad));
    EXPECT_EQ(yaw_rad, again.scans[i].attitude->yaw_rad);
    EXPECT_NE(yaw_rad, other.scans[i].attitude->yaw_rad);
    EXPECT_FALSE(first.scans[i].T_odom_head);
  }
}

TEST(CarmenSource, NoiseOfAScanIsTheSameInAPieceOfTheLog) {
  const RecordingFolder folder;
  const std::string source = "carmen:" + folder.write("a.log", carmen_log(180, 20)) + "?prior=ahrs";
  const Played whole = play(source), piece = play(source + "&from=7&to=12");
  ASSERT_EQ(piece.scans.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(piece.scans[i].attitude->yaw_rad, whole.scans[7 + i].attitude->yaw_rad);
    EXPECT_EQ(piece.scans[i].stamp, whole.scans[7 + i].stamp);
  }
}

TEST(CarmenSource, PlaysTheHalfOpenRangeOfScansOnly) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.log", carmen_log(180, 5));
  EXPECT_EQ(play("carmen:" + path + "?from=1&to=3").scans.size(), 2U);
  EXPECT_EQ(play("carmen:" + path + "?from=4").scans.size(), 1U);
  EXPECT_EQ(play("carmen:" + path + "?to=2").scans.size(), 2U);
  EXPECT_EQ(play("carmen:" + path + "?from=3&to=99").scans.size(), 2U);
}

TEST(CarmenSource, ReadsNothingBehindTheEndOfTheRange) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.log", carmen_log(180, 2) + "FLASER broken\n");
  EXPECT_EQ(play("carmen:" + path + "?to=2").error, "");
  EXPECT_THAT(play("carmen:" + path).error, HasSubstr("beam count 'broken'"));
}

TEST(CarmenSource, CallsFiftyMetresNoReturnUnlessToldOtherwise) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.log", carmen_log(180, 1));
  EXPECT_EQ(play("carmen:" + path).scans.at(0).range_max_m, 50.0);
  EXPECT_EQ(play("carmen:" + path + "?max_range=8.5").scans.at(0).range_max_m, 8.5);
}

TEST(CarmenSource, KeepsTheOrderOfTheFileAndTimesThatGoBack) {
  const RecordingFolder folder;
  const std::string log =
      flaser_line(180, 0, "10.5") + flaser_line(180, 1, "9.75") + flaser_line(180, 2, "11");
  const Played played = play("carmen:" + folder.write("a.log", log));
  ASSERT_EQ(played.scans.size(), 3U);
  EXPECT_EQ(played.scans[0].stamp, at_ns(10'500'000'000));
  EXPECT_EQ(played.scans[1].stamp, at_ns(9'750'000'000));
  EXPECT_EQ(played.scans[1].ranges_m[0], 2.0F);
  EXPECT_EQ(played.scans[2].stamp, at_ns(11'000'000'000));
}

TEST(CarmenSource, SpreadsTimesThatWereRoundedAwayByAMillisecond) {
  const RecordingFolder folder;
  std::string log;
  for (int k = 0; k < 4; ++k) log += flaser_line(180, k, k < 3 ? "1.13486e+09" : "1.13487e+09");
  const Played played = play("carmen:" + folder.write("a.log", log));
  ASSERT_EQ(played.scans.size(), 4U);
  constexpr std::int64_t kRounded = 1'134'860'000'000'000'000;
  EXPECT_EQ(played.scans[0].stamp, at_ns(kRounded));
  EXPECT_EQ(played.scans[1].stamp, at_ns(kRounded + 1'000'000));
  EXPECT_EQ(played.scans[2].stamp, at_ns(kRounded + 2'000'000));
  EXPECT_EQ(played.scans[3].stamp, at_ns(1'134'870'000'000'000'000));
}

TEST(CarmenSource, NamesAMissingLog) {
  const Played played = play("carmen:/nowhere/run.log.gz");
  EXPECT_EQ(played.error, "/nowhere/run.log.gz: no such file");
  EXPECT_EQ(played.code, ErrorCode::not_found);
}

TEST(CarmenSource, NamesALogWithoutScans) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.log", "# nothing\nODOM 1 2 3 0 0 0 1 host 1\n");
  const Played played = play("carmen:" + path);
  EXPECT_EQ(played.error, path + ": holds no scan: none of its 2 lines is a FLASER line");
  EXPECT_EQ(played.code, ErrorCode::bad_data);
}

TEST(CarmenSource, NamesFileAndLineOfAMalformedScan) {
  const RecordingFolder folder;
  std::string nan_line = flaser_line(180, 1, "2");
  nan_line.replace(nan_line.find("2.00"), 4, "nan");
  const std::string path =
      folder.write("nan.log", flaser_line(180, 0, "1") + "NEFF 3\n" + nan_line);
  const Played played = play("carmen:" + path);
  EXPECT_EQ(played.scans.size(), 1U);
  EXPECT_EQ(played.error, path + ":3: beam 0: range nan is not a usable number");
  EXPECT_EQ(played.code, ErrorCode::bad_data);

  const std::string wrong = folder.write("wrong.log", flaser_line(90, 0, "1"));
  EXPECT_EQ(play("carmen:" + wrong).error,
            wrong + ":1: 90 beams: only FLASER lines of 180, 181, 360 or 361 are known");
}

TEST(CarmenSource, NamesALogThatEndsInTheMiddleOfALine) {
  const RecordingFolder folder;
  const std::string whole = flaser_line(180, 0, "1") + flaser_line(180, 1, "2");
  const std::string scan = folder.write("scan.log", whole.substr(0, whole.size() - 300));
  EXPECT_EQ(play("carmen:" + scan).error,
            scan + ":2: the log ends in the middle of a line: it is truncated");
  const std::string odom = folder.write("odom.log", whole + "ODOM 1 2");
  EXPECT_EQ(play("carmen:" + odom).error,
            odom + ":3: the log ends in the middle of a line: it is truncated");
}

TEST(CarmenSource, TakesAWholeLastLineWithoutNewline) {
  const RecordingFolder folder;
  std::string log = carmen_log(180, 2);
  log.pop_back();
  EXPECT_EQ(play("carmen:" + folder.write("a.log", log)).scans.size(), 2U);
  EXPECT_EQ(play("carmen:" + folder.write("b.log", log + "\n# end")).error, "");
}

TEST(CarmenSource, IsAtItsEndAfterAnError) {
  const RecordingFolder folder;
  const auto source =
      open_carmen_source({"carmen", folder.write("a.log", "FLASER x\n" + carmen_log(180, 2)), {}});
  ASSERT_TRUE(source);
  EXPECT_FALSE((*source)->next());
  const auto after = (*source)->next();
  ASSERT_TRUE(after);
  EXPECT_FALSE(*after);
}

TEST(CarmenSource, NamesOptionsThatMakeNoSense) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.log", carmen_log(180, 5));
  const auto refusal = [&](const std::string& options) {
    const Played played = play("carmen:" + path + "?" + options);
    EXPECT_EQ(played.code, ErrorCode::wrong_use) << options;
    return played.error;
  };
  EXPECT_EQ(refusal("form=1"),
            "carmen: has no option 'form'; there are: from, to, prior, seed, max_range, rate");
  EXPECT_EQ(refusal("prior=gps"), "carmen: option prior=gps is none of: none, ahrs, yaw, odom");
  EXPECT_EQ(refusal("from=3&to=3"), "carmen: from=3 to=3 leaves no scan");
  EXPECT_THAT(refusal("from=-1"), HasSubstr("option from=-1 is not an integer from 0"));
  EXPECT_THAT(refusal("max_range=0"), HasSubstr("option max_range=0 is not a number from 0.1"));
  const Played beyond = play("carmen:" + path + "?from=5");
  EXPECT_EQ(beyond.error, path + ": holds 5 scans, from=5 is beyond the last");
  EXPECT_EQ(beyond.code, ErrorCode::bad_data);
}

}  // namespace
}  // namespace lifeline::sources
