#include "agents/slam/model_matcher.hpp"

namespace lifeline::slam {

MatchResult ModelMatcher::match(const TsdView& view, const Pose2& T_map_last, const Scan2& scan,
                                std::span<const SurfacePiece> pieces,
                                const Prediction& prediction) const {
  const PointSet model = to_points(ray_cast(view, T_map_last, scan, max_range_m_));
  const PointSet seen = to_points(pieces);
  const PointGrid index(model.points, icp_.config().first_gate_m);
  MatchResult result;
  result.source = PoseSource::map;
  result.T_map_head = ransac_.match(index, model, seen, prediction);
  result.T_map_head = icp_.match(index, model, seen, result.T_map_head);
  const MatchError error = detector_.measure(model, seen, result.T_map_head);
  result.evidence.points = static_cast<int>(seen.size());
  result.evidence.known = static_cast<int>(model.size());
  result.evidence.inliers = result.evidence.model_points = error.model_points;
  result.evidence.mean_error_m = error.mean_error_m;
  result.verdict = detector_.detect(error) ? Verdict::rejected : Verdict::accepted;
  return result;
}

}  // namespace lifeline::slam
