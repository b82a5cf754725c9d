#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "agents/sources/source_spec.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// The options `from` and `to` of a recording: scans [from, to), counted from 0.
struct ScanRange {
  std::int64_t from = 0;
  std::int64_t to = std::numeric_limits<std::int64_t>::max();
};

/// wrong_use for what is not a number of scans, and for a range without a scan.
[[nodiscard]] Result<ScanRange> read_scan_range(const SourceSpec& spec);

/// At the end of a recording that held `scans`: bad_data for one without any (`why_none` goes on
/// behind "holds no scan: ") and for one that `range` begins beyond.
[[nodiscard]] Result<void> check_scan_count(const std::string& recording, std::int64_t scans,
                                            ScanRange range, std::string_view why_none);

}  // namespace lifeline::sources
