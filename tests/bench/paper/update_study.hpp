#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "tests/bench/paper/map_error.hpp"
#include "tests/bench/paper/paper_cases.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// The paper's Figures 9, 10, 13 and 16: what the TSD update from each other (Eq. 8-10) is worth,
/// with a good T_G and with a spoilt one.
class UpdateStudy {
 public:
  /// One pair of walks.
  struct Run {
    double wall_m = 0.0;
    double astray_percent = 0.0;
    double complete_percent = 0.0;
    double rmse_m = 0.0;  ///< of the worse of the two trajectories
  };
  /// Experiment, whether T_G is spoilt, w_T1 (1: no update).
  using Case = std::tuple<int, bool, double>;

  /// The maps are merged when Eq. 11 holds for both with Table 1's beta. The good T_G is the true
  /// one; the spoilt one is off by 0.25 m in a direction that `seed` draws, and by 3 deg.
  void play(const PaperExperiment& experiment, const PaperWalk& walk, std::uint64_t seed,
            const std::optional<std::filesystem::path>& picture);
  [[nodiscard]] std::vector<ReportRow> rows() const;

 private:
  std::map<Case, std::vector<Run>> runs_;
};

}  // namespace lifeline::bench
