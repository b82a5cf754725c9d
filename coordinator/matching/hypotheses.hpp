#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::matching {

/// A way to lay b on a, between the local frames, and what speaks for it.
struct Hypothesis {
  Pose2 T_a_b;
  double score = 0.0;
};

/// Best first, at most `count`.
void keep_best(std::vector<Hypothesis>& hypotheses, std::size_t count);

/// Drops what lies within 0.5 m and 3 degrees of something better; the distance is taken at `p_b`.
/// Expects best first.
void keep_distinct(std::vector<Hypothesis>& hypotheses, const Eigen::Vector2d& p_b);

}  // namespace lifeline::matching
