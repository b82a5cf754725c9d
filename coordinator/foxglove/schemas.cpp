#include "coordinator/foxglove/schemas.hpp"

#include <array>
#include <initializer_list>

#include "common/ros2/messages.hpp"

namespace lifeline::foxglove {
namespace {

struct Definition {
  std::string_view name;
  std::string_view fields;
};

// Names and order of the fields, which is what the octets hang on.
constexpr Definition kTime{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"};
constexpr Definition kHeader{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"};
constexpr Definition kPoint{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Definition kVector{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Definition kQuaternion{"geometry_msgs/Quaternion",
                                 "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"};
constexpr Definition kPose{"geometry_msgs/Pose",
                           "geometry_msgs/Point position\n"
                           "geometry_msgs/Quaternion orientation\n"};
constexpr Definition kPoseStamped{"geometry_msgs/PoseStamped",
                                  "std_msgs/Header header\ngeometry_msgs/Pose pose\n"};
constexpr Definition kMapMetaData{"nav_msgs/MapMetaData",
                                  "builtin_interfaces/Time map_load_time\nfloat32 resolution\n"
                                  "uint32 width\nuint32 height\ngeometry_msgs/Pose origin\n"};
constexpr Definition kTransform{"geometry_msgs/Transform",
                                "geometry_msgs/Vector3 translation\n"
                                "geometry_msgs/Quaternion rotation\n"};
constexpr Definition kTransformStamped{"geometry_msgs/TransformStamped",
                                       "std_msgs/Header header\nstring child_frame_id\n"
                                       "geometry_msgs/Transform transform\n"};
constexpr std::string_view kOccupancyGrid =
    "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n";
constexpr std::string_view kPath = "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n";
constexpr std::string_view kTfMessage = "geometry_msgs/TransformStamped[] transforms\n";
constexpr std::string_view kLaserScan =
    "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
    "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
    "float32[] ranges\nfloat32[] intensities\n";

std::string with(std::string_view fields, std::initializer_list<Definition> parts) {
  std::string schema(fields);
  for (const Definition& part : parts) {
    schema += std::string(80, '=') + "\nMSG: ";
    schema.append(part.name).append("\n").append(part.fields);
  }
  return schema;
}

}  // namespace

std::string schema_of(std::string_view type) {
  if (type == ros2::kOccupancyGrid)
    return with(kOccupancyGrid, {kHeader, kTime, kMapMetaData, kPose, kPoint, kQuaternion});
  if (type == ros2::kPath)
    return with(kPath, {kHeader, kTime, kPoseStamped, kPose, kPoint, kQuaternion});
  if (type == ros2::kPoseStamped)
    return with(kPoseStamped.fields, {kHeader, kTime, kPose, kPoint, kQuaternion});
  if (type == ros2::kTfMessage)
    return with(kTfMessage, {kTransformStamped, kHeader, kTime, kTransform, kVector, kQuaternion});
  if (type == ros2::kLaserScan) return with(kLaserScan, {kHeader, kTime});
  return {};
}

}  // namespace lifeline::foxglove
