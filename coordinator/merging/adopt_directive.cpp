// How a merge graph goes on from what was decided before (docs/decisions/0602).
#include <cmath>
#include <map>
#include <utility>

#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "coordinator/merging/merge_keeper.hpp"

namespace lifeline::merging {
namespace {

/// An adopted member weighs less than a match: any two matches that say otherwise outweigh it.
constexpr double kAdoptedShare = 0.5;

Eigen::Matrix3d covariance_of(const std::array<double, 6>& upper) {
  Eigen::Matrix3d c;
  c << upper[0], upper[1], upper[2],  //
      upper[1], upper[3], upper[4],   //
      upper[2], upper[4], upper[5];
  return c;
}

/// What comes from outside must not break the graph's algebra.
bool is_usable(const Eigen::Matrix3d& covariance) {
  return covariance.allFinite() && covariance.diagonal().minCoeff() >= 0.0 &&
         covariance.cwiseAbs().maxCoeff() < 100.0;
}

}  // namespace

void MergeKeeper::adopt(const EdgeMap& edges, std::set<LayerPair> parted_by_hand) {
  for (const auto& [pair, edge] : edges) graph_.set_edge(pair, edge);
  apart_ = std::move(parted_by_hand);
  plan_ = graph_.plan();
}

void MergeKeeper::adopt(const wire::MergeDirective& directive) {
  std::map<std::uint16_t, std::pair<LayerKey, Pose2>> leads;
  std::vector<LayerKey> order;
  for (const wire::DirectiveMember& member : directive.members) {
    auto layer = sharing::to_layer_key(member.layer);
    if (!layer) continue;
    const auto [lead, is_lead] =
        leads.try_emplace(member.group, std::pair(*layer, sharing::to_pose(member.T_common_map)));
    if (is_lead) {
      order.push_back(*layer);
    } else {
      adopt_member(lead->second.first, lead->second.second, member);
    }
  }
  plan_ = graph_.plan(order);
}

void MergeKeeper::adopt_member(const LayerKey& lead, const Pose2& T_common_lead,
                               const wire::DirectiveMember& member) {
  const LayerKey layer = *sharing::to_layer_key(member.layer);
  const Pose2 T_lead_member = T_common_lead.inverse() * sharing::to_pose(member.T_common_map);
  const bool first = lead < layer;
  const LayerPair pair = first ? LayerPair{lead, layer} : LayerPair{layer, lead};
  if (plan_.T_a_b(pair)) return;
  Eigen::Matrix3d covariance = covariance_of(member.covariance);
  if (!is_usable(covariance)) covariance = Eigen::Matrix3d::Identity() * 1e-3;
  const double quality = std::isfinite(member.quality) ? static_cast<double>(member.quality) : 0.0;
  graph_.set_edge(pair, {first ? T_lead_member : T_lead_member.inverse(),
                         covariance,
                         kAdoptedShare * std::min(1.0, std::max(0.1, quality)),
                         {0.0, 0.0},
                         false});
}

}  // namespace lifeline::merging
