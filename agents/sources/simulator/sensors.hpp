#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "agents/sensing/raw_scan.hpp"
#include "agents/sources/portable_noise.hpp"
#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/head_motion.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "agents/sources/simulator/surroundings.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::sources {

/// A turning lidar. The defaults are those of a Slamtec RPLIDAR A3.
struct LidarOptions {
  int beams = 1600;  ///< per turn of 360 deg
  double turns_per_s = 10.0;
  double range_min_m = 0.2;
  double range_max_m = 25.0;
  double resolution_m = 0.001;
  double noise_m = 0.01;        ///< standard deviation close by; 10 % of it more per metre
  double dropout_share = 0.01;  ///< of readings that are missing: 0, as the device gives them
  bool takes_time = false;      ///< beams one after the other over a turn, not all at once
  double height_m = 1.7;        ///< above the floor, which a tilted beam meets
  double ceiling_m = 2.7;       ///< above the floor; walls are as high
  double smoke_sight_m = 0.0;   ///< so far one sees in the smoke; 0: there is none
};

/// The lidar on a walker's head, beams counter-clockwise from -180 deg.
class SimulatedLidar {
 public:
  /// The head at a time in seconds; is asked in order of time.
  using Motion = std::function<HeadPose(double)>;

  SimulatedLidar(const LidarOptions& options, std::uint64_t seed)
      : options_(options),
        plain_ceiling_(options.ceiling_m),
        noise_(stir(seed, 0)),
        luck_(stir(seed, 1)),
        glass_(stir(seed, 2)),
        smoke_(stir(seed, 3)) {}

  /// A sweep that begins `t_s` after the start. No wall within range is +infinity; a wall closer
  /// than range_min_m, and a drop-out, is 0. The lidar leans with the head: a tilted beam ends at
  /// floor or ceiling where it meets them before a wall. Stamp and attitude are not set; the truth
  /// is, at the stamp.
  ///
  /// Glass gives a reading of itself where a beam meets it within 8 deg of a right angle; others go
  /// on to what is behind, whose echo one time in seven does not come back through the pane.
  /// Something black gives 0. In smoke an echo comes back over the distance d with the probability
  /// exp(-d / smoke_sight_m); of those that do not, three in ten are the smoke's own, from close
  /// by, the others are 0.
  [[nodiscard]] sensing::RawScan sweep(const Surroundings& around, const Motion& head, double t_s);
  /// Among walls alone; `more_walls` stand there beside the scene's.
  [[nodiscard]] sensing::RawScan sweep(const RayScene& scene, const Motion& head, double t_s,
                                       std::span<const WallSegment> more_walls = {}) {
    return sweep(Surroundings{.walls = scene, .more_walls = more_walls}, head, t_s);
  }

 private:
  [[nodiscard]] double echo_m(const Echoes& echoes);
  [[nodiscard]] double through_smoke_m(double range_m);
  [[nodiscard]] float read(double true_range_m);

  LidarOptions options_;
  Ceilings plain_ceiling_;  // where the surroundings have none of their own
  PortableNoise noise_;
  Draw luck_;  // decides on drop-outs
  Draw glass_, smoke_;
};

/// An attitude sensor. Yaw: white noise, a drift that wanders off, and a zero of its own. Roll and
/// pitch, which gravity tells: white noise.
class SimulatedAhrs {
 public:
  static constexpr double kWhiteSigmaDeg = 0.5;
  static constexpr double kDriftSigmaDegPerRootS = 0.05;
  static constexpr double kTiltSigmaDeg = 0.2;

  explicit SimulatedAhrs(std::uint64_t seed);

  /// What it says `dt_s` after the last time; roll and pitch are 0.
  [[nodiscard]] sensing::Attitude measure(double true_yaw_rad, double dt_s);
  /// The same with roll and pitch; the yaw's noise is the same.
  [[nodiscard]] sensing::Attitude measure_leaning(const HeadPose& head, double dt_s);

 private:
  PortableNoise noise_, tilt_noise_;
  double zero_rad_;  // the drift moves it
};

}  // namespace lifeline::sources
