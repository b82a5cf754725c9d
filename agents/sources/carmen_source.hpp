#pragma once

#include <memory>

#include "agents/sensing/scan_source.hpp"
#include "agents/sources/source_spec.hpp"

namespace lifeline::sources {

/// Plays the FLASER lines of a CARMEN log, plain or gzip-compressed: `carmen:LOG?from=0&to=450`.
/// Every other kind of line is skipped. docs/sources.md says what the fields are taken for.
///
/// Options:
/// - `from`, `to`: scans [from, to) in the order of the file, counted from 0 (default: all).
/// - `prior`: what is known of the movement. `none` (default); `ahrs`: attitude with the heading
///   of the corrected pose, made noisy (NoisyYaw); `yaw`: attitude with the odometry's heading;
///   `odom`: the whole odometry.
/// - `seed`: of the noise of `prior=ahrs` (default 1). The noise of a scan depends on the seed and
///   on its place in the file, so pieces cut by from and to see what the whole log would.
/// - `max_range`: metres at or beyond which nothing was hit (default 50).
///
/// Scans come in the order of the file, which is the order in which they were taken: where times go
/// back a little (4 scans of Intel), the time stands as recorded. Where a time is the very same as
/// that of the scan before (logs with times rounded away), the stamp is 1 ms later than that one's.
///
/// wrong_use for options that make no sense, not_found where there is no such file; next() then
/// gives bad_data, with file and line, for anything malformed, a truncated log, a log without a
/// scan, and a `from` beyond the last one.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_carmen_source(
    const SourceSpec& spec);

}  // namespace lifeline::sources
