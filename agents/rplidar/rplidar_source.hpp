#pragma once

#include <memory>
#include <stop_token>

#include "agents/rplidar/device.hpp"
#include "agents/sensing/scan_source.hpp"
#include "agents/sources/source_spec.hpp"

namespace lifeline::rplidar {

/// What an rplidar SOURCE asks for: `rplidar:DEVICE?mode=...&baud=...` (docs/sources.md).
struct RplidarOptions {
  DeviceSettings device;
  double yaw_rad = 0.0;   ///< from the nose to the device's zero, counter-clockwise
  bool inverted = false;  ///< mounted upside down
};

[[nodiscard]] Result<RplidarOptions> read_rplidar_options(const sources::SourceSpec& spec);

/// Opens the device and starts its rotor; scans from the first next() on. Fails where the device is
/// not there, not ours to open, does not answer, reports an error or lacks the mode: what has to be
/// mended before a mission. What goes wrong later ends nothing: it is logged with advice, and the
/// device is opened anew until it scans again. Only a request on `stop` ends the source, at once.
///
/// Stamps are the system clock's at opening, carried on by the steady clock: they do not jump.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_rplidar_source(
    const sources::SourceSpec& spec, const std::stop_token& stop = {});

}  // namespace lifeline::rplidar
