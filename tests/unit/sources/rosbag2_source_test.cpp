#include "agents/sources/rosbag2_source.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using test::Encoding;
using test::imu_message;
using test::laser_message;
using test::MessageToWrite;
using test::play;
using test::Played;
using test::RecordingFolder;
using test::TopicToWrite;
using test::write_db3;
using ::testing::HasSubstr;

constexpr std::int64_t kSecondNs = 1'000'000'000;
const TopicToWrite kScan{"/scan", "sensor_msgs/msg/LaserScan"};
const TopicToWrite kOtherScan{"/rear", "sensor_msgs/msg/LaserScan"};
const TopicToWrite kImu{"/imu", "sensor_msgs/msg/Imu"};
const TopicToWrite kPose{"/pose", "geometry_msgs/msg/PoseStamped"};

/// A scan at `second` with `beams` beams of the length `second` in metres.
MessageToWrite scan_to_write(std::size_t topic, std::uint32_t second, std::size_t beams = 3) {
  return {topic, second * kSecondNs,
          laser_message({.seconds = second,
                         .nanoseconds = 0,
                         .ranges = std::vector<float>(beams, static_cast<float>(second))},
                        Encoding::cdr_little)};
}

/// The yaw is 0.2 rad times the seconds.
MessageToWrite yaw_message(std::size_t topic, std::uint32_t second) {
  const double half_rad = 0.1 * second;
  return {topic, second * kSecondNs,
          imu_message({.seconds = second,
                       .nanoseconds = 20'000'000,
                       .z = std::sin(half_rad),
                       .w = std::cos(half_rad)},
                      Encoding::cdr_little)};
}

TEST(Rosbag2Source, PlaysTheScansInTheOrderOfRecordingWhateverElseTheBagHolds) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kPose, kScan},
            {scan_to_write(1, 3),
             {0, 1 * kSecondNs, {1, 2, 3}},
             scan_to_write(1, 1),
             scan_to_write(1, 2)});
  for (const std::string& target : {folder.path(""), folder.path("a.db3")}) {
    const Played played = play("rosbag2:" + target);
    ASSERT_EQ(played.error, "");
    ASSERT_EQ(played.scans.size(), 3U);
    for (int i = 0; i < 3; ++i) {
      const sensing::RawScan& scan = played.scans[static_cast<std::size_t>(i)];
      EXPECT_EQ(scan.stamp, Timestamp(std::chrono::seconds(i + 1)));
      EXPECT_EQ(scan.ranges_m, std::vector<float>(3, static_cast<float>(i + 1)));
      EXPECT_FALSE(scan.attitude);
    }
  }
}

TEST(Rosbag2Source, TakesBeamCountsThatVaryFromScanToScan) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kScan},
            {scan_to_write(0, 1, 453), scan_to_write(0, 2, 456), scan_to_write(0, 3, 0)});
  const Played played = play("rosbag2:" + folder.path(""));
  ASSERT_EQ(played.scans.size(), 3U);
  EXPECT_EQ(played.scans[0].ranges_m.size(), 453U);
  EXPECT_EQ(played.scans[1].ranges_m.size(), 456U);
  EXPECT_EQ(played.scans[2].ranges_m.size(), 0U);
}

TEST(Rosbag2Source, PlaysASplitRecordingInTheOrderOfTime) {
  const RecordingFolder folder;
  write_db3(folder.path("bag_10.db3"), {kScan}, {scan_to_write(0, 5)});
  write_db3(folder.path("bag_9.db3"), {kPose, kScan}, {scan_to_write(1, 3), scan_to_write(1, 4)});
  write_db3(folder.path("bag_1.db3"), {kScan}, {scan_to_write(0, 1)});
  const Played played = play("rosbag2:" + folder.path(""));
  ASSERT_EQ(played.scans.size(), 4U) << played.error;
  EXPECT_EQ(played.scans[0].ranges_m[0], 1.0F);
  EXPECT_EQ(played.scans[1].ranges_m[0], 3.0F);
  EXPECT_EQ(played.scans[3].ranges_m[0], 5.0F);
}

TEST(Rosbag2Source, PlaysTheFirstScanTopicOrTheOneAskedFor) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kScan, kOtherScan}, {scan_to_write(0, 1), scan_to_write(1, 2)});
  EXPECT_EQ(play("rosbag2:" + folder.path("")).scans.at(0).ranges_m[0], 1.0F);
  const Played rear = play("rosbag2:" + folder.path("") + "?scan=/rear");
  ASSERT_EQ(rear.scans.size(), 1U);
  EXPECT_EQ(rear.scans[0].ranges_m[0], 2.0F);
}

