#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agents/slam/keyframe.hpp"
#include "agents/slam/slam_types.hpp"

namespace lifeline::slam {

struct KeyframeConfig {
  bool hand_over = true;      ///< false: nobody takes them; only the poses are kept
  double distance_m = 0.25;   ///< a pushed scan is kept when the head moved this far ...
  double turn_rad = 0.3;      ///< ... or turned this much since the last one that was
  double noise_xy_m = 0.012;  ///< after one metre of path, beside what the match knows of
  double noise_yaw_rad = 0.0012;
};

/// Decides which scans become keyframes, and hands them over. Keeps the last ones for itself: a
/// correction that was under way does not know them.
class KeyframeLog {
 public:
  /// So many keyframes may come while a correction is worked out.
  static constexpr std::size_t kRecent = 64;

  explicit KeyframeLog(KeyframeConfig config) : config_(config) {}

  /// A scan that was only dead reckoned, or poorly matched: the next step is less certain.
  void note_lost(const Prediction& prediction);
  [[nodiscard]] bool is_due(const Pose2& T_map_head) const;
  /// `covariance` of T_map_head, in map.
  void keep(Timestamp stamp, const Pose2& T_map_head, const Eigen::Matrix3d& covariance,
            std::span<const SurfacePiece> pieces);

  /// The keyframes since the last call.
  [[nodiscard]] std::vector<Keyframe> take();

  /// Whether rebase() could take a correction that knows the first `known` keyframes.
  [[nodiscard]] bool can_rebase(std::size_t known) const {
    return !recent_.empty() && known > recent_.front().index && known <= poses_.size();
  }
  /// Moves all poses to the corrected past. How the present moves, T_new_old; empty, and nothing
  /// done, where the correction is too old.
  [[nodiscard]] std::optional<Pose2> rebase(const MapCorrection& correction);
  /// The keyframes that the correction last rebased to did not know, as moved.
  [[nodiscard]] std::span<const Keyframe> unknown_to(const MapCorrection& correction) const;

  [[nodiscard]] std::size_t size() const { return poses_.size(); }
  /// T_map_head of all keyframes, as last corrected.
  [[nodiscard]] const std::vector<Pose2>& poses() const { return poses_; }

 private:
  /// The next keyframe, without its surfaces.
  [[nodiscard]] Keyframe made(Timestamp stamp, const Pose2& T_map_head,
                              const Eigen::Matrix3d& covariance) const;

  KeyframeConfig config_;
  std::vector<Keyframe> waiting_;  ///< not taken yet
  std::vector<Keyframe> recent_;
  std::vector<Pose2> poses_;
  Eigen::Matrix3d lost_covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace lifeline::slam
