#include "coordinator/merging/merge_graph.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <set>

namespace lifeline::merging {
namespace {

using EdgeRef = std::map<LayerPair, MergeEdge>::const_iterator;

struct Neighbour {
  LayerKey layer;
  Pose2 T_here_there;
  Eigen::Matrix3d covariance;
  double quality;
};

using Forest = std::map<LayerKey, std::vector<Neighbour>>;

// Kruskal: best quality first, ties by the pair's name.
struct Spanning {
  Forest forest;
  std::vector<EdgeRef> left_out;
};

class Components {
 public:
  LayerKey root(const LayerKey& layer) {
    auto parent = parents_.find(layer);
    if (parent == parents_.end()) return layer;
    return root(parent->second);
  }
  bool join(const LayerKey& a, const LayerKey& b) {
    const LayerKey root_a = root(a), root_b = root(b);
    if (root_a == root_b) return false;
    parents_.insert_or_assign(std::max(root_a, root_b), std::min(root_a, root_b));
    return true;
  }

 private:
  std::map<LayerKey, LayerKey> parents_;
};

// Covariance of the inverse transform: to first order the same, turned into the other frame.
Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, double yaw_rad) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(yaw_rad), -std::sin(yaw_rad), std::sin(yaw_rad),
      std::cos(yaw_rad);
  return turn * covariance * turn.transpose();
}

Spanning spanning_forest(const std::map<LayerPair, MergeEdge>& edges) {
  std::vector<EdgeRef> order;
  for (auto edge = edges.begin(); edge != edges.end(); ++edge) order.push_back(edge);
  std::stable_sort(order.begin(), order.end(),
                   [](EdgeRef x, EdgeRef y) { return x->second.quality > y->second.quality; });
  Spanning spanning;
  Components components;
  for (const EdgeRef ref : order) {
    const auto& [pair, edge] = *ref;
    if (!components.join(pair.a, pair.b)) {
      spanning.left_out.push_back(ref);
      continue;
    }
    const Pose2 T_b_a = edge.T_a_b.inverse();
    spanning.forest[pair.a].push_back({pair.b, edge.T_a_b, edge.covariance, edge.quality});
    spanning.forest[pair.b].push_back(
        {pair.a, T_b_a, turned(edge.covariance, T_b_a.yaw_rad), edge.quality});
  }
  return spanning;
}

MergeGroup grow_group(const Forest& forest, const LayerKey& lead, std::set<LayerKey>& placed) {
  MergeGroup group{{lead, Pose2{}, Eigen::Matrix3d::Zero(), 1.0}};
  placed.insert(lead);
  for (std::size_t next = 0; next < group.size(); ++next) {
    const Membership here = group[next];
    for (const Neighbour& neighbour : forest.at(here.layer)) {
      if (!placed.insert(neighbour.layer).second) continue;
      group.push_back({neighbour.layer, here.T_common_map * neighbour.T_here_there,
                       here.covariance + turned(neighbour.covariance, here.T_common_map.yaw_rad),
                       std::min(here.quality, neighbour.quality)});
    }
  }
  std::sort(group.begin() + 1, group.end(),
            [](const Membership& x, const Membership& y) { return x.layer < y.layer; });
  return group;
}

}  // namespace

MergePlan MergeGraph::plan(double max_distance_m, double max_angle_rad) const {
  const Spanning spanning = spanning_forest(edges_);
  MergePlan plan;
  std::set<LayerKey> placed;
  std::map<LayerKey, Pose2> T_common;
  for (const auto& [layer, neighbours] : spanning.forest) {
    if (placed.contains(layer)) continue;
    plan.groups.push_back(grow_group(spanning.forest, layer, placed));
    for (const Membership& member : plan.groups.back())
      T_common[member.layer] = member.T_common_map;
  }
  std::stable_sort(plan.groups.begin(), plan.groups.end(),
                   [](const MergeGroup& x, const MergeGroup& y) { return x.size() > y.size(); });
  for (const EdgeRef ref : spanning.left_out) {
    const auto& [pair, edge] = *ref;
    const Pose2 expected = T_common.at(pair.a).inverse() * T_common.at(pair.b);
    const Pose2 difference = expected.inverse() * edge.T_a_b;
    const double distance_m = difference.translation().norm(),
                 angle_rad = std::abs(difference.yaw_rad);
    if (distance_m > max_distance_m || angle_rad > max_angle_rad) {
      plan.contradictions.push_back({pair, distance_m, angle_rad});
    }
  }
  return plan;
}

}  // namespace lifeline::merging
