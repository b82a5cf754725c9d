#pragma once

#include <optional>
#include <utility>

#include "coordinator/match_worker.hpp"
#include "tests/support/simulated_network.hpp"

namespace lifeline::test {

/// Matches by the script: what fits where, and whether it is sure of it.
class ScriptedMatches final : public MatchWorker {
 public:
  explicit ScriptedMatches(Dice& dice) : dice_(dice) {}

  void submit(MatchJob job) override {
    MatchOutcome outcome{job.a, job.b, {}, std::nullopt};
    matching::MatchCandidate right;
    right.T_a_b = T_world_map(job.a.layer).inverse() * T_world_map(job.b.layer);
    if (dice_.chance(0.1)) right.T_a_b.x_m += 0.1;  // enough to be told
    right.agreeing_wall_m = right.score = 40.0;
    right.wall_agreement = 0.99;
    outcome.result.verdict = spoilt_ ? matching::Verdict::rejected : matching::Verdict::accepted;
    outcome.result.margin = 1.0;
    outcome.result.covariance = Eigen::Matrix3d::Identity() * 1e-6;
    if (job.check_T_a_b) {
      outcome.check.emplace();
      outcome.check->figures = right;
      outcome.check->figures.T_a_b = *job.check_T_a_b;
      if (spoilt_) {
        outcome.check->figures.conflict = 0.6;
        outcome.check->figures.agreeing_wall_m = 1.0;
        outcome.check->conflict_m = 20.0;
      }
    }
    if (!spoilt_) outcome.result.candidates.push_back(right);
    outcome_ = std::move(outcome);
  }
  [[nodiscard]] std::optional<MatchOutcome> take() override { return std::exchange(outcome_, {}); }
  [[nodiscard]] bool busy() const override { return outcome_.has_value(); }

  /// From now on nothing fits, or everything does again.
  void spoil(bool spoilt) { spoilt_ = spoilt; }

 private:
  static Pose2 T_world_map(const LayerKey& layer) {
    const double n = layer.agent_id.text().front() - 'a' + 4.0 * layer.map_id.value;
    return {0.7 * n, -0.4 * n, 0.3 * n};
  }
  Dice& dice_;
  bool spoilt_ = false;
  std::optional<MatchOutcome> outcome_;
};

}  // namespace lifeline::test
