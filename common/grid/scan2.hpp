#pragma once

#include <cstdint>
#include <vector>

#include "common/base/time.hpp"

namespace lifeline {

/// What a beam tells.
enum class BeamKind : std::uint8_t {
  hit,        ///< a surface stands at its end
  no_return,  ///< nothing was hit within the lidar's range; glass does that too
  invalid,    ///< no reading, or one that floor or ceiling cut short
};

/// One beam in the gravity-aligned head frame (x forward, y left), seen from the head's origin.
struct Beam2 {
  float angle_rad = 0.0F;  ///< counter-clockwise from x; grows or falls along the scan
  float range_m = 0.0F;    ///< horizontal; only of a hit
  float x_m = 0.0F;        ///< where the surface stands; only of a hit
  float y_m = 0.0F;
  BeamKind kind = BeamKind::invalid;
};

/// A sweep of the lidar in the plane: what is matched and pushed.
struct Scan2 {
  Timestamp stamp{};         ///< of the first beam
  Duration sweep_time{};     ///< from first to last beam, 0 = all at once
  std::vector<Beam2> beams;  ///< in the order of the sweep
  bool full_circle = false;  ///< the last beam is a neighbour of the first
  bool turn_undone = false;  ///< beams already stand in the heading of the stamp, all of them

  [[nodiscard]] std::size_t hits() const {
    std::size_t count = 0;
    for (const Beam2& beam : beams) count += beam.kind == BeamKind::hit ? 1U : 0U;
    return count;
  }
};

}  // namespace lifeline
