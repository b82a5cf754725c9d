#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::sources {

/// A FLASER line of a CARMEN log:
/// `FLASER n r_0 ... r_(n-1) x y theta odom_x odom_y odom_theta time host logger_time`.
struct FlaserLine {
  std::vector<float> ranges_m;
  Pose2 T_world_laser;  ///< `x y theta`: the corrected pose, where somebody corrected the log
  Pose2 T_odom_laser;   ///< `odom_*`
  Duration time{};      ///< on the log's own clock
};

/// Where the beams of a SICK-like laser point; the field of view is 180 deg for every count.
struct BeamFan {
  double first_angle_rad = 0.0;
  double angle_step_rad = 0.0;
};

/// The fan of `beams` beams: from -90 deg in steps of 1 deg for 180 and 181 beams, of 0.5 deg for
/// 360 and 361. bad_data for any other count: nothing in the log says how those would lie.
[[nodiscard]] Result<BeamFan> beam_fan(std::size_t beams);

/// True for a FLASER line, whole or not.
[[nodiscard]] bool is_flaser(std::string_view line);

/// True where a line of the kinds that the logs hold besides FLASER has all of its fields.
[[nodiscard]] bool is_whole_other_line(std::string_view line);

/// Reads a FLASER line. bad_data, without file and line, for a beam count that beam_fan() does not
/// know, for too few or too many fields, and for a number that is none, not finite, or (a range)
/// negative.
[[nodiscard]] Result<FlaserLine> parse_flaser(std::string_view line);

}  // namespace lifeline::sources
