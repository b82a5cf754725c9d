#include "agents/sources/ros2_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

namespace lifeline::sources {
namespace {

using ::testing::HasSubstr;

Result<Ros2Options> read(const std::string& source) {
  const auto spec = parse_source_spec(source);
  if (!spec) return forward_error(spec);
  return read_ros2_options(*spec);
}

std::string ros2_refusal(const std::string& source) {
  const auto options = read(source);
  if (options) return "accepted";
  EXPECT_EQ(options.error().code, ErrorCode::wrong_use);
  return options.error().text;
}

TEST(Ros2Options, NamesAScanTopicAndAnAttitudeTopic) {
  const auto options = read("ros2:/scan,/imu/data?domain=7&scans=20&qos=/etc/q.xml");
  ASSERT_TRUE(options) << options.error().text;
  EXPECT_EQ(options->scan, "/scan");
  EXPECT_EQ(options->imu, "/imu/data");
  EXPECT_EQ(options->domain, 7U);
  EXPECT_EQ(options->scans, 20);
  EXPECT_EQ(options->qos, "/etc/q.xml");
}

TEST(Ros2Options, AreThoseOfRos2WhereNothingIsSaid) {
  ::setenv("LIFELINE_CONFIG", LIFELINE_SOURCE_DIR "/config", 1);
  const auto options = read("ros2:front/scan_2");
  ::unsetenv("LIFELINE_CONFIG");
  ASSERT_TRUE(options) << options.error().text;
  EXPECT_EQ(options->scan, "/front/scan_2");
  EXPECT_EQ(options->imu, "");
  EXPECT_EQ(options->domain, 0U);
  EXPECT_EQ(options->scans, 0);
  EXPECT_EQ(options->qos, LIFELINE_SOURCE_DIR "/config/qos/ros2.xml");
}

TEST(Ros2Options, DdsNamesATopicWithItsPrefix) {
  EXPECT_EQ(dds_topic("/scan"), "rt/scan");
}

TEST(Ros2Options, WhatIsNoTopicNameIsRefusedByName) {
  for (const std::string name :
       {"/", "/scan/", "//scan", "/2scan", "/a//b", "/a b", "~/scan", "/scan-1", "/a/3d"}) {
    EXPECT_EQ(ros2_refusal("ros2:" + name),
              "ros2: '" + name + "' is no name of a ROS 2 topic; write ros2:/scan,/imu/data");
  }
  EXPECT_THAT(ros2_refusal("ros2:/scan,"), HasSubstr("'' is no name"));
  EXPECT_THAT(ros2_refusal("ros2:/scan,/imu,/more"), HasSubstr("'/imu,/more' is no name"));
  EXPECT_THAT(ros2_refusal("ros2:/" + std::string(300, 'a')), HasSubstr("is no name"));
  EXPECT_THAT(ros2_refusal("ros2:/scan,scan"), HasSubstr("/scan is named twice"));
}

TEST(Ros2Options, ValuesOutsideOfTheirRangeAreRefused) {
  EXPECT_THAT(ros2_refusal("ros2:/scan?domain=233"), HasSubstr("not an integer from 0 to 232"));
  EXPECT_THAT(ros2_refusal("ros2:/scan?scans=0"), HasSubstr("scans=0 is not an integer from 1"));
  EXPECT_THAT(ros2_refusal("ros2:/scan?imu=/imu"),
              HasSubstr("has no option 'imu'; there are: domain"));
}

}  // namespace
}  // namespace lifeline::sources
