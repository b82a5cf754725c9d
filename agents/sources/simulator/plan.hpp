#pragma once

#include <cstdint>
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
  bool glass = false;  ///< what its door is made of
};

/// What a wall is made of, as a lidar sees it.
enum class Material : std::uint8_t {
  plain,
  glass,  ///< lets beams through, but for those that meet it about at right angles
  black,  ///< swallows them
};

/// A part of the floor whose ceiling is not as high as elsewhere.
struct CeilingArea {
  Eigen::AlignedBox2d area;
  double height_m = 0.0;  ///< above the floor
};

/// One storey of a building. World frame: x right, y up, metres.
struct FloorPlan {
  std::string name;
  /// Closed loops round the floor: outer walls' inner faces, both faces of inner walls, pillars,
  /// furniture. By the even-odd rule they separate floor from what is solid or outside.
  std::vector<WallSegment> walls;
  /// Closed loops of the faces that only someone outside sees. May be empty.
  std::vector<WallSegment> outline;
  std::vector<Doorway> doorways;         ///< empty where the plan's origin does not tell them
  std::vector<Material> materials = {};  ///< of each of `walls`; empty: all are plain
  std::vector<WallSegment> panes = {};   ///< of glass, standing on the floor: no part of a loop
  std::vector<Eigen::AlignedBox2d> rooms =
      {};                                  ///< empty where the plan's origin does not tell them
  std::vector<CeilingArea> ceilings = {};  ///< they do not overlap

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
