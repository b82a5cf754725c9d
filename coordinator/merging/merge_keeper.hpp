#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"
#include "coordinator/merging/edge_support.hpp"
#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::merging {

/// What has become of a pair, in words for people.
struct PairNews {
  LayerPair pair;
  matching::Verdict verdict = matching::Verdict::wait;
  std::string reason;
};

/// When the walls of two layers that a group laid on each other speak against it.
struct ObjectionConfig {
  double min_conflict = 0.18;     ///< share of the jointly seen wall
  double min_conflict_m = 4.0;    ///< the same as a length
  double lifted_conflict = 0.12;  ///< an objection stands until no more than this contradicts
};

/// Keeps the merge graph: takes in each match, decides what it does to the pair's edge, plans the
/// groups anew and tells whose standing changed. One owner, not thread-safe.
class MergeKeeper {
 public:
  explicit MergeKeeper(SupportConfig support = {}, ObjectionConfig objection = {})
      : support_(support), objection_(objection) {}

  /// Where the pair's next match has to look besides: its edge's place; without one, where its
  /// group lays it, or where its walls were found to contradict.
  [[nodiscard]] std::optional<Pose2> place_to_check(const LayerPair& pair) const;

  /// Takes in a match. The first news is of its pair; others follow where the plan's view of them
  /// changed.
  [[nodiscard]] std::vector<PairNews> take(const LayerPair& pair, const PairMatch& match);

  /// A person's word on a pair, which stands above every match until they say otherwise: parted by
  /// hand, no match merges it; merged by hand at the edge's place, no match parts it. The first
  /// news is of the pair.
  [[nodiscard]] std::vector<PairNews> part_by_hand(const LayerPair& pair);
  [[nodiscard]] std::vector<PairNews> merge_by_hand(const LayerPair& pair, MergeEdge edge);
  [[nodiscard]] const std::set<LayerPair>& parted_by_hand() const { return apart_; }

  /// Goes on from edges that were accepted before a restart, and with the common frames of a
  /// directive: where the edges do not hold one of its members, one to its lead is made of what it
  /// says, to be replaced by matches as they come.
  void adopt(const EdgeMap& edges, std::set<LayerPair> parted_by_hand = {});
  void adopt(const wire::MergeDirective& directive);

  [[nodiscard]] const MergePlan& plan() const { return plan_; }
  [[nodiscard]] const MergeGraph& graph() const { return graph_; }
  /// The pair has an edge, and the plan follows it.
  [[nodiscard]] bool follows(const LayerPair& pair) const;
  [[nodiscard]] bool in_doubt(const LayerPair& pair) const { return support_.in_doubt(pair); }
  /// Pairs without an edge that a group lays on each other where nobody looked yet.
  [[nodiscard]] std::set<LayerPair> unchecked() const;

 private:
  void note_check(const LayerPair& pair, const PlaceCheck& check);
  [[nodiscard]] PairNews apply(const LayerPair& pair, const PairMatch& match);
  void plan_anew(std::vector<PairNews>& news);
  void adopt_member(const LayerKey& lead, const Pose2& T_common_lead,
                    const wire::DirectiveMember& member);

  EdgeSupport support_;
  ObjectionConfig objection_;
  MergeGraph graph_;
  MergePlan plan_;
  std::map<LayerPair, PlaceCheck> checked_;  ///< of pairs without an edge
  std::map<LayerPair, std::string> parted_;  ///< why, of pairs that are no more merged
  std::set<LayerPair> apart_;                ///< parted by hand
};

/// An accepted match as an edge of the merge graph.
[[nodiscard]] MergeEdge to_edge(const matching::MatchResult& result);

}  // namespace lifeline::merging
