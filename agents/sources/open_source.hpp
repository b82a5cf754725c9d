#pragma once

#include <memory>
#include <stop_token>
#include <string_view>

#include "agents/sensing/scan_source.hpp"
#include "agents/sources/paced_source.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// Opens a SOURCE: `carmen:LOG[.gz]`, `columns:FILE`, `ros2:SCAN_TOPIC,IMU_TOPIC`, `rosbag2:DIR`,
/// `rplidar:DEVICE` or `sim:PLAN`, with options after '?' (docs/sources.md). The option
/// `rate=real|max|xN` is read here, for every kind; `default_pace` stands in where it is not given.
/// A live lidar runs at its own pace whatever the default. A request on `stop` ends a paced or live
/// source, also while it waits.
///
/// wrong_use for a kind that there is not (the text lists those there are) and for options that
/// make no sense; the kind's own errors otherwise.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_source(
    std::string_view source, SourcePace default_pace = kUnpaced, std::stop_token stop = {});

/// The same, with the attitudes of a live sensor: `ahrs:DEVICE?options` (docs/sources.md), or empty
/// for none. Only an rplidar takes them (wrong_use for all others, which bring their own). A sensor
/// that cannot be opened is an error; one that fails later is not.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_source_with_attitude(
    std::string_view source, std::string_view attitude, SourcePace default_pace = kUnpaced,
    const std::stop_token& stop = {});

}  // namespace lifeline::sources
