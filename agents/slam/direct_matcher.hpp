#pragma once

#include <span>
#include <vector>

#include "agents/slam/slam_types.hpp"
#include "common/grid/cell_lanes.hpp"
#include "common/grid/scan_surface.hpp"
#include "common/grid/tsd_view.hpp"

namespace lifeline::slam {

struct DirectConfig {
  int max_points = 400;  ///< pieces of surface that take part; more are thinned evenly
  int max_iterations = 15;
  double first_kernel_m = 0.12;    ///< scale of the robust weight at the start ...
  double last_kernel_m = 0.04;     ///< ... and in the end
  double inlier_m = 0.10;          ///< residuals up to this agree with the map
  double sigma_m = 0.03;           ///< of one residual
  double independent_points = 60;  ///< how many independent residuals a scan is worth at most
};

/// Aligns a scan to the map directly: Gauss-Newton on the interpolated signed distance at the
/// scan's points, robust weights that tighten from step to step, and the prediction as one more
/// observation - in a corridor it decides what the walls leave open. Slope and residual are in
/// metres, so the result has a covariance. Keeps scratch memory; one owner.
class DirectMatcher {
 public:
  explicit DirectMatcher(DirectConfig config) : config_(config) {}

  /// Takes the scan's surfaces (head frame) for the alignments that follow.
  void set_scan(std::span<const SurfacePiece> pieces);

  /// Aligns, starting at `start`, held to `prior`. `max_iterations` cuts the work of trials.
  [[nodiscard]] Pose2 align(const TsdView& view, const Pose2& start, const Prediction& prior,
                            int max_iterations);
  [[nodiscard]] Pose2 align(const TsdView& view, const Prediction& prior) {
    return align(view, prior.T_map_head, prior, config_.max_iterations);
  }

  /// What speaks for `T_map_head`.
  [[nodiscard]] MatchEvidence judge(const TsdView& view, const Pose2& T_map_head,
                                    const Prediction& prior) const;

  /// Mean agreement of the scan with the map, in [-1, 1]: 1 where every point lies on a surface, 0
  /// where all is unknown, below 0 where points stand in free space.
  [[nodiscard]] double agreement(const TsdView& view, const Pose2& T_map_head) const;

  /// Share of the points, in [0, 1], whose beam would have had to pass through a known surface.
  /// Where it is more than `enough`, something between that and the share.
  [[nodiscard]] double seen_through_walls(const TsdView& view, const Pose2& T_map_head,
                                          double enough = 1.0) const;

 private:
  struct Point {
    float x, y;  ///< head frame, metres
    float weight;
  };
  /// Four of them side by side; the last ones have weight 0 where there are no more.
  struct FourPoints {
    FloatLanes x, y, weight;
  };
  /// Normal equations of one iteration, in metres and radians, about the head.
  struct Normal {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    double weight = 0.0;
  };

  [[nodiscard]] Normal linearise(const TsdView& view, const Pose2& T_map_head,
                                 double kernel_m) const;
  /// Scales the sums of residuals to the information of independent ones.
  [[nodiscard]] double information_scale(const Normal& normal) const;

  DirectConfig config_;
  std::vector<Point> points_;
  std::vector<FourPoints> fours_;  ///< the same
  float weight_sum_ = 0.0F;
};

}  // namespace lifeline::slam
