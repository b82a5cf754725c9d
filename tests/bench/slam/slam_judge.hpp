#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/slam/slam_cases.hpp"
#include "tests/bench/slam/slam_run.hpp"

namespace lifeline::bench {

/// The matcher that the bars are for; the paper's two stand beside it.
inline constexpr const char* kDefaultMatcher = "direct";

/// Rows of one recording: its measure, then time and memory. Bars only where `matcher` is the
/// default one. A run that failed gives one row without value.
[[nodiscard]] std::vector<ReportRow> judge_log(const LogCase& log, const std::string& matcher,
                                               const Result<SlamOutcome>& run);

/// What one simulated walk came to.
struct WalkFigures {
  double rmse_m = 0.0;
  double worst_m = 0.0;
  double drift_deg_per_m = 0.0;
  double step_ms_median = 0.0;
  double step_ms_p99 = 0.0;
  double peak_rss_mb = 0.0;
  /// No pose was off by more than 0.5 m or 10 deg.
  bool tracked = false;
};
[[nodiscard]] Result<WalkFigures> judge_walk(const SlamOutcome& run);

/// Rows over all walks of one kind; `name` begins each. A walk without figures (its run failed)
/// counts as one that was not tracked and makes the others' rows miss.
[[nodiscard]] std::vector<ReportRow> accuracy_rows(
    const std::string& name, const std::vector<std::optional<WalkFigures>>& walks, bool has_bars);
/// The share of walks without a tracking failure.
[[nodiscard]] ReportRow tracking_row(const std::string& name,
                                     const std::vector<std::optional<WalkFigures>>& walks,
                                     bool has_bar);

}  // namespace lifeline::bench
