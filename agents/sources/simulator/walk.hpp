#pragma once

#include <cstdint>
#include <optional>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/head_motion.hpp"
#include "agents/sources/simulator/smooth_path.hpp"
#include "agents/sources/simulator/tour.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::sources {

/// What a walker never exceeds.
struct WalkLimits {
  static constexpr double kSpeedMs = 1.2;
  static constexpr double kAccelerationMs2 = 1.2;
  static constexpr double kTurnRadS = 1.6;  ///< of the head: body and looking about, 92 deg/s
  static constexpr double kNaturalTurnRadS = 2.05;  ///< the same with glances, 117 deg/s
};

/// A person who walks about a floor for as long as asked, looking about a little. The pose is that
/// of the head. The same numbers give the same walk.
class Walk {
 public:
  /// How the head is held: level and with the body's slow sways alone, or as people do, or nodding
  /// and rolling hard, or as people do who crawl, and as slowly.
  enum class Head { still, natural, nodding, crawling };
  /// Of the speed of someone who walks upright.
  static constexpr double kCrawlingPace = 0.4;

  /// `space` has to outlive the walk. The way is the same however the head is held.
  Walk(const FreeSpace& space, const WalkerNumber& number, Head head = Head::still);

  /// T_world_head at `t_s` seconds after the start. Times must not decrease by more than 10 ms from
  /// call to call.
  [[nodiscard]] Pose2 pose_at(double t_s) { return head_at(t_s).T_world_head; }
  /// The same with roll and pitch.
  [[nodiscard]] HeadPose head_at(double t_s);

  /// Whether, at the latest time asked for, all places of the first round had been seen.
  [[nodiscard]] bool first_round_done() const { return rounds_ > 1; }

 private:
  /// What swings the head: two slow sines that do not fit into each other.
  struct Sway {
    double amplitude_rad, period_s, phase_rad;
  };

  void step();
  void begin_round();
  [[nodiscard]] double wanted_heading() const;
  [[nodiscard]] HeadPose head() const;

  const FreeSpace& space_;
  Tour tour_;
  Draw draw_;
  Sway sways_[2];
  double cruise_m_s_;
  std::optional<SmoothPath> path_;
  int rounds_ = 0;
  double standing_s_ = 0.0;  // still to wait before walking on
  double along_m_ = 0.0;
  double speed_m_s_ = 0.0;
  double heading_rad_;  // of the body
  double turn_rad_s_ = 0.0;
  std::int64_t steps_ = 0;
  std::optional<HeadMotion> motion_;
  HeadPose before_, now_;  // heads at the last two steps
};

}  // namespace lifeline::sources
