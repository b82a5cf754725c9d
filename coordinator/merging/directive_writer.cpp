#include "coordinator/merging/directive_writer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/base/check.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"

namespace lifeline::merging {
namespace {

/// Moves that people need not hear of.
constexpr double kWorthTellingM = 0.005;

wire::DirectiveMember to_member(const Membership& membership, std::size_t group) {
  const auto& c = membership.covariance;
  return {sharing::to_layer_name(membership.layer),
          static_cast<std::uint16_t>(group),
          sharing::to_fixed(membership.T_common_map),
          {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)},
          static_cast<float>(membership.quality)};
}

struct Standpoint {
  LayerKey lead;
  wire::FixedTransform T_common_map;
};

std::map<LayerKey, Standpoint> standpoints(const std::vector<wire::DirectiveMember>& members) {
  std::map<std::uint16_t, LayerKey> leads;
  std::map<LayerKey, Standpoint> all;
  for (const auto& member : members) {
    const auto layer = sharing::to_layer_key(member.layer);
    LIFELINE_CHECK(layer.has_value());
    const LayerKey lead = leads.try_emplace(member.group, *layer).first->second;
    all.emplace(*layer, Standpoint{lead, member.T_common_map});
  }
  return all;
}

double farthest_move_m(const Pose2& before, const Pose2& now, const Extents& extents,
                       const LayerKey& layer) {
  const auto extent = extents.find(layer);
  if (extent == extents.end() || extent->second.isEmpty())
    return (before.translation() - now.translation()).norm();
  double farthest_m = 0.0;
  for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                            Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
    const Eigen::Vector2d p_map = extent->second.corner(corner);
    farthest_m = std::max(farthest_m, (before * p_map - now * p_map).norm());
  }
  return farthest_m;
}

DirectiveChange compare(const std::vector<wire::DirectiveMember>& before_members,
                        const std::vector<wire::DirectiveMember>& now_members,
                        const Extents& extents) {
  const auto before = standpoints(before_members), now = standpoints(now_members);
  DirectiveChange change;
  for (const auto& [layer, there] : now) {
    const auto was = before.find(layer);
    if (was == before.end()) {
      change.joined.push_back(layer);
    } else if (was->second.lead != there.lead) {
      change.regrouped.push_back(layer);
    } else {
      change.moved.push_back(
          {layer, farthest_move_m(sharing::to_pose(was->second.T_common_map),
                                  sharing::to_pose(there.T_common_map), extents, layer)});
    }
  }
  for (const auto& [layer, there] : before) {
    if (!now.contains(layer)) change.left.push_back(layer);
  }
  std::stable_sort(change.moved.begin(), change.moved.end(),
                   [](const auto& x, const auto& y) { return x.moved_m > y.moved_m; });
  return change;
}

std::string names(const std::vector<LayerKey>& layers) {
  std::string text;
  for (const LayerKey& layer : layers)
    text += (text.empty() ? "" : ", ") +
            (layer.map_id.value == 1 ? layer.agent_id.text() : to_string(layer));
  return text;
}

void append(std::string& text, const std::string& more) {
  text += (text.empty() ? "" : "; ") + more;
}

}  // namespace

std::string DirectiveChange::describe() const {
  std::string text;
  if (!joined.empty()) append(text, "joined: " + names(joined));
  if (!left.empty()) append(text, "left: " + names(left));
  if (!regrouped.empty()) append(text, "another common frame: " + names(regrouped));
  for (const Move& move : moved) {
    if (move.moved_m < kWorthTellingM) break;
    append(text, fmt::format("{} moves by {:.2f} m", names({move.layer}), move.moved_m));
  }
  return text.empty() ? "nothing moves" : text;
}

std::optional<DirectiveChange> DirectiveWriter::update(const MergePlan& plan,
                                                       const Extents& extents) {
  std::vector<wire::DirectiveMember> members;
  for (std::size_t group = 0; group < plan.groups.size(); ++group) {
    for (const Membership& membership : plan.groups[group])
      members.push_back(to_member(membership, group));
  }
  DirectiveChange change = compare(directive_.members, members, extents);
  const bool moved = !change.moved.empty() && change.moved.front().moved_m > config_.min_move_m;
  if (!moved && change.joined.empty() && change.left.empty() && change.regrouped.empty())
    return std::nullopt;
  directive_.mission_id = mission_id_;
  directive_.epoch += 1;
  directive_.own_weight_permille =
      static_cast<std::uint16_t>(std::lround(1000.0 * config_.own_weight));
  directive_.members = std::move(members);
  spoke_ = true;
  change.epoch = Epoch{directive_.epoch};
  return change;
}

bool DirectiveWriter::is_believable(Epoch heard) const {
  return sharing::is_believable(heard, Epoch{directive_.epoch});
}

bool DirectiveWriter::outrank(Epoch heard) {
  if (heard.value <= directive_.epoch || !is_believable(heard)) return false;
  directive_.epoch = spoke_ ? heard.value + 1 : heard.value;
  return spoke_;
}

bool DirectiveWriter::adopt(const wire::MergeDirective& directive) {
  const bool is_newer = directive.epoch > directive_.epoch;
  if (!is_newer && (spoke_ || directive.epoch < directive_.epoch)) return false;
  directive_ = directive;
  spoke_ = true;
  return true;
}

bool DirectiveWriter::renew(Epoch heard) {
  if (!spoke_) return false;
  directive_.epoch = std::max(directive_.epoch, is_believable(heard) ? heard.value : 0) + 1;
  return true;
}

}  // namespace lifeline::merging