TEST(Rosbag2Source, GivesTheAttitudeOfTheImuAtEachScansTime) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kImu, kScan},
            {yaw_message(0, 1), scan_to_write(1, 1), scan_to_write(1, 2), yaw_message(0, 3),
             scan_to_write(1, 3)});
  const Played played = play("rosbag2:" + folder.path(""));
  ASSERT_EQ(played.scans.size(), 3U) << played.error;
  ASSERT_TRUE(played.scans[0].attitude);
  EXPECT_NEAR(played.scans[0].attitude->yaw_rad, 0.2, 1e-9);
  EXPECT_FALSE(played.scans[1].attitude);
  ASSERT_TRUE(played.scans[2].attitude);
  EXPECT_NEAR(played.scans[2].attitude->yaw_rad, 0.6, 1e-9);

  EXPECT_FALSE(play("rosbag2:" + folder.path("") + "?imu=none").scans.at(0).attitude);
  EXPECT_TRUE(play("rosbag2:" + folder.path("") + "?imu=/imu").scans.at(0).attitude);
}

TEST(Rosbag2Source, PlaysTheHalfOpenRangeOfScansOnly) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kScan},
            {scan_to_write(0, 1), scan_to_write(0, 2), scan_to_write(0, 3), scan_to_write(0, 4)});
  const Played played = play("rosbag2:" + folder.path("") + "?from=1&to=3");
  ASSERT_EQ(played.scans.size(), 2U);
  EXPECT_EQ(played.scans[0].ranges_m[0], 2.0F);
  EXPECT_EQ(play("rosbag2:" + folder.path("") + "?from=4").error,
            folder.path("") + ": holds 4 scans, from=4 is beyond the last");
}

TEST(Rosbag2Source, ReadsAFolderThatNobodyMayWriteTo) {
  const RecordingFolder folder;
  std::filesystem::create_directory(folder.path("bag #1?"));
  write_db3(folder.path("bag #1?/a.db3"), {kScan}, {scan_to_write(0, 1)});
  using std::filesystem::perms;
  std::filesystem::permissions(folder.path("bag #1?"), perms::owner_read | perms::owner_exec);
  const Played played = play("rosbag2:" + folder.path("bag #1?") + "?to=9");
  EXPECT_EQ(played.error, "");
  EXPECT_EQ(played.scans.size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(folder.path("bag #1?/a.db3-shm")));
  std::filesystem::permissions(folder.path("bag #1?"), perms::owner_all);
}

TEST(Rosbag2Source, NamesAMissingBagAndAFolderWithoutOne) {
  const RecordingFolder folder;
  EXPECT_EQ(play("rosbag2:/nowhere/bag").error, "/nowhere/bag: no such file or folder");
  const Played empty = play("rosbag2:" + folder.path(""));
  EXPECT_EQ(empty.error, folder.path("") + ": holds no bag: neither a .db3 nor a .bag file");
  EXPECT_EQ(empty.code, ErrorCode::not_found);
}

TEST(Rosbag2Source, NamesRecordingsThatItCannotRead) {
  for (const std::string ending : {".mcap", ".zstd"}) {
    const RecordingFolder folder;
    folder.write("bag_0.db3" + ending, "x");
    const Played played = play("rosbag2:" + folder.path(""));
    EXPECT_EQ(played.error, folder.path("") + ": holds only " + ending +
                                " files: convert them to uncompressed sqlite3 with ros2 bag "
                                "convert");
    EXPECT_EQ(played.code, ErrorCode::unsupported);
  }
}

TEST(Rosbag2Source, NamesABagWithoutScans) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kScan, kPose}, {});
  EXPECT_EQ(play("rosbag2:" + folder.path("")).error,
            folder.path("") + ": holds no scan: topic /scan is empty");
  const RecordingFolder other;
  write_db3(other.path("a.db3"), {kPose, kImu}, {});
  EXPECT_EQ(play("rosbag2:" + other.path("")).error,
            other.path("") +
                ": has no LaserScan topic; it holds /pose "
                "(geometry_msgs/msg/PoseStamped), /imu (sensor_msgs/msg/Imu)");
  const RecordingFolder none;
  write_db3(none.path("a.db3"), {}, {});
  EXPECT_EQ(play("rosbag2:" + none.path("")).error,
            none.path("") + ": has no LaserScan topic; it holds no topic");
}

