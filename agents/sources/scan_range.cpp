#include "agents/sources/scan_range.hpp"

namespace lifeline::sources {

Result<ScanRange> read_scan_range(const SourceSpec& spec) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const auto from = spec.integer("from", 0, 0, kMost - 1);
  if (!from) return forward_error(from);
  const auto to = spec.integer("to", kMost, 1, kMost);
  if (!to) return forward_error(to);
  if (*from >= *to) {
    return fail(ErrorCode::wrong_use, "{}: from={} to={} leaves no scan", spec.kind, *from, *to);
  }
  return ScanRange{*from, *to};
}

Result<void> check_scan_count(const std::string& recording, std::int64_t scans, ScanRange range,
                              std::string_view why_none) {
  if (scans == 0) {
    return fail(ErrorCode::bad_data, "{}: holds no scan: {}", recording, why_none);
  }
  if (scans <= range.from) {
    return fail(ErrorCode::bad_data, "{}: holds {} scans, from={} is beyond the last", recording,
                scans, range.from);
  }
  return {};
}

}  // namespace lifeline::sources
