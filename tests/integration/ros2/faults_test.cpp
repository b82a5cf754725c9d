// What a ROS 2 driver can do wrong is named, and ends nothing.

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "tests/integration/ros2/driver.hpp"

namespace lifeline::test {
namespace {

using sensing::AttitudeHealth;
using ::testing::HasSubstr;

const TopicToWrite kScan{"/scan", "sensor_msgs/msg/LaserScan"};
const TopicToWrite kImu{"/imu/data", "sensor_msgs/msg/Imu"};

class Ros2Faults : public Ros2Test {
 protected:
  /// Opens a source and starts a driver for it; both have found each other.
  void meet(const std::vector<MessageToWrite>& messages, const std::string& topics = "/scan",
            std::size_t publishers = 1) {
    write_db3(folder_.path("a.db3"), {kScan, kImu}, messages);
    auto opened = sources::open_source(source_text(topics), sources::kUnpaced, stop_.get_token());
    ASSERT_TRUE(opened) << opened.error().text;
    source_ = *std::move(opened);
    driver_ = start_driver(folder_.path("a.db3"));
    ASSERT_TRUE(wait_until([&] {
      return lines_with(logged_.text(), "has a publisher") == publishers;
    })) << logged_.text()
        << driver_->program.output();
  }
  sensing::RawScan next() { return source_->next().value().value(); }

