#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include <Eigen/Geometry>

#include "agents/sensing/attitude_source.hpp"
#include "agents/sources/source_spec.hpp"
#include "common/base/result.hpp"

namespace lifeline::ahrs {

/// What `ahrs:DEVICE?options` says.
struct AhrsOptions {
  std::string device;
  std::string kind = "vectornav";  ///< or ahrs8
  int baud = 115200;
  /// How the sensor is mounted on the helmet; Rz(yaw) Ry(pitch) Rx(roll).
  Eigen::Quaterniond R_body_sensor = Eigen::Quaterniond::Identity();
};

/// wrong_use with one line for an unknown option or a value outside of its range.
[[nodiscard]] Result<AhrsOptions> read_ahrs_options(const sources::SourceSpec& spec);

/// Opens an attitude sensor on a serial port, and reads it on a thread of its own until `stop`, or
/// until the source is destroyed. not_found, wrong_use or unavailable where the port cannot be
/// opened now. Later on nothing is an error: a sensor that falls silent, is unplugged or talks
/// nonsense is waited for and opened again, health() says so, and the log names it once.
/// Stamps are stamp_of() of when a sample was measured, as well as that is known.
[[nodiscard]] Result<std::unique_ptr<sensing::AttitudeSource>> open_ahrs_source(
    const AhrsOptions& options, const std::stop_token& stop);

}  // namespace lifeline::ahrs
