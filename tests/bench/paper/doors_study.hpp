#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tests/bench/paper/paper_cases.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// The paper's Figures 5, 12 and 15: who gets through doors that open and close. Each rescuer's
/// trajectory against the truth, by each method.
class DoorsStudy {
 public:
  /// One rescuer's walk.
  struct Run {
    double rmse_m = 0.0;
    double heading_rms_deg = 0.0;
    double heading_worst_deg = 0.0;
    bool survived = false;  ///< no pose off by more than 0.5 m or 10 deg
  };

  /// `picture`: the first rescuer's maps by all methods, side by side.
  void play(const PaperExperiment& experiment, const PaperWalk& walk,
            const std::optional<std::filesystem::path>& picture);
  [[nodiscard]] std::vector<ReportRow> rows() const;

 private:
  std::map<std::pair<int, Method>, std::vector<Run>> runs_;  ///< by experiment
};

}  // namespace lifeline::bench
