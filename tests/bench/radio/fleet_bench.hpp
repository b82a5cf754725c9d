#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/result.hpp"
#include "tests/bench/radio/radio_fleet.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// Figure of what was not reached.
inline constexpr double kMissed = std::numeric_limits<double>::quiet_NaN();

/// What the benchmarks of whole fleets share.
struct FleetBench {
  RadioFleet::Options fleet;
  Report report;

  /// Into the report, and at once to who waits.
  void row(const std::string& name, double value, const std::string& unit,
           std::optional<double> at_most, const std::string& reference = {});
};

/// Runs the programs beside this one, with their logs below the folder for temporary files. `qos`:
/// a file in the configuration's folder. unavailable where there is no such folder.
[[nodiscard]] Result<FleetBench> prepare_fleet_bench(const std::string& name,
                                                     const std::string& qos);

using FleetCase = std::pair<std::string, std::function<Result<void>()>>;

/// Runs the cases whose name holds `only`, and prints and writes the report as finish() does, whose
/// exit status it gives; 1 at once where a case could not be run.
[[nodiscard]] int run_cases(FleetBench& bench, const std::vector<FleetCase>& cases,
                            const std::string& only,
                            const std::optional<std::filesystem::path>& out);

}  // namespace lifeline::bench
