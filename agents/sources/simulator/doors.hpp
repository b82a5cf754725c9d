#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/plan.hpp"

namespace lifeline::sources {

/// The narrow passages between rooms: where the floor is 0.6 to 1.3 m wide from wall to wall and
/// much wider a step further on both sides. Each from jamb to jamb, at least 1 m apart from each
/// other. Works on any plan; `space` is the same plan's.
[[nodiscard]] std::vector<Doorway> find_doorways(const FloorPlan& plan, const FreeSpace& space);

/// Doors that open and close while somebody walks about. A closed door is a wall from jamb to jamb
/// in the middle of its doorway, an open one is not there. A door never closes on the walker and
/// never stops him: within kClearM it stands open.
class Doors {
 public:
  static constexpr double kClearM = 0.5;
  static constexpr double kBesideM = 4.0;  ///< a door this close is one that the walker passes

  enum class When {
    never,      ///< no doors: every doorway stands open
    timetable,  ///< each opens and closes by a clock of its own, 8 to 25 s each
    beside,     ///< those near the walker change every 2 to 5 s, the others stay as they are
  };

  Doors(std::vector<Doorway> doorways, When when, std::uint64_t seed);

  /// Moves time on; the walker is at p_world. Times in seconds, never backwards.
  void advance(double t_s, const Eigen::Vector2d& p_world);

  /// Those that are closed now, but for doors of glass.
  [[nodiscard]] std::span<const WallSegment> closed() const { return closed_; }
  /// The doors of glass that are closed now.
  [[nodiscard]] std::span<const WallSegment> closed_glass() const { return closed_glass_; }
  [[nodiscard]] std::size_t count() const { return doors_.size(); }

 private:
  struct Door {
    WallSegment leaf;
    bool glass;
    bool wants_closed;   // by its clock; stands open as long as the walker is in its way
    double next_change;  // seconds
  };
  [[nodiscard]] double next_time(double t_s);

  When when_;
  Draw draw_;
  std::vector<Door> doors_;
  std::vector<WallSegment> closed_, closed_glass_;
};

}  // namespace lifeline::sources