TEST(Rosbag2Source, NamesATopicThatIsMissingOrOfAnotherType) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kScan, kPose}, {scan_to_write(0, 1)});
  const std::string bag = "rosbag2:" + folder.path("");
  EXPECT_THAT(play(bag + "?scan=/front").error, HasSubstr("has no topic /front; it holds /scan"));
  EXPECT_THAT(play(bag + "?imu=/imu").error, HasSubstr("has no topic /imu; it holds /scan"));
  const Played pose = play(bag + "?scan=/pose");
  EXPECT_THAT(pose.error,
              HasSubstr("topic /pose is of type geometry_msgs/msg/PoseStamped, not LaserScan"));
  EXPECT_EQ(pose.code, ErrorCode::wrong_use);
  EXPECT_EQ(play(bag + "?topic=/scan").error,
            "rosbag2: has no option 'topic'; there are: scan, imu, from, to, rate");
}

TEST(Rosbag2Source, ListsTenTopicsAtMost) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), std::vector<TopicToWrite>(14, kPose), {});
  EXPECT_THAT(play("rosbag2:" + folder.path("")).error, ::testing::EndsWith(", 4 more"));
}

TEST(Rosbag2Source, NamesAFileThatIsNoBag) {
  const RecordingFolder folder;
  const std::string text = folder.write("a.db3", std::string(5000, 'x'));
  EXPECT_EQ(play("rosbag2:" + text).error,
            text + ": is no rosbag2 file, or damaged or truncated (file is not a database)");
  const std::string empty = folder.write("b.db3", "");
  EXPECT_EQ(play("rosbag2:" + empty).error,
            empty + ": is no rosbag2 file: it lacks the tables of one");
}

TEST(Rosbag2Source, NamesATruncatedBag) {
  const RecordingFolder folder;
  std::vector<MessageToWrite> messages;
  for (std::uint32_t second = 1; second < 100; ++second) {
    messages.push_back(scan_to_write(0, second, 500));
  }
  write_db3(folder.path("whole.db3"), {kScan}, messages);
  std::ifstream file(folder.path("whole.db3"), std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(file), {});
  const std::string cut = folder.write("cut.db3", whole.substr(0, whole.size() / 2));
  const Played played = play("rosbag2:" + cut);
  EXPECT_THAT(played.error, HasSubstr(cut + ": is no rosbag2 file, or damaged or truncated"));
  EXPECT_EQ(played.code, ErrorCode::bad_data);
}

TEST(Rosbag2Source, NamesAnotherSerialization) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {{"/scan", "sensor_msgs/msg/LaserScan", "protobuf"}}, {});
  EXPECT_EQ(play("rosbag2:" + folder.path("")).error,
            folder.path("a.db3") + ": topic /scan is serialized as 'protobuf', only cdr is known");
}

TEST(Rosbag2Source, NamesTheMessageThatIsMalformed) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kScan},
            {scan_to_write(0, 1), {0, 2 * kSecondNs, {0, 1, 0, 0, 9}}, scan_to_write(0, 3)});
  const Played played = play("rosbag2:" + folder.path(""));
  EXPECT_EQ(played.scans.size(), 1U);
  EXPECT_EQ(played.error,
            folder.path("a.db3") +
                ": message 2 of /scan: its 5 bytes are no whole LaserScan of at most 32768 beams");

  write_db3(folder.path("b.db3"), {kScan, kImu}, {scan_to_write(0, 1), {1, kSecondNs, {}}});
  EXPECT_EQ(play("rosbag2:" + folder.path("b.db3")).error,
            folder.path("b.db3") + ": message 1 of /imu: 0 bytes are too few for a message");
}

TEST(Rosbag2Source, RefusesAMessageLargerThanAnyScan) {
  const RecordingFolder folder;
  write_db3(folder.path("a.db3"), {kScan},
            {{0, kSecondNs, std::vector<std::uint8_t>(5 * 1024 * 1024)}});
  EXPECT_THAT(play("rosbag2:" + folder.path("")).error,
              HasSubstr("message 1 of /scan: 5242880 bytes are more than any scan has"));
}

}  // namespace
}  // namespace lifeline::sources
