#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// What a run on a recording is judged by.
enum class Measure {
  relations,  ///< mean translational error over hand-checked relations
  rmse,       ///< to the poses the source calls true, after the best rigid alignment
  body_rmse,  ///< to motion capture, with the lidar's place on the vehicle fitted
  failures,   ///< scans that were given up: nothing says what was true
};

/// One recording played with one prior.
struct LogCase {
  std::string name;  ///< "intel, odometry"
  std::string source;
  Measure measure = Measure::rmse;
  std::optional<double> bar = {};    ///< of the default matcher, in the measure's unit
  std::optional<double> worst = {};  ///< most that any single pose may be off, metres
  std::string reference = {};        ///< what others reach
  std::filesystem::path truth = {};  ///< relations or motion capture
  std::filesystem::path odometry = {};
  int beams = 0;  ///< 360 or so, where the bar of speed holds
};

/// The recordings of `data` (docs/benchmarks.md) with their bars; those that are not there are left
/// out.
[[nodiscard]] std::vector<LogCase> log_cases(const std::filesystem::path& data);

/// `count` HouseExpo plans of `data`, spread evenly over the list that is sorted by size; fewer
/// where there are not as many, none where the list is not there.
[[nodiscard]] std::vector<std::filesystem::path> spread_plans(const std::filesystem::path& data,
                                                              std::size_t count);

}  // namespace lifeline::bench
