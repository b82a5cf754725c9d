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
};

/// The lidar on a walker's head, beams counter-clockwise from -180 deg.
class SimulatedLidar {
 public:
  /// The head at a time in seconds; is asked in order of time.
  using Motion = std::function<HeadPose(double)>;

  SimulatedLidar(const LidarOptions& options, std::uint64_t seed)
      : options_(options), noise_(stir(seed, 0)), luck_(stir(seed, 1)) {}

  /// A sweep that begins `t_s` after the start. No wall within range is +infinity; a wall closer
  /// than range_min_m, and a drop-out, is 0. `more_walls` stand there beside the scene's. The lidar
  /// leans with the head: a tilted beam ends at floor or ceiling where it meets them before a wall.
  /// Stamp and attitude are not set; the truth is, at the stamp.
  [[nodiscard]] sensing::RawScan sweep(const RayScene& scene, const Motion& head, double t_s,
                                       std::span<const WallSegment> more_walls = {});

 private:
  [[nodiscard]] double cast(const RayScene& scene, std::span<const WallSegment> more_walls,
                            const HeadPose& head, double turned_rad) const;
  [[nodiscard]] float read(double true_range_m);

  LidarOptions options_;
  PortableNoise noise_;
  Draw luck_;  // decides on drop-outs
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
