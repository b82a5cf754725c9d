#include "agents/sources/open_source.hpp"

#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using test::carmen_log;
using test::RecordingFolder;
using ::testing::HasSubstr;

std::string opening_refusal(std::string_view source, SourcePace pace = kUnpaced) {
  const auto opened = open_source(source, pace);
  if (opened) return "opened";
  EXPECT_EQ(opened.error().code, ErrorCode::wrong_use);
  return opened.error().text;
}

TEST(OpenSource, ListsTheKindsWhenItKnowsNotTheOneAskedFor) {
  EXPECT_EQ(opening_refusal("ros3:/scan,/imu"),
            "source 'ros3:/scan,/imu': unknown kind 'ros3'; there are: carmen, columns, ros2, "
            "rosbag2, rplidar, sim");
  EXPECT_THAT(opening_refusal("intel.log.gz"), HasSubstr("does not begin with a kind"));
}

TEST(OpenSource, ReadsTheRateForEveryKind) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.log", carmen_log(180, 2));
  EXPECT_THAT(opening_refusal("carmen:" + path + "?rate=fast"), HasSubstr("rate=fast is none of"));
  EXPECT_THAT(opening_refusal("rosbag2:" + path + "?rate=fast"), HasSubstr("rate=fast is none of"));
  EXPECT_TRUE(open_source("carmen:" + path + "?rate=x2"));
}

TEST(OpenSource, ALiveLidarHasItsOwnPaceOnly) {
  EXPECT_EQ(opening_refusal("rplidar:/dev/none?rate=max"),
            "source 'rplidar:/dev/none?rate=max': a live lidar has no rate but real");
  const auto opened = open_source("rplidar:/dev/lifeline_none?rate=real");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::not_found);
  EXPECT_THAT(opened.error().text, HasSubstr("/dev/lifeline_none: no such device"));
}

TEST(OpenSource, ARos2DriverHasItsOwnPaceAndBringsItsOwnAttitude) {
  EXPECT_EQ(opening_refusal("ros2:/scan?rate=x2"),
            "source 'ros2:/scan?rate=x2': a live lidar has no rate but real");
  const auto opened = open_source_with_attitude("ros2:/scan", "ahrs:/dev/none");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::wrong_use);
  EXPECT_THAT(opened.error().text, HasSubstr("takes its attitude by a topic: write ros2:/scan,"));
}

TEST(OpenSource, PlaysWithoutWaitingByDefault) {
  const RecordingFolder folder;
  const auto source = open_source("carmen:" + folder.write("a.log", carmen_log(180, 500)));
  ASSERT_TRUE(source);
  for (int i = 0; i < 500; ++i) ASSERT_TRUE((*source)->next().value());  // 500 s as recorded
  EXPECT_FALSE((*source)->next().value());
}

TEST(OpenSource, AnOptionOverridesTheDefaultPace) {
  const RecordingFolder folder;
  const std::string path = folder.write("a.log", carmen_log(180, 500));
  const auto source = open_source("carmen:" + path + "?rate=max", kRealTime);
  ASSERT_TRUE(source);
  for (int i = 0; i < 500; ++i) ASSERT_TRUE((*source)->next().value());
}

TEST(OpenSource, AStopEndsASourceThatWaitsForItsNextScan) {
  const RecordingFolder folder;
  std::stop_source stop;
  const std::string log = test::flaser_line(180, 0, "0") + test::flaser_line(180, 1, "3600");
  const auto source =
      open_source("carmen:" + folder.write("a.log", log), kRealTime, stop.get_token());
  ASSERT_TRUE(source);
  EXPECT_TRUE((*source)->next().value());
  std::jthread stopper([&] { stop.request_stop(); });
  EXPECT_FALSE((*source)->next().value());  // an hour early
}

}  // namespace
}  // namespace lifeline::sources
