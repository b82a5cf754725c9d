#include "coordinator/merging/merge_keeper.hpp"

#include <algorithm>
#include <utility>

#include "common/base/check.hpp"

namespace lifeline::merging {
namespace {

std::vector<LayerKey> leads_of(const MergePlan& plan) {
  std::vector<LayerKey> leads;
  for (const MergeGroup& group : plan.groups) leads.push_back(group.front().layer);
  return leads;
}

/// Whether people should hear of it again: figures may change a little without being news.
bool same_view(const Contradiction& before, const Contradiction& now) {
  return before.why == now.why && before.against == now.against;
}

// Where edges contradict each other, a person's word weighs most.
MergeEdge kept_by_hand(MergeEdge edge) {
  edge.quality = 1.0;
  edge.by_hand = true;
  edge.doubted = false;
  return edge;
}

}  // namespace

MergeEdge to_edge(const matching::MatchResult& result) {
  LIFELINE_CHECK(result.accepted() && !result.candidates.empty());
  const auto& best = result.candidates.front();
  // Metres of agreeing wall, brought into [0, 1): ten metres count half.
  const double wall_m = std::max(best.score, 0.0);
  return {best.T_a_b, result.covariance, wall_m / (wall_m + 10.0), result.overlap_centre_b_m,
          false};
}

std::optional<Pose2> MergeKeeper::place_to_check(const LayerPair& pair) const {
  if (const MergeEdge* edge = graph_.edge(pair)) return edge->T_a_b;
  if (auto laid = plan_.T_a_b(pair)) return laid;
  if (const Objection* objection = graph_.objection(pair)) return objection->T_a_b;
  return std::nullopt;
}

std::vector<PairNews> MergeKeeper::take(const LayerPair& pair, const PairMatch& match) {
  const std::optional<Pose2> asked = place_to_check(pair);
  std::vector<PairNews> news{apply(pair, match)};
  if (graph_.edge(pair) != nullptr) {
    graph_.set_doubted(pair, support_.in_doubt(pair) && !graph_.edge(pair)->by_hand);
    graph_.lift_objection(pair);  // the edge itself says now where they lie
    checked_.erase(pair);
  } else if (match.check) {
    note_check(pair, *match.check);
  } else if (asked) {
    // Nobody can look there: asking again would not help.
    PlaceCheck unseen;
    unseen.figures.T_a_b = *asked;
    checked_.insert_or_assign(pair, unseen);
  }
  plan_anew(news);
  return news;
}

PairNews MergeKeeper::apply(const LayerPair& pair, const PairMatch& match) {
  if (apart_.contains(pair)) {
    return {pair, matching::Verdict::rejected,
            "withdrawn by hand; this match: " + match.result.reason};
  }
  EdgeDecision decision = support_.judge(pair, match, graph_.edge(pair));
  const MergeEdge* held = graph_.edge(pair);
  const bool by_hand = held != nullptr && held->by_hand;
  if (by_hand && decision.step != EdgeStep::refined) {
    decision = {EdgeStep::kept, "accepted by hand" +
                                    (decision.reason.empty() ? "" : ", though " + decision.reason)};
  }
  PairNews news{pair, match.result.verdict, decision.reason};
  switch (decision.step) {
    case EdgeStep::none:
      news.reason = match.result.reason;
      if (const auto parted = parted_.find(pair); parted != parted_.end())
        news.reason += "; merged before, then " + parted->second;
      break;
    case EdgeStep::kept:
      news.verdict = matching::Verdict::wait;
      news.reason = "stays merged" + (decision.reason.empty() ? "" : ": " + decision.reason) +
                    "; this match: " + match.result.reason;
      break;
    case EdgeStep::proposed:
      news.verdict = matching::Verdict::wait;
      news.reason += match.result.reason;
      break;
    case EdgeStep::adopted:
    case EdgeStep::refined:
      graph_.set_edge(pair, by_hand ? kept_by_hand(to_edge(match.result)) : to_edge(match.result));
      parted_.erase(pair);
      news.reason += (news.reason.empty() ? "" : "; ") + match.result.reason;
      break;
    case EdgeStep::doubted:
      news.verdict = matching::Verdict::wait;
      break;
    case EdgeStep::withdrawn:
      graph_.withdraw(pair);
      parted_[pair] = decision.reason;
      news.verdict = matching::Verdict::rejected;
      break;
  }
  return news;
}

std::vector<PairNews> MergeKeeper::part_by_hand(const LayerPair& pair) {
  graph_.withdraw(pair);
  apart_.insert(pair);
  parted_[pair] = "withdrawn by hand";
  std::vector<PairNews> news{{pair, matching::Verdict::rejected, "withdrawn by hand"}};
  plan_anew(news);
  return news;
}

std::vector<PairNews> MergeKeeper::merge_by_hand(const LayerPair& pair, MergeEdge edge) {
  graph_.set_edge(pair, kept_by_hand(std::move(edge)));
  graph_.lift_objection(pair);
  apart_.erase(pair);
  parted_.erase(pair);
  checked_.erase(pair);
  std::vector<PairNews> news{{pair, matching::Verdict::accepted, "accepted by hand"}};
  plan_anew(news);
  return news;
}

void MergeKeeper::note_check(const LayerPair& pair, const PlaceCheck& check) {
  checked_.insert_or_assign(pair, check);
  const bool stands = graph_.objection(pair) != nullptr;
  const double least = stands ? objection_.lifted_conflict : objection_.min_conflict;
  if (check.figures.conflict > least && check.conflict_m >= objection_.min_conflict_m) {
    graph_.object(pair, {check.figures.T_a_b, check.overlap_centre_b_m, check.figures.conflict,
                         check.conflict_m});
  } else {
    graph_.lift_objection(pair);
  }
}

void MergeKeeper::plan_anew(std::vector<PairNews>& news) {
  const MergePlan before = std::exchange(plan_, graph_.plan(leads_of(plan_)));
  const LayerPair own = news.front().pair;
  for (const Contradiction& now : plan_.contradictions) {
    if (now.pair == own) {
      news.front().verdict = matching::Verdict::wait;
      news.front().reason = "not followed: " + describe(now);
      continue;
    }
    const Contradiction* known = before.find(now.pair);
    if (known == nullptr || !same_view(*known, now))
      news.push_back({now.pair, matching::Verdict::wait, "not followed: " + describe(now)});
  }
  for (const Contradiction& old : before.contradictions) {
    if (old.pair != own && follows(old.pair)) {
      news.push_back({old.pair, matching::Verdict::accepted,
                      "followed again: nothing contradicts it any more"});
    }
  }
}

bool MergeKeeper::follows(const LayerPair& pair) const {
  return graph_.edge(pair) != nullptr && plan_.find(pair) == nullptr;
}

std::set<LayerPair> MergeKeeper::unchecked() const {
  std::set<LayerPair> pairs;
  for (const MergeGroup& group : plan_.groups) {
    for (const Membership& x : group) {
      for (const Membership& y : group) {
        if (!(x.layer < y.layer) || x.layer.floor != y.layer.floor) continue;
        const LayerPair pair{x.layer, y.layer};
        if (graph_.edge(pair) != nullptr) continue;
        const Pose2 T_a_b = x.T_common_map.inverse() * y.T_common_map;
        const auto checked = checked_.find(pair);
        if (checked == checked_.end() ||
            !difference(checked->second.figures.T_a_b, T_a_b, checked->second.overlap_centre_b_m)
                 .within(kSamePlaceM, kSameTurnRad)) {
          pairs.insert(pair);
        }
      }
    }
  }
  return pairs;
}

}  // namespace lifeline::merging
