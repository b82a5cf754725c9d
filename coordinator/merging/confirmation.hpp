#pragma once

#include <map>

#include <Eigen/Core>

#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::merging {

/// What makes one match outweigh the lack of a second.
struct ConfirmationConfig {
  /// Two matches agree when they put the overlap's centre this close together ...
  double same_place_m = kSamePlaceM;
  double same_turn_rad = kSameTurnRad;  ///< ... turned by no more than this
  double enough_wall_m = 60.0;          ///< so much agreeing wall needs no second match
};

/// A match that was accepted on its own figures.
struct Proposal {
  Pose2 T_a_b;
  Eigen::Vector2d overlap_centre_b_m{0.0, 0.0};  ///< in b's map frame
  double agreeing_wall_m = 0.0;
  bool last_chance = false;  ///< neither map will change: there will be no second match
};

/// Young maps look alike in many places, and differently wrong ones a few metres later. So a pair
/// is merged only when two matches in a row, on maps that grew between them, say the same; then it
/// stays merged. One owner, not thread-safe.
class Confirmation {
 public:
  explicit Confirmation(ConfirmationConfig config = {}) : config_(config) {}

  /// Notes an accepted match; true when the pair may be merged by it.
  [[nodiscard]] bool confirm(const LayerPair& pair, const Proposal& proposal);
  /// Notes a match that was not accepted: what was proposed before counts no more.
  void refuse(const LayerPair& pair);

 private:
  [[nodiscard]] bool agree(const Proposal& before, const Proposal& now) const;

  ConfirmationConfig config_;
  std::map<LayerPair, Proposal> proposed_;
};

}  // namespace lifeline::merging
