#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "common/grid/scan2.hpp"
#include "common/grid/tsd_view.hpp"

namespace lifeline {

/// Where a ray meets a surface of the map.
struct RayHit {
  Eigen::Vector2d p_map;
  Eigen::Vector2d normal;  ///< unit, towards the free side
  double range_m = 0.0;
};

/// The first place along the ray where the signed distance falls through zero, to a fraction of a
/// cell. Unknown space stops nothing, but a surface is met from known free space only: never coming
/// out of the unknown, and never from behind. Nothing within `max_range_m`: empty.
[[nodiscard]] std::optional<RayHit> cast_ray(const TsdView& view, const Eigen::Vector2d& from_map,
                                             double angle_rad, double max_range_m);

/// M_k of the paper: what a lidar at `T_map_head` would see of the map. Beams of `scan` without a
/// hit take part too: they may look at something the map knows. In the order of the beams; beams
/// that meet nothing are left out.
[[nodiscard]] std::vector<RayHit> ray_cast(const TsdView& view, const Pose2& T_map_head,
                                           const Scan2& scan, double max_range_m);

}  // namespace lifeline
