#pragma once

#include <memory>
#include <stop_token>

#include "agents/sensing/scan_source.hpp"
#include "agents/sources/source_spec.hpp"

namespace lifeline::sources {

/// Hears a ROS 2 driver: `ros2:SCAN_TOPIC[,IMU_TOPIC]?domain=0&qos=FILE&scans=N`
/// (docs/sources.md). Scans come in the order of arrival, stamped as their messages say; a scan
/// waits for its attitudes as a live sensor's do (JoinedSource). A driver that is not there yet,
/// goes or talks nonsense ends nothing: it is logged and waited for. Only a request on `stop` ends
/// the source, or its N-th scan.
///
/// Options:
/// - `domain`: the driver's ROS_DOMAIN_ID (default 0).
/// - `qos`: QoS profile file (default config/qos/ros2.xml).
/// - `scans`: how many are taken (default: no end).
///
/// wrong_use for options and names that make no sense; not_found, bad_data or unavailable where the
/// QoS file is not good or the domain cannot be joined.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_ros2_source(
    const SourceSpec& spec, const std::stop_token& stop = {});

}  // namespace lifeline::sources