  static MessageToWrite scan(std::uint32_t second, LaserFields fields = {}) {
    fields.seconds = second;
    return {0, second * std::int64_t{1'000'000'000}, laser_message(fields, Encoding::cdr_little)};
  }
  static MessageToWrite imu(std::uint32_t second, ImuFields fields = {}) {
    fields.seconds = second;
    return {1, second * std::int64_t{1'000'000'000}, imu_message(fields, Encoding::cdr_little)};
  }

  Logged logged_;
  std::stop_source stop_;
  std::unique_ptr<sensing::ScanSource> source_;
  std::unique_ptr<Driver> driver_;
};

TEST_F(Ros2Faults, AQosFileThatIsNotThereOrNotForThisIsNamedAtTheStart) {
  const auto refusal = [](const std::string& file) {
    const auto opened = sources::open_source("ros2:/scan?qos=" + file);
    return opened ? "opened" : opened.error().text;
  };
  EXPECT_THAT(refusal("/lifeline/none.xml"),
              HasSubstr("/lifeline/none.xml: no such QoS profile file"));
  EXPECT_THAT(refusal(LIFELINE_SOURCE_DIR "/config/qos/wifi.xml"),
              HasSubstr("participant profile 'ros2_participant' is missing"));
}

TEST_F(Ros2Faults, ATopicThatNobodyPublishesIsNamed) {
  const auto opened =
      sources::open_source(source_text("/scan"), sources::kUnpaced, stop_.get_token());
  ASSERT_TRUE(opened) << opened.error().text;
  const std::string line =
      "/scan: nobody publishes it (DDS: rt/scan) in domain " + domain_.text() + ";";
  EXPECT_TRUE(wait_until([&] { return lines_with(logged_.text(), line) == 1; })) << logged_.text();
}

TEST_F(Ros2Faults, ATopicOfAnotherTypeIsNamed) {
  write_db3(folder_.path("a.db3"), {kScan, kImu}, {imu(1)});
  const auto opened =
      sources::open_source(source_text("/scan"), sources::kUnpaced, stop_.get_token());
  ASSERT_TRUE(opened) << opened.error().text;
  const auto driver =
      start_driver(folder_.path("a.db3"), {"--publish-scan", "/other", "--publish-imu", "/scan"});
  const std::string line =
      "/scan: is published as sensor_msgs::msg::dds_::Imu_, not as "
      "sensor_msgs::msg::dds_::LaserScan_; name the right topic";
  EXPECT_TRUE(wait_until([&] { return lines_with(logged_.text(), line) == 1; }))
      << logged_.text() << driver->program.output();
}

TEST_F(Ros2Faults, ADriverThatFallsSilentIsNamedAndHeardAgain) {
  meet({scan(1), scan(2)});
  driver_->go();
  EXPECT_EQ(next().stamp, Timestamp(std::chrono::seconds(1) + std::chrono::nanoseconds(500)));
  EXPECT_TRUE(wait_until([&] {
    return lines_with(logged_.text(), "/scan: silent, though its publisher is there") == 1;
  })) << logged_.text();
  driver_->go();
  EXPECT_EQ(next().stamp, Timestamp(std::chrono::seconds(2) + std::chrono::nanoseconds(500)));
  EXPECT_TRUE(wait_until([&] { return lines_with(logged_.text(), "/scan: is heard") == 1; }));
}

TEST_F(Ros2Faults, ScansThatAreNoneAreCountedAndNamedAndTheNextGoodOneIsTaken) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  meet({scan(1, {.angle_min = nan}), scan(2, {.angle_increment = 0.0F}),
        scan(3, {.range_min = 2.0F, .range_max = 1.0F}), scan(4, {.nanoseconds = 2'000'000'000}),
        scan(5, {.ranges = std::vector<float>(40'000, 1.0F)}),   // too many
        scan(6, {.ranges = std::vector<float>(200'000, 1.0F)}),  // not even taken by DDS
        scan(7, {.ranges = {nan, 1.0F, -1.0F}}), scan(8)});
  driver_->go(8);
  EXPECT_EQ(next().ranges_m.size(), 3U);  // any ranges at all
  EXPECT_EQ(next().stamp, Timestamp(std::chrono::seconds(8) + std::chrono::nanoseconds(500)));
  EXPECT_THAT(logged_.text(), HasSubstr("/scan: 1 of its messages cannot be used so far; the last: "
                                        "angle_min nan is no angle"));
}

TEST_F(Ros2Faults, AnImuWithoutOrientationIsNamedAndScansGoOnWithoutAttitude) {
  meet({imu(1, {.first_covariance = -1.0}), scan(1)}, "/scan,/imu/data", 2);
  driver_->go();
  const sensing::RawScan scan = next();
  EXPECT_FALSE(scan.attitude);
  EXPECT_NE(scan.attitude_health, AttitudeHealth::good);
  EXPECT_THAT(logged_.text(), HasSubstr("/imu/data: 1 of its messages cannot be used so far; the "
                                        "last: it gives no orientation"));
}

TEST_F(Ros2Faults, AnOrientationThatIsNoneIsNotUsed) {
  meet({imu(1, {.w = std::numeric_limits<double>::quiet_NaN()}), scan(1)}, "/scan,/imu/data", 2);
  driver_->go();
  EXPECT_FALSE(next().attitude);
  EXPECT_THAT(logged_.text(), HasSubstr("is no rotation"));
}

TEST_F(Ros2Faults, AClockThatIsSetBackHarmsNothing) {
  std::vector<MessageToWrite> messages{imu(1000), scan(1000), imu(1001), scan(1001),
                                       imu(10),   scan(10),   imu(11),   scan(11)};
  std::int64_t sent_ns = 0;
  for (MessageToWrite& message : messages) message.time_ns = ++sent_ns;
  meet(messages, "/scan,/imu/data", 2);
  for (const int second : {1000, 1001, 10, 11}) {
    driver_->go();
    const sensing::RawScan scan = next();
    EXPECT_EQ(scan.stamp, Timestamp(std::chrono::seconds(second) + std::chrono::nanoseconds(500)));
    EXPECT_TRUE(scan.attitude) << second;  // that of its own time
  }
}

TEST_F(Ros2Faults, AStopEndsASourceThatWaits) {
  meet({scan(1)});
  std::jthread stopper([&] { stop_.request_stop(); });
  EXPECT_FALSE(source_->next().value());
}

TEST_F(Ros2Faults, ASourceThatNobodyReadsAnyMoreEnds) {
  meet({scan(1), scan(2)});
  driver_->go(2);
  source_.reset();
}

}  // namespace
}  // namespace lifeline::test
