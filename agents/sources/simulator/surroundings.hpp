#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/ceilings.hpp"
#include "agents/sources/simulator/head_motion.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "agents/sources/simulator/ray_scene.hpp"

namespace lifeline::sources {

/// How wide a person is to a lidar.
inline constexpr double kPersonRadiusM = 0.22;

/// All that a lidar's beams may meet at one time. What is referred to has to outlive it.
struct Surroundings {
  const RayScene& walls;                           ///< black ones too; not those of glass
  std::span<const WallSegment> more_walls = {};    ///< closed doors
  std::span<const WallSegment> panes = {};         ///< of glass
  std::span<const WallSegment> closed_glass = {};  ///< doors
  const RayScene* black = nullptr;                 ///< the black ones among `walls`
  std::span<const Eigen::Vector2d> people = {};
  const Ceilings* ceilings = nullptr;
};

/// A beam in space: where it runs in the plane, and how it rises.
struct LidarBeam {
  Eigen::Vector2d origin{0.0, 0.0};
  double height_m = 0.0;  ///< of its origin above the floor
  Eigen::Vector2d direction{1.0, 0.0};
  double flat = 1.0;  ///< the share of its length that lies in the plane
  double rise = 0.0;  ///< per metre of its length
};

/// The beam that is turned by `turned_rad` against straight behind, of a lidar that is usually
/// `height_m` above the floor.
[[nodiscard]] LidarBeam beam_of(const HeadPose& head, double turned_rad, double height_m);

/// What a beam meets. Metres along the beam.
struct Echoes {
  double end_m = std::numeric_limits<double>::infinity();   ///< of what lets nothing through
  bool swallowed = false;                                   ///< by something black, there
  int panes = 0;                                            ///< of glass that it passes before
  double pane_m = std::numeric_limits<double>::infinity();  ///< to the first of them
  double pane_cosine = 0.0;                                 ///< of the angle to its normal
};

[[nodiscard]] Echoes cast(const Surroundings& around, const LidarBeam& beam, double range_max_m);

/// Distance from `origin` along the unit vector `direction` to the person who stands at `person`;
/// infinity where it misses.
[[nodiscard]] double ray_to_person(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                   const Eigen::Vector2d& person);

}  // namespace lifeline::sources
