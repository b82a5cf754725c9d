#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/grid/pose2.hpp"
#include "common/grid/stamped_pose.hpp"

namespace lifeline::ros2 {

// The standard messages that we speak, in CDR. The plane lies at z = 0; angles turn
// counter-clockwise about z (REP 103). Stamps before 1970 or after 2038 do not exist in ROS 2.

/// A message of a topic, ready to be recorded or sent.
struct Message {
  std::string topic;  ///< as ROS 2 has it, e.g. `/tf`
  std::string type;   ///< as ROS 2 has it, e.g. `tf2_msgs/msg/TFMessage`
  std::vector<std::uint8_t> cdr;
};

inline constexpr std::string_view kOccupancyGrid = "nav_msgs/msg/OccupancyGrid";
inline constexpr std::string_view kPath = "nav_msgs/msg/Path";
inline constexpr std::string_view kTfMessage = "tf2_msgs/msg/TFMessage";
inline constexpr std::string_view kPoseStamped = "geometry_msgs/msg/PoseStamped";
inline constexpr std::string_view kLaserScan = "sensor_msgs/msg/LaserScan";
inline constexpr std::string_view kString = "std_msgs/msg/String";

/// -1 unknown, 0 free, 100 occupied; rows from below, as in OccupancyGrid.
[[nodiscard]] std::vector<std::uint8_t> occupancy_grid(Timestamp stamp, std::string_view frame,
                                                       const OccupancyGrid& grid);

[[nodiscard]] std::vector<std::uint8_t> pose_stamped(Timestamp stamp, std::string_view frame,
                                                     const Pose2& T_frame_body);

/// Where a body was, each position with its own stamp; the path's is `stamp`.
[[nodiscard]] std::vector<std::uint8_t> path(Timestamp stamp, std::string_view frame,
                                             std::span<const StampedPose> poses);

/// Where frame `child` lies in `parent`.
struct Transform {
  std::string parent;
  std::string child;
  Pose2 T_parent_child;
};
[[nodiscard]] std::vector<std::uint8_t> tf_message(Timestamp stamp,
                                                   std::span<const Transform> transforms);

/// A sweep that is as old as its stamp as a whole. A range that is not known is NaN (REP 117).
struct LaserScan {
  float first_angle_rad = 0.0F;
  float angle_step_rad = 0.0F;
  float range_min_m = 0.0F;
  float range_max_m = 0.0F;
  std::vector<float> ranges_m;
};
[[nodiscard]] std::vector<std::uint8_t> laser_scan(Timestamp stamp, std::string_view frame,
                                                   const LaserScan& scan);

[[nodiscard]] std::vector<std::uint8_t> text(std::string_view text);

}  // namespace lifeline::ros2
