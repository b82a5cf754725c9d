#include "common/ros2/messages.hpp"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/ros2/cdr_reader.hpp"
#include "common/ros2/cdr_writer.hpp"
#include "common/ros2/names.hpp"

namespace lifeline::ros2 {
namespace {

const Timestamp kStamp{std::chrono::seconds(0x01020304) + std::chrono::nanoseconds(5)};

std::string hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const auto byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

TEST(Ros2Messages, APoseHasTheseOctets) {
  // Header, then 7 doubles from offset 16 (behind the encapsulation) on: 4 + 4 + 4 + 2 + padding 2.
  EXPECT_EQ(hex(pose_stamped(kStamp, "m", {1.0, -2.0, 0.0})),
            "00010000"
            "04030201"
            "05000000"
            "02000000"
            "6d00"
            "0000"
            "000000000000f03f"
            "00000000000000c0"
            "0000000000000000"
            "0000000000000000"
            "0000000000000000"
            "0000000000000000"
            "000000000000f03f");
}

TEST(Ros2Messages, AGridHasTheseOctets) {
  OccupancyGrid grid{
      0.5, {-1.0, 2.0}, 3, 1, {Occupancy::unknown, Occupancy::free, Occupancy::occupied}};
  EXPECT_EQ(hex(occupancy_grid(kStamp, "map", grid)),
            "00010000"
            "04030201"
            "05000000"
            "04000000"
            "6d617000"  // header
            "04030201"
            "05000000"  // map_load_time
            "0000003f"
            "03000000"
            "01000000"
            "00000000"  // resolution, width, height, padding
            "000000000000f0bf"
            "0000000000000040"
            "0000000000000000"
            "0000000000000000"
            "0000000000000000"
            "0000000000000000"
            "000000000000f03f"
            "03000000"
            "ff0064");
}

TEST(Ros2Messages, ATransformHasTheseOctets) {
  const Transform transform{"map", "a", {0.0, 1.0, 0.0}};
  EXPECT_EQ(hex(tf_message(kStamp, {&transform, 1})),
            "00010000"
            "01000000"
            "04030201"
            "05000000"
            "04000000"
            "6d617000"
            "02000000"
            "6100"
            "0000"
            "00000000"
            "0000000000000000"
            "000000000000f03f"
            "0000000000000000"
            "0000000000000000"
            "0000000000000000"
            "0000000000000000"
            "000000000000f03f")
      << "count, header, child, padding to 8, translation, rotation";
}

TEST(Ros2Messages, AScanHasTheseOctets) {
  EXPECT_EQ(hex(laser_scan(kStamp, "l", {0.0F, 0.5F, 0.25F, 8.0F, {1.0F, 2.0F, 4.0F}})),
            "00010000"
            "04030201"
            "05000000"
            "02000000"
            "6c00"
            "0000"
            "00000000"
            "0000803f"
            "0000003f"
            "00000000"
            "00000000"
            "0000803e"
            "00000041"
            "03000000"
            "0000803f"
            "00000040"
            "00008040"
            "00000000");
}

TEST(Ros2Messages, APathIsReadBackAsItWasWritten) {
  const std::vector<StampedPose> poses{{kStamp, {1.0, 2.0, 0.0}},
                                       {kStamp + std::chrono::seconds(1), {3.0, 4.0, 0.0}}};
  const auto bytes = path(kStamp, "map", poses);
  auto reader = CdrReader::open_cdr(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->read<std::int32_t>(), 0x01020304);
  EXPECT_EQ(reader->read<std::uint32_t>(), 5U);
  reader->skip_text();
  ASSERT_EQ(reader->read<std::uint32_t>(), 2U);
  for (const StampedPose& at : poses) {
    EXPECT_EQ(reader->read<std::int32_t>(),
              std::chrono::floor<std::chrono::seconds>(at.stamp.time_since_epoch()).count());
    EXPECT_EQ(reader->read<std::uint32_t>(), 5U);
    reader->skip_text();
    EXPECT_EQ(reader->read<double>(), at.pose.x_m);
    EXPECT_EQ(reader->read<double>(), at.pose.y_m);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(reader->read<double>(), 0.0);
    EXPECT_EQ(reader->read<double>(), 1.0);
  }
  EXPECT_TRUE(reader->ok());
}

TEST(Ros2Names, TopicsAndTypesAreCalledAsDdsHasThem) {
  EXPECT_EQ(dds_topic("/lifeline/map"), "rt/lifeline/map");
  EXPECT_EQ(dds_type("nav_msgs/msg/OccupancyGrid"), "nav_msgs::msg::dds_::OccupancyGrid_");
}

TEST(Ros2Names, EveryAgentHasAValidNameOfItsOwn) {
  AgentNames names;
  EXPECT_EQ(names.of("alpha"), "alpha");
  EXPECT_EQ(names.of("ff-1"), "ff_1");
  EXPECT_EQ(names.of("ff.1"), "ff_1_2");
  EXPECT_EQ(names.of("ff-1"), "ff_1");
  EXPECT_EQ(names.of("7"), "helmet_7");
  EXPECT_EQ(names.of("a__b--"), "a_b");
  EXPECT_EQ(names.of("-.-"), "helmet");
  EXPECT_EQ(names.of("map"), "map_2");
}

}  // namespace
}  // namespace lifeline::ros2
