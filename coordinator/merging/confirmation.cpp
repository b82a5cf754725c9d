#include "coordinator/merging/confirmation.hpp"

namespace lifeline::merging {

bool Confirmation::confirm(const LayerPair& pair, const Proposal& proposal) {
  const auto before = proposed_.find(pair);
  const bool seconded = before != proposed_.end() && agree(before->second, proposal);
  proposed_.insert_or_assign(pair, proposal);
  return seconded || proposal.last_chance || proposal.agreeing_wall_m >= config_.enough_wall_m;
}

void Confirmation::refuse(const LayerPair& pair) {
  proposed_.erase(pair);
}

bool Confirmation::agree(const Proposal& before, const Proposal& now) const {
  return difference(before.T_a_b, now.T_a_b, now.overlap_centre_b_m)
      .within(config_.same_place_m, config_.same_turn_rad);
}

}  // namespace lifeline::merging
