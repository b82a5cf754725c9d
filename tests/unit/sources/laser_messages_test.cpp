#include "agents/sources/laser_messages.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using test::Encoding;
using test::imu_message;
using test::ImuFields;
using test::laser_message;
using test::LaserFields;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

RosVersion version(Encoding encoding) {
  return encoding == Encoding::ros1 ? RosVersion::ros1 : RosVersion::ros2;
}

sensing::RawScan decoded(const LaserFields& fields, Encoding encoding = Encoding::cdr_little) {
  const auto scan = decode_laser_scan(laser_message(fields, encoding), version(encoding));
  EXPECT_TRUE(scan) << scan.error().text;
  return scan.value_or(sensing::RawScan{});
}

std::string refusal(const LaserFields& fields) {
  const auto scan =
      decode_laser_scan(laser_message(fields, Encoding::cdr_little), RosVersion::ros2);
  return scan ? "accepted" : scan.error().text;
}

std::string refusal(const ImuFields& fields) {
  const auto imu = decode_imu(imu_message(fields, Encoding::cdr_little), RosVersion::ros2);
  return imu ? "accepted" : imu.error().text;
}

TEST(LaserScanMessage, BecomesAScanInEveryEncoding) {
  for (const Encoding encoding : {Encoding::cdr_little, Encoding::cdr_big, Encoding::ros1}) {
    const sensing::RawScan scan = decoded({}, encoding);
    EXPECT_EQ(scan.stamp, Timestamp(Duration(100'000'000'500)));
    EXPECT_EQ(scan.first_angle_rad, -1.5);
    EXPECT_EQ(scan.angle_step_rad, 0.5);
    EXPECT_EQ(scan.sweep_time, std::chrono::milliseconds(500));
    EXPECT_EQ(scan.range_min_m, 0.125);
    EXPECT_EQ(scan.range_max_m, 12.0);
    EXPECT_THAT(scan.ranges_m, ElementsAre(1.0F, 2.0F, 3.0F));
    EXPECT_FALSE(scan.attitude);
    EXPECT_FALSE(scan.T_world_head_truth);
  }
}

TEST(LaserScanMessage, MayHoldAnyRangesAndNoneAtAll) {
  const auto ranges = decoded({.ranges = {kNaN, kInf, -1.0F}}).ranges_m;
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_TRUE(std::isnan(ranges[0]));
  EXPECT_EQ(ranges[1], kInf);
  EXPECT_EQ(decoded({.ranges = {}}).ranges_m.size(), 0U);
  EXPECT_EQ(decoded({.ranges = {}}).sweep_time, Duration{0});
}

TEST(LaserScanMessage, MayTurnClockwiseAndSeeWithoutLimit) {
  EXPECT_EQ(decoded({.angle_increment = -0.25F}).angle_step_rad, -0.25);
  EXPECT_EQ(decoded({.range_max = kInf}).range_max_m, 1000.0);
}

TEST(LaserScanMessage, CountsAsTakenAtOnceWhereTheDriverGivesNoTimes) {
  for (const float increment : {0.0F, -0.1F, kNaN, kInf, 100.0F}) {
    EXPECT_EQ(decoded({.time_increment = increment}).sweep_time, Duration{0}) << increment;
  }
}

TEST(LaserScanMessage, MayComeFromBefore1970InRos2Only) {
  EXPECT_EQ(decoded({.seconds = 0xffffffffU, .nanoseconds = 0}).stamp,
            Timestamp(std::chrono::seconds(-1)));
  EXPECT_EQ(decoded({.seconds = 0xffffffffU, .nanoseconds = 0}, Encoding::ros1).stamp,
            Timestamp(std::chrono::seconds(4294967295)));
}

TEST(LaserScanMessage, IsRefusedWithFiguresThatDescribeNoScan) {
  EXPECT_EQ(refusal({.angle_min = kNaN}), "angle_min nan is no angle");
  EXPECT_EQ(refusal({.angle_min = 100.0F}), "angle_min 100 is no angle");
  EXPECT_EQ(refusal({.angle_increment = 0.0F}), "angle_increment 0 is no step");
  EXPECT_EQ(refusal({.angle_increment = kInf}), "angle_increment inf is no step");
  EXPECT_EQ(refusal({.range_min = 2.0F, .range_max = 1.0F}),
            "range_min 2 and range_max 1 are no limits");
  EXPECT_EQ(refusal({.range_min = kNaN}), "range_min nan and range_max 12 are no limits");
  EXPECT_EQ(refusal({.range_max = kNaN}), "range_min 0.125 and range_max nan are no limits");
  EXPECT_EQ(refusal({.range_min = 5000.0F, .range_max = kInf}),
            "range_min 5000 and range_max 1000 are no limits");
  EXPECT_EQ(refusal({.range_min = -1.0F}), "range_min -1 and range_max 12 are no limits");
  EXPECT_EQ(refusal(LaserFields{.nanoseconds = 1'000'000'000}),
            "LaserScan with a second of nanoseconds or more");
}

TEST(LaserScanMessage, IsRefusedWithMoreBeamsThanAnyLidarHas) {
  EXPECT_EQ(decoded({.ranges = std::vector<float>(kMaxBeams)}).ranges_m.size(), kMaxBeams);
  EXPECT_THAT(refusal({.ranges = std::vector<float>(kMaxBeams + 1)}),
              HasSubstr("are no whole LaserScan of at most 32768 beams"));
}

TEST(LaserScanMessage, IsRefusedWhereverItIsCutOff) {
  for (const Encoding encoding : {Encoding::cdr_little, Encoding::cdr_big, Encoding::ros1}) {
    const auto whole = laser_message({}, encoding);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto scan = decode_laser_scan(std::span(whole).first(size), version(encoding));
      ASSERT_FALSE(scan) << size;
      EXPECT_EQ(scan.error().code, ErrorCode::bad_data);
    }
  }
}

TEST(ImuMessage, GivesItsOrientationInEveryEncoding) {
  for (const Encoding encoding : {Encoding::cdr_little, Encoding::cdr_big, Encoding::ros1}) {
    const ImuFields fields{.x = 0.5, .y = -0.5, .z = 0.5, .w = 0.5};
    const auto imu = decode_imu(imu_message(fields, encoding), version(encoding));
    ASSERT_TRUE(imu) << imu.error().text;
    EXPECT_EQ(imu->stamp, Timestamp(Duration(100'000'000'500)));
    ASSERT_TRUE(imu->R_world_body);
    EXPECT_EQ(imu->R_world_body->x(), 0.5);
    EXPECT_EQ(imu->R_world_body->y(), -0.5);
    EXPECT_EQ(imu->R_world_body->z(), 0.5);
    EXPECT_EQ(imu->R_world_body->w(), 0.5);
  }
}

TEST(ImuMessage, HasNoOrientationWhereTheSensorEstimatesNone) {
  for (const ImuFields& fields : {ImuFields{.first_covariance = -1.0}, ImuFields{.w = 0.0}}) {
    const auto imu = decode_imu(imu_message(fields, Encoding::cdr_little), RosVersion::ros2);
    ASSERT_TRUE(imu);
    EXPECT_FALSE(imu->R_world_body);
  }
}

TEST(ImuMessage, IsRefusedWhereItsOrientationIsNoRotation) {
  EXPECT_EQ(refusal(ImuFields{.w = 2.0}), "Imu orientation (0, 0, 0, 2) is no rotation");
  EXPECT_THAT(refusal(ImuFields{.x = std::nan("")}), HasSubstr("is no rotation"));
  EXPECT_EQ(refusal(ImuFields{.nanoseconds = 4'000'000'000}),
            "Imu with a second of nanoseconds or more");
}

TEST(ImuMessage, IsRefusedWhereverItIsCutOff) {
  const auto whole = imu_message({}, Encoding::cdr_little);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_FALSE(decode_imu(std::span(whole).first(size), RosVersion::ros2)) << size;
  }
}

}  // namespace
}  // namespace lifeline::sources
