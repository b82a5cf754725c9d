#include "tests/bench/merge/cross_validation.hpp"

#include <algorithm>
#include <set>

#include "coordinator/matching/acceptance.hpp"

namespace lifeline::bench {
namespace {

using matching::AcceptanceLimits;

struct FoldTally {
  std::size_t right = 0, wrong = 0;
};

bool takes_part(const MergePair& pair, const std::string& building) {
  return pair.building_a == building || pair.building_b == building;
}

/// Verdicts under `limits`, from evidence that is there already.
template <class Which>
FoldTally judge_again(const std::vector<JudgedPair>& judged, const AcceptanceLimits& limits,
                      const Which& which) {
  matching::MatchConfig config;
  config.limits = config.layer_limits = limits;
  FoldTally tally;
  for (const JudgedPair& pair : judged) {
    if (pair.pair->kind == "drift10_" || !which(*pair.pair)) continue;
    matching::MatchResult result = pair.result;
    matching::judge(pair.pair->a, pair.pair->b, config, result);
    if (!result.accepted()) continue;
    ++(pair.right() ? tally.right : tally.wrong);
  }
  return tally;
}

/// From strict to loose in each limit.
std::vector<AcceptanceLimits> grid() {
  std::vector<AcceptanceLimits> all;
  for (const double margin : {0.7, 0.6, 0.5, 0.4, 0.3}) {
    for (const double control : {3.0, 2.5, 2.0, 1.5, 1.2}) {
      for (const double wall_m : {8.0, 6.0, 4.0, 3.0}) {
        for (const double conflict : {0.05, 0.08, 0.12}) {
          for (const double bend_sds : {3.0, 4.0, 6.0}) {
            AcceptanceLimits limits;
            limits.min_margin = margin;
            limits.min_control_ratio = control;
            limits.min_agreeing_wall_m = wall_m;
            limits.max_conflict = conflict;
            limits.min_conflict = 0.375 * conflict;
            limits.min_bend_sds = bend_sds;
            // What the lead asks beyond these comes from simulated floors.
            limits.min_lead = 0.0;
            all.push_back(limits);
          }
        }
      }
    }
  }
  return all;
}

/// Steps of the grid that have to be gone down from the strictest limits.
double looseness(const AcceptanceLimits& limits) {
  return (0.7 - limits.min_margin) / 0.1 + (3.0 - limits.min_control_ratio) / 0.5 +
         (8.0 - limits.min_agreeing_wall_m) / 2.0 + (limits.max_conflict - 0.05) / 0.03 +
         (limits.min_bend_sds - 3.0);
}

AcceptanceLimits learn(const std::vector<JudgedPair>& judged, const std::string& left_out,
                       const std::vector<AcceptanceLimits>& choices) {
  const AcceptanceLimits* best = nullptr;
  std::size_t most = 0;
  for (const AcceptanceLimits& limits : choices) {
    const FoldTally tally = judge_again(
        judged, limits, [&](const MergePair& pair) { return !takes_part(pair, left_out); });
    if (tally.wrong > 0) continue;
    if (best == nullptr || tally.right > most ||
        (tally.right == most && looseness(limits) < looseness(*best))) {
      best = &limits;
      most = tally.right;
    }
  }
  return best == nullptr ? choices.front() : *best;
}

}  // namespace

AcceptanceLimits loose_limits() {
  AcceptanceLimits limits;
  limits.min_agreeing_wall_m = 2.0;
  limits.min_conflict = limits.max_conflict = 0.25;
  limits.max_conflict_piece_m = 1e9;
  limits.min_margin = 0.2;
  limits.min_control_ratio = 0.0;
  limits.min_lead = 0.0;
  limits.min_bend_sds = 1e9;
  return limits;
}

std::vector<Fold> cross_validate(const std::vector<JudgedPair>& judged) {
  std::set<std::string> buildings;
  for (const JudgedPair& pair : judged) buildings.insert(pair.pair->building_a);
  const std::vector<AcceptanceLimits> choices = grid();
  std::vector<Fold> folds;
  for (const std::string& building : buildings) {
    Fold fold{building, learn(judged, building, choices)};
    const auto own = [&](const MergePair& pair) { return takes_part(pair, building); };
    const FoldTally tally = judge_again(judged, fold.limits, own);
    fold.right = tally.right;
    fold.wrong = tally.wrong;
    for (const JudgedPair& pair : judged) {
      if (pair.pair->kind == "drift10_" || !own(*pair.pair)) continue;
      ++fold.pairs;
      fold.can_merge += pair.right() ? 1U : 0U;
    }
    folds.push_back(fold);
  }
  return folds;
}

}  // namespace lifeline::bench
