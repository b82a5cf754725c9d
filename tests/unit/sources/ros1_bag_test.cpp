#include "agents/sources/ros1_bag.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using test::Encoding;
using test::laser_message;
using test::MessageToWrite;
using test::play;
using test::Played;
using test::RecordingFolder;
using test::ros1_bag;
using test::TopicToWrite;
using ::testing::AnyOf;
using ::testing::HasSubstr;

const std::vector<TopicToWrite> kTopics{{"/tf", "tf2_msgs/TFMessage"},
                                        {"/scan", "sensor_msgs/LaserScan"}};

MessageToWrite scan_message(std::uint32_t second, std::size_t beams = 3) {
  return {1, 0,
          laser_message({.seconds = second, .ranges = std::vector<float>(beams, 2.0F)},
                        Encoding::ros1)};
}

const std::vector<MessageToWrite> kMessages{scan_message(1), {0, 0, {1, 2, 3}}, scan_message(2)};

TEST(Ros1Bag, PlaysThroughTheSameSourceAsRosbag2) {
  const RecordingFolder folder;
  const std::string path = folder.write("demo.bag", ros1_bag(kTopics, kMessages));
  for (const std::string& target : {path, folder.path("")}) {
    const Played played = play("rosbag2:" + target);
    ASSERT_EQ(played.error, "");
    ASSERT_EQ(played.scans.size(), 2U);
    EXPECT_EQ(played.scans[1].stamp, Timestamp(Duration(2'000'000'500)));
    EXPECT_EQ(played.scans[1].ranges_m, std::vector<float>(3, 2.0F));
  }
}

TEST(Ros1Bag, ListsEachTopicOnce) {
  const RecordingFolder folder;
  const auto topics = ros1_topics(folder.write("a.bag", ros1_bag(kTopics, kMessages)));
  ASSERT_TRUE(topics) << topics.error().text;
  ASSERT_EQ(topics->size(), 2U);
  EXPECT_EQ((*topics)[0].name, "/scan");
  EXPECT_EQ((*topics)[0].type, "sensor_msgs/LaserScan");
  EXPECT_EQ((*topics)[1].name, "/tf");
}

TEST(Ros1Bag, TrustsTheCountOfAnIndexRecordRatherThanItsLength) {
  const RecordingFolder folder;
  for (const std::uint32_t extra : {1U, 8U, 100'000U}) {
    const std::string bag = ros1_bag(kTopics, kMessages, {.extra_index_length = extra});
    const Played played = play("rosbag2:" + folder.write("a.bag", bag));
    EXPECT_EQ(played.error, "");
    EXPECT_EQ(played.scans.size(), 2U) << extra;
  }
}

TEST(Ros1Bag, GivesTheAttitudeOfItsImu) {
  const RecordingFolder folder;
  const std::vector<TopicToWrite> topics{{"/imu", "sensor_msgs/Imu"},
                                         {"/scan", "sensor_msgs/LaserScan"}};
  const MessageToWrite imu{
      0, 0,
      test::imu_message({.seconds = 1, .z = std::sin(0.2), .w = std::cos(0.2)}, Encoding::ros1)};
  const Played played =
      play("rosbag2:" + folder.write("a.bag", ros1_bag(topics, {scan_message(1), imu})));
  ASSERT_EQ(played.scans.size(), 1U) << played.error;
  ASSERT_TRUE(played.scans[0].attitude);
  EXPECT_NEAR(played.scans[0].attitude->yaw_rad, 0.4, 1e-12);
}

TEST(Ros1Bag, NamesCompressedChunks) {
  const RecordingFolder folder;
  const std::string path =
      folder.write("a.bag", ros1_bag(kTopics, kMessages, {.compression = "bz2"}));
  const Played played = play("rosbag2:" + path);
  EXPECT_EQ(played.error, path + ": its chunks are compressed: run rosbag decompress");
  EXPECT_EQ(played.code, ErrorCode::unsupported);
}

TEST(Ros1Bag, NamesAFileThatIsNoBagOrOfAnotherFormat) {
  const RecordingFolder folder;
  const std::string old = folder.write("old.bag", "#ROSBAG V1.2\nxxxxxxxxxxxx");
  EXPECT_EQ(play("rosbag2:" + old).error, old + ": is no ROS 1 bag of format 2.0");
  const std::string tiny = folder.write("tiny.bag", "#ROSBAG");
  EXPECT_EQ(play("rosbag2:" + tiny).error, tiny + ": is no ROS 1 bag of format 2.0");
  const auto missing = ros1_topics(folder.path("none.bag"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text, folder.path("none.bag") + ": no such file");
}

TEST(Ros1Bag, NamesAnEmptyBag) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.bag", ros1_bag(kTopics, {}));
  EXPECT_EQ(play("rosbag2:" + path).error, path + ": holds no scan: topic /scan is empty");
  const std::string bare = folder.write("b.bag", ros1_bag({}, {}));
  EXPECT_EQ(play("rosbag2:" + bare).error, bare + ": has no LaserScan topic; it holds no topic");
}

TEST(Ros1Bag, AsksWhichOfSeveralBagsInAFolder) {
  const RecordingFolder folder;
  folder.write("a.bag", ros1_bag(kTopics, kMessages));
  folder.write("b.bag", ros1_bag(kTopics, kMessages));
  const Played played = play("rosbag2:" + folder.path(""));
  EXPECT_EQ(played.error, folder.path("") + ": holds 2 .bag files: name one of them");
  EXPECT_EQ(played.code, ErrorCode::wrong_use);
}

TEST(Ros1Bag, SaysWhereItIsCutOff) {
  const RecordingFolder folder;
  const std::string whole = ros1_bag(kTopics, kMessages);
  for (const std::size_t missing : {1U, 30U, 150U, 300U}) {
    const std::string path = folder.write("a.bag", whole.substr(0, whole.size() - missing));
    const Played played = play("rosbag2:" + path);
    EXPECT_THAT(played.error, HasSubstr(path + ": record at byte "));
    EXPECT_THAT(played.error, HasSubstr(": the file is cut off"));
    EXPECT_EQ(played.code, ErrorCode::bad_data);
  }
}

TEST(Ros1Bag, NamesRecordsThatMakeNoSense) {
  const RecordingFolder folder;
  const auto refusal = [&](const std::string& record) {
    return play("rosbag2:" + folder.write("a.bag", "#ROSBAG V2.0\n" + record)).error;
  };
  const std::string where = folder.path("a.bag") + ": record at byte 13: ";
  EXPECT_EQ(refusal(std::string("\xff\xff\xff\x7fxxxx", 8)), where + "its header is too long");
  EXPECT_EQ(refusal(std::string("\x04\0\0\0\xff\0\0\0", 8) + std::string(4, '\0')),
            where + "its header makes no sense");
  EXPECT_EQ(refusal(std::string("\x08\0\0\0\x04\0\0\0abcd", 12)),
            where + "its header makes no sense");
  EXPECT_EQ(refusal(std::string(8, '\0')), where + "its header makes no sense");
  EXPECT_EQ(refusal("ab"), where + "the file is cut off");
}

TEST(Ros1Bag, RefusesAMessageLargerThanAnyScan) {
  const RecordingFolder folder;
  const std::vector<MessageToWrite> messages{
      {1, 0, std::vector<std::uint8_t>(kMaxMessageBytes + 1)}};
  const std::string path = folder.write("a.bag", ros1_bag(kTopics, messages));
  EXPECT_THAT(play("rosbag2:" + path).error, HasSubstr("it is longer than such a record can be"));
}

}  // namespace
}  // namespace lifeline::sources
