#pragma once

#include <span>

#include "agents/slam/failure_detector.hpp"
#include "agents/slam/icp_matcher.hpp"
#include "agents/slam/point_set.hpp"
#include "agents/slam/ransac_matcher.hpp"
#include "agents/slam/slam_types.hpp"
#include "common/grid/scan2.hpp"
#include "common/grid/tsd_view.hpp"

namespace lifeline::slam {

/// The paper's conventional path: the model M_k is ray-cast from the map at the last known
/// position, RANSAC aligns the scan to it roughly, ICP finely (Eq. 1), and Algorithm 1 says whether
/// the match holds.
class ModelMatcher {
 public:
  ModelMatcher(RansacConfig ransac, IcpConfig icp, FailureDetector::Config detector,
               double max_range_m)
      : ransac_(ransac), icp_(icp), detector_(detector), max_range_m_(max_range_m) {}

  /// `T_map_last` is where the model is taken from. Accepted or rejected, never weak.
  [[nodiscard]] MatchResult match(const TsdView& view, const Pose2& T_map_last, const Scan2& scan,
                                  std::span<const SurfacePiece> pieces,
                                  const Prediction& prediction) const;

  [[nodiscard]] const FailureDetector& detector() const { return detector_; }

 private:
  RansacMatcher ransac_;
  IcpMatcher icp_;
  FailureDetector detector_;
  double max_range_m_;
};

}  // namespace lifeline::slam
