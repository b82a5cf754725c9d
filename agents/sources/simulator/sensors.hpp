#pragma once

#include <cstdint>
#include <functional>

#include "agents/sensing/raw_scan.hpp"
#include "agents/sources/portable_noise.hpp"
#include "agents/sources/simulator/draw.hpp"
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
};

/// The lidar on a walker's head, beams counter-clockwise from -180 deg.
class SimulatedLidar {
 public:
  /// T_world_head at a time in seconds; is asked in order of time.
  using Motion = std::function<Pose2(double)>;

  SimulatedLidar(const LidarOptions& options, std::uint64_t seed)
      : options_(options), noise_(stir(seed, 0)), luck_(stir(seed, 1)) {}

  /// A sweep that begins `t_s` after the start. No wall within range is +infinity; a wall closer
  /// than range_min_m, and a drop-out, is 0. Stamp and attitude are not set; the truth is, at the
  /// stamp.
  [[nodiscard]] sensing::RawScan sweep(const RayScene& scene, const Motion& T_world_head,
                                       double t_s);

 private:
  [[nodiscard]] float read(double true_range_m);

  LidarOptions options_;
  PortableNoise noise_;
  Draw luck_;  // decides on drop-outs
};

/// The yaw of an attitude sensor: white noise, a drift that wanders off, and a zero of its own.
class SimulatedAhrs {
 public:
  static constexpr double kWhiteSigmaDeg = 0.5;
  static constexpr double kDriftSigmaDegPerRootS = 0.05;

  explicit SimulatedAhrs(std::uint64_t seed);

  /// What it says `dt_s` after the last time; roll and pitch are 0.
  [[nodiscard]] sensing::Attitude measure(double true_yaw_rad, double dt_s);

 private:
  PortableNoise noise_;
  double zero_rad_;  // the drift moves it
};

}  // namespace lifeline::sources
