// Recordings that were cut or damaged anywhere: the sources end or say what is wrong, and never
// give a scan that was not recorded.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "agents/sources/laser_messages.hpp"
#include "common/base/decimal_seconds.hpp"
#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using test::Encoding;
using test::play;
using test::Played;
using test::RecordingFolder;

TEST(HostileRecordings, ALogCutAnywhereGivesNoMoreThanItsWholeScans) {
  const RecordingFolder folder;
  const std::string log = test::flaser_line(180, 0, "1.25") + test::flaser_line(180, 1, "2.25");
  const std::size_t first = log.find('\n');
  for (std::size_t size = 0; size <= log.size(); size += size % 7 + 1) {
    const Played played = play("carmen:" + folder.write("a.log", log.substr(0, size)));
    EXPECT_LE(played.scans.size(), size >= log.size() - 6 ? 2U : size >= first - 6 ? 1U : 0U);
    if (played.scans.size() == 2) {
      EXPECT_EQ(played.scans[1].ranges_m[179], 2.0F);
    }
    EXPECT_EQ(played.scans.empty() && played.error.empty(), false) << size;
  }
}

TEST(HostileRecordings, ABagCutAnywhereGivesNoMoreThanItsWholeScans) {
  const RecordingFolder folder;
  const std::vector<test::TopicToWrite> topics{{"/scan", "sensor_msgs/LaserScan"}};
  const auto message = test::laser_message({}, Encoding::ros1);
  const std::string bag = test::ros1_bag(topics, {{0, 0, message}, {0, 0, message}});
  for (std::size_t size = 0; size < bag.size(); size += size % 5 + 1) {
    const Played played = play("rosbag2:" + folder.write("a.bag", bag.substr(0, size)));
    EXPECT_TRUE(!played.error.empty() || played.scans.size() <= 2U);
    for (const auto& scan : played.scans) EXPECT_EQ(scan.ranges_m.size(), 3U);
  }
}

TEST(HostileRecordings, ABagWithAnyByteChangedNeitherCrashesNorHangs) {
  const RecordingFolder folder;
  const std::vector<test::TopicToWrite> topics{{"/scan", "sensor_msgs/LaserScan"}};
  const std::string bag = test::ros1_bag(topics, {{0, 0, test::laser_message({}, Encoding::ros1)}});
  std::mt19937 random(11);
  for (std::size_t at = 0; at < bag.size(); at += 3) {
    std::string damaged = bag;
    damaged[at] = static_cast<char>(random());
    EXPECT_LE(play("rosbag2:" + folder.write("a.bag", damaged)).scans.size(), 1U);
  }
}

TEST(HostileRecordings, ADamagedMessageGivesAScanWithinItsLimitsOrAnError) {
  std::mt19937 random(5);
  for (int i = 0; i < 20'000; ++i) {
    auto bytes = test::laser_message({}, Encoding::cdr_little);
    for (int change = 0; change < 3; ++change) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    const auto scan = decode_laser_scan(bytes, RosVersion::ros2);
    if (!scan) continue;
    EXPECT_LE(scan->ranges_m.size() * sizeof(float), bytes.size());
    EXPECT_TRUE(std::isfinite(scan->first_angle_rad));
    EXPECT_TRUE(std::isfinite(scan->angle_step_rad));
    EXPECT_LT(scan->range_min_m, scan->range_max_m);
    EXPECT_TRUE(std::isfinite(scan->range_max_m));
    EXPECT_GE(scan->sweep_time, Duration{0});
    EXPECT_LE(scan->sweep_time, std::chrono::seconds(10));
  }
}

TEST(HostileRecordings, AnyScanSurvivesItsEncoding) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> number(0.25F, 3.0F);
  for (int i = 0; i < 200; ++i) {
    std::vector<float> ranges(random() % 2000);
    for (float& range : ranges) range = number(random);
    const test::LaserFields fields{
        .seconds = static_cast<std::uint32_t>(random() >> 1),
        .nanoseconds = static_cast<std::uint32_t>(random() % 1'000'000'000U),
        .angle_min = -number(random),
        .angle_increment = number(random),
        .time_increment = 0.0F,
        .range_min = 0.125F,
        .range_max = number(random),
        .ranges = ranges};
    for (const Encoding encoding : {Encoding::cdr_little, Encoding::cdr_big, Encoding::ros1}) {
      const auto version = encoding == Encoding::ros1 ? RosVersion::ros1 : RosVersion::ros2;
      const auto scan = decode_laser_scan(test::laser_message(fields, encoding), version);
      ASSERT_TRUE(scan) << scan.error().text;
      EXPECT_EQ(scan->ranges_m, ranges);
      EXPECT_EQ(scan->stamp, Timestamp(std::chrono::seconds(fields.seconds) +
                                       std::chrono::nanoseconds(fields.nanoseconds)));
      EXPECT_EQ(scan->first_angle_rad, fields.angle_min);
    }
  }
}

TEST(DecimalSeconds, SurviveAWayThroughText) {
  std::mt19937_64 random(8);
  std::uniform_int_distribution<std::int64_t> time(-4'000'000'000'000'000'000,
                                                   4'000'000'000'000'000'000);
  for (int i = 0; i < 10'000; ++i) {
    const std::int64_t nanoseconds = time(random);
    const std::uint64_t size = static_cast<std::uint64_t>(std::abs(nanoseconds));
    const std::string text = fmt::format("{}{}.{:09}", nanoseconds < 0 ? "-" : "",
                                         size / 1'000'000'000U, size % 1'000'000'000U);
    EXPECT_EQ(parse_decimal_seconds(text), Duration(nanoseconds)) << text;
  }
}

}  // namespace
}  // namespace lifeline::sources
