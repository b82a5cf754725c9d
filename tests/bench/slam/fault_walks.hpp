#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "agents/sensing/raw_scan.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// What is done to a helmet in the middle of a walk.
struct Fault {
  std::string name;
  int scans = 0;  ///< that it lasts
  /// Changes scan `i` of the fault.
  std::function<void(sensing::RawScan&, int i)> spoil;
  bool restarts = false;  ///< then the helmet goes on with its layer alone, its place unknown ...
  bool away = false;      ///< ... or, after a time without a process, known from before that
  bool loses = true;      ///< it is expected to be lost by then
};

/// Covered, restarted, and all that a bad lidar or driver gives.
[[nodiscard]] std::vector<Fault> all_faults();

/// Plays each walk (recordings in memory, each with its truth) with one fault half-way, in this
/// process: rows of how many were found again, how soon, how many wrongly, what a search cost, and
/// how far off the helmet believed itself while it did not say that it was lost.
[[nodiscard]] std::vector<ReportRow> fault_rows(
    const Fault& fault, const std::vector<std::vector<sensing::RawScan>>& walks);

}  // namespace lifeline::bench
