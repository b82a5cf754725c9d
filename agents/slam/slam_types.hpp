#pragma once

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::slam {

/// Where the head is expected to be, and how far off that may be (one standard deviation).
struct Prediction {
  Pose2 T_map_head;
  double sigma_xy_m = 0.0;
  double sigma_yaw_rad = 0.0;
  /// Beside that, of x and y, in m^2: larger along a direction in which the scans before saw
  /// nothing.
  Eigen::Matrix2d left_open = Eigen::Matrix2d::Zero();

  /// Of x and y, in m^2.
  [[nodiscard]] Eigen::Matrix2d covariance_xy() const {
    return left_open + sigma_xy_m * sigma_xy_m * Eigen::Matrix2d::Identity();
  }
  /// Along the direction in which it is largest.
  [[nodiscard]] double largest_sigma_m() const;
};

/// Minus the log-likelihood of a pose by the prediction alone, 0 at its middle.
[[nodiscard]] double deviation(const Pose2& T_map_head, const Prediction& prediction);

/// What speaks for a match.
struct MatchEvidence {
  int points = 0;             ///< pieces of surface in the scan
  int known = 0;              ///< of these, how many fall where the model knows anything
  int inliers = 0;            ///< of these, how many agree with it
  int conflicts = 0;          ///< of the known, how many stand in space the model knows as free
  double mean_error_m = 0.0;  ///< E_TF of Algorithm 1, as the mean over the matched pairs
  int model_points = 0;       ///< n_m of Algorithm 1
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y (m), yaw (rad), in map
  double weakest_sigma_m = 0.0;  ///< along the direction in which the scan fixes the place least

  [[nodiscard]] double inlier_share() const {
    return known > 0 ? static_cast<double>(inliers) / known : 0.0;
  }
};

enum class Verdict {
  accepted,  ///< the evidence is good: the scan enters the map
  weak,      ///< the pose is used, but the scan stays out of the map
  rejected,  ///< no match: dead reckoning
};

/// Where a pose came from.
enum class PoseSource {
  start,           ///< the first scan: the origin of the map
  map,             ///< matched against the working map from the prediction
  search,          ///< matched against the working map after a search around the prediction
  scan_to_scan,    ///< GICP against the previous scan (Eq. 4, 5)
  dead_reckoning,  ///< nothing matched
  relocalised,     ///< found again in the working map after having been lost
};

[[nodiscard]] constexpr const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
      return "accepted";
    case Verdict::weak:
      return "weak";
    case Verdict::rejected:
      return "rejected";
  }
  return "?";
}

[[nodiscard]] constexpr const char* name_of(PoseSource source) {
  switch (source) {
    case PoseSource::start:
      return "start";
    case PoseSource::map:
      return "map";
    case PoseSource::search:
      return "search";
    case PoseSource::scan_to_scan:
      return "scan_to_scan";
    case PoseSource::dead_reckoning:
      return "dead_reckoning";
    case PoseSource::relocalised:
      return "relocalised";
  }
  return "?";
}

/// A pose and what speaks for it.
struct MatchResult {
  Pose2 T_map_head;
  MatchEvidence evidence;
  Verdict verdict = Verdict::rejected;
  PoseSource source = PoseSource::dead_reckoning;
};

}  // namespace lifeline::slam
