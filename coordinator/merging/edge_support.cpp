#include "coordinator/merging/edge_support.hpp"

#include <fmt/format.h>

namespace lifeline::merging {

EdgeDecision EdgeSupport::judge(const LayerPair& pair, const PairMatch& match,
                                const MergeEdge* held) {
  EdgeDecision decision;
  if (held == nullptr) {
    decision = judge_new(pair, match);
  } else if (!match.result.accepted()) {
    confirmation_.refuse(pair);
    decision = judge_undecided(pair, match);
  } else {
    const auto& found = match.result.candidates.front();
    const auto off = difference(held->T_a_b, found.T_a_b, match.result.overlap_centre_b_m);
    decision = off.within(kSamePlaceM, kSameTurnRad) ? EdgeDecision{EdgeStep::refined, {}}
                                                     : judge_elsewhere(pair, match, off);
  }
  if (decision.step == EdgeStep::adopted || decision.step == EdgeStep::refined) {
    agreed_wall_m_[pair] = match.result.candidates.front().agreeing_wall_m;
    confirmation_.refuse(pair);  // what was proposed has become the edge, or was wrong
  }
  if (decision.step != EdgeStep::doubted) doubts_.erase(pair);
  return decision;
}

EdgeDecision EdgeSupport::judge_new(const LayerPair& pair, const PairMatch& match) {
  if (!match.result.accepted()) {
    confirmation_.refuse(pair);
    return {};
  }
  if (confirm(pair, match)) return {EdgeStep::adopted, {}};
  return {EdgeStep::proposed, "fits once, to be confirmed when the maps have grown: "};
}

EdgeDecision EdgeSupport::judge_elsewhere(const LayerPair& pair, const PairMatch& match,
                                          const PlaceDifference& off) {
  const std::string moved = fmt::format("{:.1f} m, {:.0f} deg from where the maps were merged",
                                        off.distance_m, off.angle_deg());
  if (confirm(pair, match)) return {EdgeStep::adopted, "moved: fits " + moved};
  return doubt(pair, false, "the best place is " + moved);
}

EdgeDecision EdgeSupport::judge_undecided(const LayerPair& pair, const PairMatch& match) {
  if (!match.check) return {EdgeStep::kept, {}};
  const std::string lost = lost_support(pair, *match.check);
  if (!lost.empty()) return doubt(pair, match.last_chance, lost);
  if (!contradicts(*match.check)) return {EdgeStep::kept, {}};
  return {EdgeStep::kept,
          fmt::format("a map is bent: of {:.0f} % of the wall that contradict, {:.0f} % are only "
                      "displaced by less than 1 m",
                      100 * match.check->figures.conflict,
                      100 * match.check->displaced_m / match.check->conflict_m)};
}

EdgeDecision EdgeSupport::doubt(const LayerPair& pair, bool final, const std::string& why) {
  if (final || ++doubts_[pair] >= config_.doubts) return {EdgeStep::withdrawn, "withdrawn: " + why};
  return {EdgeStep::doubted, "in doubt, kept until the next match: " + why};
}

bool EdgeSupport::confirm(const LayerPair& pair, const PairMatch& match) {
  const auto& best = match.result.candidates.front();
  return confirmation_.confirm(
      pair, {best.T_a_b, match.result.overlap_centre_b_m, best.agreeing_wall_m, match.last_chance});
}

bool EdgeSupport::contradicts(const PlaceCheck& check) const {
  return check.figures.conflict > config_.max_conflict && check.conflict_m > config_.min_conflict_m;
}

std::string EdgeSupport::lost_support(const LayerPair& pair, const PlaceCheck& check) const {
  const auto& figures = check.figures;
  if (contradicts(check) && check.foreign_conflict() > config_.max_foreign_conflict) {
    return fmt::format("where the maps were merged {:.0f} % of the wall contradict now",
                       100 * figures.conflict);
  }
  const auto agreed = agreed_wall_m_.find(pair);
  if (agreed != agreed_wall_m_.end() &&
      figures.agreeing_wall_m < config_.min_agreeing_share * agreed->second) {
    return fmt::format("where the maps were merged {:.1f} m of wall agree, {:.1f} m did",
                       figures.agreeing_wall_m, agreed->second);
  }
  return {};
}

}  // namespace lifeline::merging
