#include "common/sharing/groups.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"

namespace lifeline::sharing {
namespace {

std::vector<Placement> members_of(const wire::MergeDirective& directive, std::uint16_t group) {
  std::vector<Placement> members;
  for (const auto& member : directive.members) {
    if (member.group != group) continue;
    if (auto key = to_layer_key(member.layer))
      members.push_back({*std::move(key), member.T_common_map});
  }
  return members;
}

}  // namespace

std::vector<Placement> group_of(const wire::MergeDirective& directive, const LayerKey& layer) {
  const auto own =
      std::ranges::find(directive.members, to_layer_name(layer), &wire::DirectiveMember::layer);
  if (own == directive.members.end()) return {};
  return members_of(directive, own->group);
}

std::vector<Placement> largest_group(const wire::MergeDirective& directive) {
  return members_of(directive, 0);
}

}  // namespace lifeline::sharing
