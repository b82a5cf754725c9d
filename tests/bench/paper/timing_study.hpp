#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tests/bench/paper/paper_cases.hpp"
#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// What came of matching two maps once.
struct MergeAttempt {
  double at_s = 0.0;
  double explored_percent = 0.0;  ///< of the map that knows less (Eq. 11)
  bool best_is_right = false;     ///< the best candidate, whatever is thought of it
  bool accepted = false;
};

/// What came of matching again and again from when Eq. 11 held for both maps.
struct MergeOutcome {
  bool tried = false;           ///< it held at some time
  bool first_is_right = false;  ///< the first attempt's best candidate, accepted or not
  std::optional<double> merged_s;
  bool merged_rightly = false;
};

/// The first attempt that was accepted among those with more than `beta_percent` explored.
/// `attempts` in order of time.
[[nodiscard]] MergeOutcome outcome_of(const std::vector<MergeAttempt>& attempts,
                                      double beta_percent);

/// The paper's Figure 8: how early two maps may be matched. Both rescuers' maps are matched every
/// five seconds, by the paper's spectra with Table 1's thresholds and by ours.
class TimingStudy {
 public:
  explicit TimingStudy(double duration_s) : duration_s_(duration_s) {}

  /// `picture`: the maps laid on each other by the best candidate at 0.28 % and at 5 %.
  void play(const PaperExperiment& experiment, const PaperWalk& walk,
            const std::optional<std::filesystem::path>& picture);
  [[nodiscard]] std::vector<ReportRow> rows() const;

 private:
  double duration_s_;
  std::map<std::pair<int, matching::Method>, std::vector<std::vector<MergeAttempt>>> pairs_;
};

}  // namespace lifeline::bench
