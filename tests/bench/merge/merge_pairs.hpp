#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/grid/pose2.hpp"
#include "coordinator/matching/match_maps.hpp"

namespace lifeline::bench {

/// Two maps and what is known about them.
struct MergePair {
  std::string name;
  std::string kind;  ///< same, drift10_, disjoint or different
  std::string building_a, building_b;
  double overlap = 0.0;                  ///< share of the smaller map
  std::optional<Pose2> T_a_b;            ///< none for two buildings
  Eigen::Vector2d centre_b_m{0.0, 0.0};  ///< of the overlap: errors are taken there
  matching::MapFeatures a, b;
};

/// One pair with the errors of the best candidate.
struct JudgedPair {
  const MergePair* pair = nullptr;
  matching::MatchResult result;
  double error_m = 0.0;
  double error_deg = 0.0;

  /// Within 0.5 m and 2 deg of the truth.
  [[nodiscard]] bool right() const {
    return pair->T_a_b && !result.candidates.empty() && error_m < 0.5 && error_deg < 2.0;
  }
};

/// The pairs of a folder with an index.csv and PAIRa.yaml, PAIRb.yaml.
[[nodiscard]] Result<std::vector<MergePair>> load_pairs(const std::filesystem::path& folder);

/// Pairs of simulated offices: what there is to measure where no recordings are.
[[nodiscard]] std::vector<MergePair> simulate_pairs(int buildings);

[[nodiscard]] JudgedPair judge_pair(const MergePair& pair, const matching::MatchConfig& config);

}  // namespace lifeline::bench
