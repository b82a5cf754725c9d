#pragma once

#include <optional>

#include "agents/sensing/motion_tracker.hpp"
#include "agents/slam/slam_types.hpp"
#include "agents/slam/walk_filter.hpp"

namespace lifeline::slam {

/// What is known of the head's motion since the previous scan, from sensors other than the lidar.
using MotionPrior = sensing::SensedMotion;

/// Scans further apart than this are keyframes, or some were missed: the last velocity says nothing
/// about them.
inline constexpr double kLongestStep_s = 0.5;

/// From a scan's stamp to the middle of its sweep.
[[nodiscard]] double half_sweep_s(const MotionPrior& prior);

/// How far off each kind of prediction may be, one standard deviation. A walking person, whose head
/// turns fast.
struct MotionConfig {
  double acceleration_m_s2 = 3.0;        ///< that the last velocity does not know of
  double walk_acceleration_m_s2 = 1.5;   ///< of a head that walks, along x and along y
  double yaw_acceleration_rad_s2 = 8.0;  ///< the same of the head's turning
  double walk_floor_xy_m = 0.015;        ///< however sure the filter is
  double walk_max_sigmas = 5.0;  ///< further off it is no walking: its velocity is not known then
  double floor_xy_m = 0.01;      ///< however short the step
  double floor_yaw_rad = 0.01;
  double attitude_yaw_rad = 0.015;  ///< of a yaw step of the attitude sensor
  double odometry_share = 0.15;     ///< of the odometry's step, and of its turn
  double odometry_xy_m = 0.03;
  double odometry_yaw_rad = 0.02;
  double max_xy_m = 0.4;  ///< of one step; between keyframes nothing is known
  double max_yaw_rad = 0.3;
  double lost_max_xy_m = 1.0;  ///< while nothing matches, step adds to step up to here
  double lost_max_yaw_rad = 0.5;
};

/// Predicts the pose from the last one: by odometry where there is any, else by the last
/// translation and the yaw step of the attitude sensor (Eq. 5), else by the last step as a whole.
class MotionModel {
 public:
  explicit MotionModel(MotionConfig config) : config_(config) {}

  [[nodiscard]] Prediction predict(const MotionPrior& prior) const;
  /// The step that predict() adds to the last pose.
  [[nodiscard]] Pose2 predicted_step(const MotionPrior& prior) const;

  /// Starts anew at a pose, standing still.
  void reset(const Pose2& T_map_head);
  /// The map was corrected: what was T in it is now T_new_old * T.
  void move(const Pose2& T_new_old);
  /// The scan was matched here.
  void matched(const Pose2& T_map_head, const MotionPrior& prior) {
    matched(T_map_head, prior, certain_fix());
  }
  /// The same where the scan tells its place by itself as `fix` says.
  void matched(const Pose2& T_map_head, const MotionPrior& prior, const PositionFix& fix);
  /// The scan was matched here, after others were not: the way from the guess before to this place
  /// is no motion, and the one known last is kept. `covariance_xy` of the place, m^2.
  void found(const Pose2& T_map_head, const Eigen::Matrix2d& covariance_xy);
  /// The last match left the place open by this much.
  void doubt(double sigma_xy_m) { doubt(sigma_xy_m, 0.0); }
  void doubt(double sigma_xy_m, double sigma_yaw_rad);
  /// The scan was not matched: the prediction stands, and its uncertainty stays.
  void lost(const Prediction& prediction, const MotionPrior& prior);

  [[nodiscard]] const Pose2& pose() const { return T_map_head_; }
  /// Scans usually come several a second, not as keyframes.
  [[nodiscard]] bool is_lidar_at_work() const;
  /// Scans that come several a second stopped for so long that the wearer may be anywhere near.
  /// Keyframes, which come seldom, have no gaps.
  [[nodiscard]] bool is_gap(Duration elapsed) const;

 private:
  void note_interval(Duration elapsed);
  void set_place_doubt(const Eigen::Matrix2d& covariance_xy);
  /// The wearer walks, and nothing but the scans tells how: the filter says where to.
  [[nodiscard]] bool is_walk(const MotionPrior& prior) const;
  [[nodiscard]] WalkState ahead(const MotionPrior& prior) const;

  MotionConfig config_;
  Pose2 T_map_head_;
  Pose2 last_step_;          ///< between the last two scans that matched, in the former's frame
  Duration last_elapsed_{};  ///< of last_step_
  double interval_s_ = 0.0;  ///< usual time between scans
  double sigma_xy_m_ = 0.0;  ///< of T_map_head_, grown while lost
  double sigma_yaw_rad_ = 0.0;
  std::optional<WalkState> walk_;  ///< in map; while scans come several a second
};

}  // namespace lifeline::slam
