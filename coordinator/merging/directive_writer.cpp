#include "coordinator/merging/directive_writer.hpp"

#include <algorithm>
#include <cmath>

#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"

namespace lifeline::merging {
namespace {

wire::DirectiveMember to_member(const Membership& membership, std::size_t group) {
  const auto& c = membership.covariance;
  return {sharing::to_layer_name(membership.layer),
          static_cast<std::uint16_t>(group),
          sharing::to_fixed(membership.T_common_map),
          {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)},
          static_cast<float>(membership.quality)};
}

}  // namespace

bool DirectiveWriter::update(const MergePlan& plan) {
  std::vector<wire::DirectiveMember> members;
  for (std::size_t group = 0; group < plan.groups.size(); ++group) {
    for (const Membership& membership : plan.groups[group])
      members.push_back(to_member(membership, group));
  }
  if (says_the_same(members)) return false;
  directive_.mission_id = mission_id_;
  directive_.epoch += 1;
  directive_.own_weight_permille =
      static_cast<std::uint16_t>(std::lround(1000.0 * config_.own_weight));
  directive_.members = std::move(members);
  return true;
}

bool DirectiveWriter::outrank(Epoch heard) {
  // No coordinator writes a million directives in a mission: such an epoch is a broken or hostile
  // status.
  constexpr std::uint64_t kMaxLead = 1'000'000;
  if (heard.value <= directive_.epoch || heard.value - directive_.epoch > kMaxLead) return false;
  const bool speaks = !directive_.members.empty();
  directive_.epoch = speaks ? heard.value + 1 : heard.value;
  return speaks;
}

bool DirectiveWriter::says_the_same(const std::vector<wire::DirectiveMember>& members) const {
  const auto same = [&](const wire::DirectiveMember& old, const wire::DirectiveMember& now) {
    const Pose2 moved =
        sharing::to_pose(old.T_common_map).inverse() * sharing::to_pose(now.T_common_map);
    return old.layer == now.layer && old.group == now.group &&
           moved.translation().norm() < config_.min_move_m &&
           std::abs(moved.yaw_rad) < config_.min_turn_rad;
  };
  return std::equal(directive_.members.begin(), directive_.members.end(), members.begin(),
                    members.end(), same);
}

}  // namespace lifeline::merging
