#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/wire/messages.hpp"
#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::merging {

/// How much a member's place must move before the fleet is told.
struct DirectiveConfig {
  double own_weight = 0.5;   ///< w_T1 of Eq. 8-10
  double min_move_m = 0.03;  ///< of any corner of what the member knows
};

/// What each layer knows, as a box in its map frame.
using Extents = std::map<LayerKey, Eigen::AlignedBox2d>;

/// What a new directive changes.
struct DirectiveChange {
  struct Move {
    LayerKey layer;
    double moved_m = 0.0;  ///< the farthest that a corner of its extent moves
  };
  Epoch epoch;
  std::vector<LayerKey> joined, left;  ///< members that were in no group before, or are in none now
  std::vector<LayerKey> regrouped;     ///< members that have another lead now
  std::vector<Move> moved;             ///< members that keep their lead, farthest first

  /// For people: "bravo joins; charlie moves by 0.12 m".
  [[nodiscard]] std::string describe() const;
};

/// Turns merge plans into directives with growing epochs. A plan that says what the last directive
/// says makes no new one.
class DirectiveWriter {
 public:
  DirectiveWriter(DirectiveConfig config, std::string mission_id)
      : config_(config), mission_id_(std::move(mission_id)) {}

  /// What changes, when the plan made a new directive (its envelope is still to be filled). Layers
  /// without an extent are measured at their origin.
  std::optional<DirectiveChange> update(const MergePlan& plan, const Extents& extents = {});

  /// Makes the directive's epoch larger than `heard`, an epoch that some helmet follows and that we
  /// did not write. True when there is a directive that must be sent again under its new epoch: one
  /// with members, or one that took them back.
  bool outrank(Epoch heard);
  /// An epoch further ahead than any mission writes is a broken or hostile one.
  [[nodiscard]] bool is_believable(Epoch heard) const;

  /// Takes over a directive that another process wrote, or this one before a restart: what
  /// follows is compared with it and outranks it. False: it is not newer than what is held.
  bool adopt(const wire::MergeDirective& directive);

  /// Says what is held once more under an epoch above it and above `heard`. False where there is
  /// nothing to say: no directive was written or adopted yet.
  bool renew(Epoch heard);
  [[nodiscard]] bool has_spoken() const { return spoke_; }

  /// Epoch 0 and no members until the first update that says something.
  [[nodiscard]] const wire::MergeDirective& directive() const { return directive_; }

 private:
  DirectiveConfig config_;
  std::string mission_id_;
  bool spoke_ = false;
  wire::MergeDirective directive_;
};

}  // namespace lifeline::merging
