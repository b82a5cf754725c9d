#include "common/ros2/messages.hpp"

#include <cmath>
#include <utility>

#include "common/ros2/cdr_writer.hpp"

namespace lifeline::ros2 {
namespace {

void write_time(CdrWriter& out, Timestamp stamp) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(stamp);
  out.write(static_cast<std::int32_t>(seconds.time_since_epoch().count()));
  out.write(static_cast<std::uint32_t>((stamp - seconds).count()));
}

void write_header(CdrWriter& out, Timestamp stamp, std::string_view frame) {
  write_time(out, stamp);
  out.write_text(frame);
}

/// Position, then orientation: as Pose and Transform both have them.
void write_pose(CdrWriter& out, const Pose2& pose) {
  for (const double value : {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(pose.yaw_rad / 2.0),
                             std::cos(pose.yaw_rad / 2.0)}) {
    out.write(value);
  }
}

std::uint8_t cost_of(Occupancy cell) {
  if (cell == Occupancy::occupied) return 100;
  return cell == Occupancy::free ? 0 : 0xff;  // -1 in two's complement
}

}  // namespace

std::vector<std::uint8_t> occupancy_grid(Timestamp stamp, std::string_view frame,
                                         const OccupancyGrid& grid) {
  CdrWriter out;
  write_header(out, stamp, frame);
  write_time(out, stamp);  // map_load_time
  out.write(static_cast<float>(grid.cell_size_m));
  out.write(static_cast<std::uint32_t>(grid.columns));
  out.write(static_cast<std::uint32_t>(grid.rows));
  write_pose(out, {grid.origin_m.x(), grid.origin_m.y(), 0.0});
  std::vector<std::uint8_t> costs;
  costs.reserve(grid.cells.size());
  for (const Occupancy cell : grid.cells) costs.push_back(cost_of(cell));
  out.write_octets(costs);
  return std::move(out).take();
}

std::vector<std::uint8_t> pose_stamped(Timestamp stamp, std::string_view frame,
                                       const Pose2& T_frame_body) {
  CdrWriter out;
  write_header(out, stamp, frame);
  write_pose(out, T_frame_body);
  return std::move(out).take();
}

std::vector<std::uint8_t> path(Timestamp stamp, std::string_view frame,
                               std::span<const StampedPose> poses) {
  CdrWriter out;
  write_header(out, stamp, frame);
  out.write_count(poses.size());
  for (const StampedPose& at : poses) {
    write_header(out, at.stamp, frame);
    write_pose(out, at.pose);
  }
  return std::move(out).take();
}

std::vector<std::uint8_t> tf_message(Timestamp stamp, std::span<const Transform> transforms) {
  CdrWriter out;
  out.write_count(transforms.size());
  for (const Transform& transform : transforms) {
    write_header(out, stamp, transform.parent);
    out.write_text(transform.child);
    write_pose(out, transform.T_parent_child);
  }
  return std::move(out).take();
}

std::vector<std::uint8_t> laser_scan(Timestamp stamp, std::string_view frame,
                                     const LaserScan& scan) {
  CdrWriter out;
  write_header(out, stamp, frame);
  const std::size_t steps = scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1;
  out.write(scan.first_angle_rad);
  out.write(scan.first_angle_rad + static_cast<float>(steps) * scan.angle_step_rad);
  out.write(scan.angle_step_rad);
  out.write(0.0F);  // time_increment: the sweep is of one moment
  out.write(0.0F);  // scan_time: not known
  out.write(scan.range_min_m);
  out.write(scan.range_max_m);
  out.write_count(scan.ranges_m.size());
  for (const float range_m : scan.ranges_m) out.write(range_m);
  out.write_count(0);  // intensities
  return std::move(out).take();
}

std::vector<std::uint8_t> text(std::string_view text) {
  CdrWriter out;
  out.write_text(text);
  return std::move(out).take();
}

}  // namespace lifeline::ros2
