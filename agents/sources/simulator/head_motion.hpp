#pragma once

#include <array>
#include <cstdint>

#include "agents/sources/simulator/draw.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::sources {

/// How a head is held in space: where it is and looks in the plane, and how it leans. Axes and
/// signs as in sensing::Attitude: R_world_head = Rz(yaw) Ry(pitch) Rx(roll).
struct HeadPose {
  HeadPose() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a level head is just its pose in the plane
  HeadPose(const Pose2& level) : T_world_head(level) {}
  HeadPose(const Pose2& pose, double roll, double pitch, double raised = 0.0)
      : T_world_head(pose), roll_rad(roll), pitch_rad(pitch), raised_m(raised) {}

  Pose2 T_world_head;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double raised_m = 0.0;  ///< against the lidar's usual height
};

/// How a walker's head moves on the body: it nods with every step (2 a second), rolls with every
/// stride of two, looks up and down and leans slowly, and glances aside. Sums of sines that do not
/// fit into each other: the same seed gives the same motion.
class HeadMotion {
 public:
  /// As people move it; or nodding and rolling hard all the time, to the limits, and looking
  /// straight ahead; or as people on hands and knees move it, who also bob up and down.
  enum class Style { natural, nodding, crawling };

  /// Nothing is exceeded; natural.
  static constexpr double kMostPitchDeg = 12.0;
  static constexpr double kMostRollDeg = 5.0;
  static constexpr double kMostYawDeg = 16.0;
  static constexpr double kMostYawRateDegS = 25.0;
  /// The same of a nodding head: reached, never exceeded. It does not yaw.
  static constexpr double kNoddingPitchDeg = 25.0;
  static constexpr double kNoddingRollDeg = 10.0;
  /// The same of someone who crawls; never exceeded.
  static constexpr double kCrawlingPitchDeg = 20.0;
  static constexpr double kCrawlingRollDeg = 9.0;
  static constexpr double kCrawlingRaisedM = 0.04;

  /// Against the body.
  struct Lean {
    double roll_rad = 0.0;
    double pitch_rad = 0.0;
    double yaw_rad = 0.0;
    double raised_m = 0.0;
  };

  explicit HeadMotion(std::uint64_t seed, Style style = Style::natural);

  /// At `t_s` seconds; `pace` in [0, 1] is the share of full walking speed: steps shake the head
  /// only of someone who walks.
  [[nodiscard]] Lean at(double t_s, double pace) const;

 private:
  struct Swing {
    double amplitude_rad, period_s, phase_rad;
    [[nodiscard]] double at(double t_s) const;
  };
  [[nodiscard]] static Swing swing(Draw& draw, double amplitude_deg, double shortest_s,
                                   double longest_s);

  void move_nodding(Draw& draw);
  void move_crawling(Draw& draw);

  Swing nod_, stride_;  // with the steps
  std::array<Swing, 2> look_, glance_;
  Swing lean_;
  double nose_down_rad_;  ///< on average
  double bob_m_ = 0.0;    ///< with every nod
};

}  // namespace lifeline::sources
