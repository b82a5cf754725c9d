#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::demo {

struct MergeError {
  double at_centre_m = 0.0;  ///< how far the centre of the overlap is put from where it belongs
  double at_origin_m = 0.0;  ///< the same for the origin of map b
  double angle_deg = 0.0;    ///< >= 0
};

/// How far the T_G of a merge is from the truth, as evaluate_merging.py of the merging data judges:
/// at a point of map b's frame (metres), the centre of the overlap.
[[nodiscard]] MergeError merge_error(const Pose2& T_a_b, const Pose2& T_a_b_true,
                                     const Eigen::Vector2d& centre_b);

/// True where the accepted merges (pairs of names) tie all of `helmets` together.
[[nodiscard]] bool all_in_one_map(const std::vector<std::string>& helmets,
                                  const std::vector<std::pair<std::string, std::string>>& merges);

}  // namespace lifeline::demo
