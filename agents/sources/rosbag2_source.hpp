#pragma once

#include <memory>

#include "agents/sensing/scan_source.hpp"
#include "agents/sources/source_spec.hpp"

namespace lifeline::sources {

/// Plays the laser scans of a ROS recording: a rosbag2 folder or one of its .db3 files (SQLite,
/// CDR), or a ROS 1 .bag (format 2.0, uncompressed) or a folder that holds one. metadata.yaml is
/// not needed. docs/sources.md says what the fields are taken for.
///
/// Options:
/// - `scan`: the LaserScan topic (default: the first).
/// - `imu`: the Imu topic whose orientation becomes the attitude, or `none` (default: the first, if
///   there is one).
/// - `from`, `to`: scans [from, to) of the topic, counted from 0 (default: all).
///
/// wrong_use for options that make no sense and topics of another type; not_found where there is no
/// bag or no such topic; unsupported for compressed or MCAP recordings. next() gives bad_data for
/// malformed messages, a bag without a scan, and a `from` beyond the last one.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_rosbag2_source(
    const SourceSpec& spec);

}  // namespace lifeline::sources
