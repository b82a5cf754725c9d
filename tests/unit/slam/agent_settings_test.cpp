#include "agents/agent_settings.hpp"

#include <gtest/gtest.h>

#include "agents/sources/simulator/sensors.hpp"
#include "common/base/angles.hpp"
#include "idl/config.pb.h"
#include "tests/support/temporary_folder.hpp"

namespace lifeline {
namespace {

TEST(AgentSettings, DefaultsAreThoseOfTheProjectionAndOfTheSimulatedHead) {
  const auto settings = to_settings(read_agent_config({}, {}).value());
  const sensing::ProjectionConfig defaults;
  EXPECT_DOUBLE_EQ(settings.projection.sensor_height_m, defaults.sensor_height_m);
  EXPECT_DOUBLE_EQ(settings.projection.ceiling_height_m, defaults.ceiling_height_m);
  EXPECT_DOUBLE_EQ(settings.projection.height_margin_m, defaults.height_margin_m);
  EXPECT_DOUBLE_EQ(settings.projection.tilt_margin_rad, defaults.tilt_margin_rad);
  EXPECT_EQ(settings.projection.mount.yaw_rad, 0.0);
  EXPECT_TRUE(settings.projection.mount.lever_body_m.isZero(0.0));
  const sources::LidarOptions simulated;
  EXPECT_DOUBLE_EQ(settings.projection.sensor_height_m, simulated.height_m);
  EXPECT_DOUBLE_EQ(settings.projection.ceiling_height_m, simulated.ceiling_m);
}

TEST(AgentSettings, TakesHeightsAndMountFromTheFile) {
  const support::TemporaryFolder folder;
  const auto file = folder.write(
      "a.yaml",
      "sensing: {lidar_height_m: 1.9, ceiling_height_m: 3.5, height_margin_m: 0.2, "
      "tilt_margin_deg: 1.5, mount_roll_deg: 3, mount_pitch_deg: -6, mount_yaw_deg: 90, "
      "lever_x_m: 0.1, lever_y_m: -0.05, lever_z_m: 0.3}");
  const auto projection = to_settings(read_agent_config(file, {}).value()).projection;
  EXPECT_DOUBLE_EQ(projection.sensor_height_m, 1.9);
  EXPECT_DOUBLE_EQ(projection.ceiling_height_m, 3.5);
  EXPECT_DOUBLE_EQ(projection.height_margin_m, 0.2);
  EXPECT_DOUBLE_EQ(projection.tilt_margin_rad, 1.5 * kDegree);
  EXPECT_DOUBLE_EQ(projection.mount.roll_rad, 3.0 * kDegree);
  EXPECT_DOUBLE_EQ(projection.mount.pitch_rad, -6.0 * kDegree);
  EXPECT_DOUBLE_EQ(projection.mount.yaw_rad, 90.0 * kDegree);
  EXPECT_EQ(projection.mount.lever_body_m, Eigen::Vector3d(0.1, -0.05, 0.3));
}

}  // namespace
}  // namespace lifeline
