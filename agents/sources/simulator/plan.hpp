#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lifeline::sources {

/// A straight piece of wall face, seen from both sides. World frame, metres.
struct WallSegment {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

/// A door's opening: from jamb to jamb along the middle of its wall. World frame, metres.
struct Doorway {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

/// One storey of a building. World frame: x right, y up, metres.
struct FloorPlan {
  std::string name;
  /// Closed loops round the floor: outer walls' inner faces, both faces of inner walls, pillars,
  /// furniture. By the even-odd rule they separate floor from what is solid or outside.
  std::vector<WallSegment> walls;
  /// Closed loops of the faces that only someone outside sees. May be empty.
  std::vector<WallSegment> outline;
  std::vector<Doorway> doorways;  ///< empty where the plan's origin does not tell them

  /// The box round all walls. Empty (isEmpty()) for a plan without walls.
  [[nodiscard]] Eigen::AlignedBox2d bounds() const;
  /// Even-odd rule over `walls`.
  [[nodiscard]] bool is_floor(const Eigen::Vector2d& p_world) const;
  /// Square metres enclosed by `walls` under the even-odd rule; holes have to run the other way
  /// round, as both the generator and the loader make them.
  [[nodiscard]] double floor_area_m2() const;
};

/// Distance from p to the nearest point of the segment, metres.
[[nodiscard]] double distance_to(const WallSegment& wall, const Eigen::Vector2d& p);

}  // namespace lifeline::sources
