#pragma once

#include "common/wire/messages.hpp"
#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::merging {

/// How much a member's place must move before the fleet is told.
struct DirectiveConfig {
  double own_weight = 0.5;  ///< w_T1 of Eq. 8-10
  double min_move_m = 0.01;
  double min_turn_rad = 0.002;
};

/// Turns merge plans into directives with growing epochs. A plan that says what the last directive
/// says makes no new one.
class DirectiveWriter {
 public:
  DirectiveWriter(DirectiveConfig config, std::string mission_id)
      : config_(config), mission_id_(std::move(mission_id)) {}

  /// True when the plan made a new directive (its envelope is still to be filled).
  bool update(const MergePlan& plan);

  /// Makes the directive's epoch larger than `heard`, an epoch that some helmet follows and that we
  /// did not write. True when there is a directive that must be sent again under its new epoch.
  bool outrank(Epoch heard);

  /// Epoch 0 and no members until the first update that says something.
  [[nodiscard]] const wire::MergeDirective& directive() const { return directive_; }

 private:
  [[nodiscard]] bool says_the_same(const std::vector<wire::DirectiveMember>& members) const;

  DirectiveConfig config_;
  std::string mission_id_;
  wire::MergeDirective directive_;
};

}  // namespace lifeline::merging
