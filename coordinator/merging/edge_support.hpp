#pragma once

#include <map>
#include <optional>
#include <string>

#include "coordinator/matching/match_types.hpp"
#include "coordinator/merging/confirmation.hpp"

namespace lifeline::merging {

/// What two maps look like where the graph lays them, whatever place the match found.
struct PlaceCheck {
  matching::MatchCandidate figures;  ///< its T_a_b is the place that was looked at
  Eigen::Vector2d overlap_centre_b_m{0.0, 0.0};
  double conflict_m = 0.0;   ///< length of the contradicting wall
  double displaced_m = 0.0;  ///< of that, what displaced_conflict_m() explains: the maps are bent

  /// Share of contradicting wall that no bend explains.
  [[nodiscard]] double foreign_conflict() const {
    return conflict_m > 0.0 ? figures.conflict * (1.0 - displaced_m / conflict_m) : 0.0;
  }
};

/// Everything that a match of two layers said.
struct PairMatch {
  matching::MatchResult result;
  std::optional<PlaceCheck> check;  ///< where the graph asked for one
  bool last_chance = false;         ///< neither map will change: there will be no further match
};

enum class EdgeStep {
  none,      ///< no edge, and none is made
  proposed,  ///< fits once; a second match has to agree
  adopted,   ///< a new edge, or a new place for the one that was held
  refined,   ///< the held edge's place, measured better
  kept,      ///< the match decided nothing; the held place still fits
  doubted,   ///< the held edge lost its support once
  withdrawn  ///< ... and once more: it is gone
};

struct EdgeDecision {
  EdgeStep step = EdgeStep::none;
  /// For `proposed`, `doubted`, `withdrawn`, moves, and `kept` in spite of conflict; one sentence.
  std::string reason;
};

/// When an edge loses its support.
struct SupportConfig {
  double max_conflict =
      0.18;  ///< share of contradicting wall at the held place; layers are accepted up to 0.05
  /// The same without displaced wall. Wrong places that agree over more than 15 m while more than
  /// max_conflict contradicts have 0.09 and more of it, bent maps at their right place up to 0.08.
  double max_foreign_conflict = 0.08;
  double min_conflict_m = 2.0;      ///< less contradicting wall than this may be a door or a person
  double min_agreeing_share = 0.5;  ///< of the wall that agreed when the edge was measured
  int doubts = 2;                   ///< so many matches in a row without support end an edge
};

/// Decides what each match means for its pair's edge. To be merged takes two matches that agree
/// (Confirmation), and to be parted two in a row that do not support the edge: one bad match, made
/// while tiles are on their way, does neither. One owner, not thread-safe.
class EdgeSupport {
 public:
  explicit EdgeSupport(SupportConfig config = {}, ConfirmationConfig confirmation = {})
      : config_(config), confirmation_(confirmation) {}

  /// `held`: the pair's edge, or nullptr.
  [[nodiscard]] EdgeDecision judge(const LayerPair& pair, const PairMatch& match,
                                   const MergeEdge* held);
  /// The pair's edge lost its support at its last match.
  [[nodiscard]] bool in_doubt(const LayerPair& pair) const { return doubts_.contains(pair); }

 private:
  [[nodiscard]] EdgeDecision judge_new(const LayerPair& pair, const PairMatch& match);
  [[nodiscard]] EdgeDecision judge_elsewhere(const LayerPair& pair, const PairMatch& match,
                                             const PlaceDifference& off);
  [[nodiscard]] EdgeDecision judge_undecided(const LayerPair& pair, const PairMatch& match);
  [[nodiscard]] EdgeDecision doubt(const LayerPair& pair, bool final, const std::string& why);
  [[nodiscard]] bool confirm(const LayerPair& pair, const PairMatch& match);
  [[nodiscard]] bool contradicts(const PlaceCheck& check) const;
  [[nodiscard]] std::string lost_support(const LayerPair& pair, const PlaceCheck& check) const;

  SupportConfig config_;
  Confirmation confirmation_;
  std::map<LayerPair, double> agreed_wall_m_;  ///< of each edge when it was measured
  std::map<LayerPair, int> doubts_;
};

}  // namespace lifeline::merging
