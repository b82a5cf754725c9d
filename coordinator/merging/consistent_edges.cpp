#include "coordinator/merging/consistent_edges.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include <Eigen/LU>

#include "common/base/check.hpp"

namespace lifeline::merging {
namespace {

constexpr double kLeastGain = 1e-9;
// Each exchange adds weight, so there is an end; this bounds the time.
constexpr int kMaxExchanges = 64;

/// Tells which layers hang together.
class Components {
 public:
  bool join(const LayerKey& a, const LayerKey& b) {
    const LayerKey root_a = root(a), root_b = root(b);
    if (root_a == root_b) return false;
    parents_.insert_or_assign(std::max(root_a, root_b), std::min(root_a, root_b));
    return true;
  }

 private:
  [[nodiscard]] LayerKey root(const LayerKey& layer) const {
    const auto parent = parents_.find(layer);
    return parent == parents_.end() ? layer : root(parent->second);
  }
  std::map<LayerKey, LayerKey> parents_;
};

/// How far off an edge's error moves a point that hangs on its far end, and turns it.
Eigen::Matrix3d spread_at(const MergeEdge& edge, const Pose2& T_root_a,
                          const Eigen::Vector2d& p_root_m) {
  const Pose2 T_root_b = T_root_a * edge.T_a_b;
  const double c = std::cos(T_root_a.yaw_rad), s = std::sin(T_root_a.yaw_rad);
  const Eigen::Vector2d arm = p_root_m - T_root_b.translation();
  Eigen::Matrix3d jacobian;
  jacobian << c, -s, -arm.y(), s, c, arm.x(), 0, 0, 1;
  return jacobian * believed_covariance(edge) * jacobian.transpose();
}

SpanningForest grow(const EdgeMap& edges, std::vector<LayerPair> tree_edges) {
  SpanningForest forest;
  forest.edges = std::move(tree_edges);
  std::map<LayerKey, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < forest.edges.size(); ++i) {
    at[forest.edges[i].a].push_back(i);
    at[forest.edges[i].b].push_back(i);
  }
  for (const auto& [root, unused] : at) {
    if (!forest.places.try_emplace(root, SpanningForest::Place{{}, root, 0, 0}).second) continue;
    std::deque<LayerKey> waiting{root};
    for (; !waiting.empty(); waiting.pop_front()) {
      const LayerKey here = waiting.front();
      const auto place = forest.places.at(here);
      for (const std::size_t i : at.at(here)) {
        const LayerPair& pair = forest.edges[i];
        const Pose2& T_a_b = edges.at(pair).T_a_b;
        const bool forward = pair.a == here;
        const LayerKey& there = forward ? pair.b : pair.a;
        const Pose2 T_root_there = place.T_root_map * (forward ? T_a_b : T_a_b.inverse());
        if (forest.places
                .try_emplace(there, SpanningForest::Place{T_root_there, root, i, place.depth + 1})
                .second)
          waiting.push_back(there);
      }
    }
  }
  return forest;
}

ConsistentEdges judge(const EdgeMap& edges, std::vector<LayerPair> tree_edges) {
  ConsistentEdges judged;
  judged.forest = grow(edges, std::move(tree_edges));
  std::vector<LayerPair> in_forest = judged.forest.edges;
  std::sort(in_forest.begin(), in_forest.end());
  for (const auto& [pair, edge] : edges) {
    if (!std::binary_search(in_forest.begin(), in_forest.end(), pair)) {
      if (auto against = contradiction(pair, judged.forest, edges)) {
        judged.left_out.push_back(*std::move(against));
        continue;
      }
    }
    judged.chosen.push_back(pair);
    judged.weight += edge.quality;
  }
  return judged;
}

/// Kruskal: best quality first, ties by the pair's name.
std::vector<LayerPair> best_tree(const EdgeMap& edges) {
  std::vector<std::pair<double, LayerPair>> order;
  for (const auto& [pair, edge] : edges) order.emplace_back(-edge.quality, pair);
  std::sort(order.begin(), order.end());
  Components components;
  std::vector<LayerPair> tree;
  for (const auto& [quality, pair] : order) {
    if (components.join(pair.a, pair.b)) tree.push_back(pair);
  }
  return tree;
}

/// Gives one contradicting edge a place in the forest, if that adds weight: the heaviest edge that
/// can, for the one whose going adds weight first.
std::optional<ConsistentEdges> improve(const EdgeMap& edges, const ConsistentEdges& from) {
  std::vector<std::pair<double, const LayerPair*>> order;
  for (const Contradiction& out : from.left_out)
    order.emplace_back(-edges.at(out.pair).quality, &out.pair);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  for (const auto& [quality, enters] : order) {
    for (const LayerPair& leaves : from.forest.path(*enters)) {
      std::vector<LayerPair> tree = from.forest.edges;
      std::replace(tree.begin(), tree.end(), leaves, *enters);
      ConsistentEdges other = judge(edges, std::move(tree));
      if (other.weight > from.weight + kLeastGain) return other;
    }
  }
  return std::nullopt;
}

}  // namespace

Eigen::Matrix3d believed_covariance(const MergeEdge& edge) {
  // The middle of the overlap may lie elsewhere; what that does to the origin depends on the turn.
  const double c = std::cos(edge.T_a_b.yaw_rad), s = std::sin(edge.T_a_b.yaw_rad);
  const Eigen::Vector2d& centre = edge.overlap_centre_b_m;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = s * centre.x() + c * centre.y();
  jacobian(1, 2) = s * centre.y() - c * centre.x();
  const Eigen::Vector3d variances{kEdgeSigmaM * kEdgeSigmaM, kEdgeSigmaM * kEdgeSigmaM,
                                  kEdgeSigmaRad * kEdgeSigmaRad};
  return edge.covariance + jacobian * variances.asDiagonal() * jacobian.transpose();
}

std::vector<LayerPair> SpanningForest::path(const LayerPair& pair) const {
  std::vector<LayerPair> path;
  LayerKey x = pair.a, y = pair.b;
  while (x != y) {
    const Place &at_x = places.at(x), &at_y = places.at(y);
    LIFELINE_CHECK(at_x.root == at_y.root);
    LayerKey& deeper = at_x.depth >= at_y.depth ? x : y;
    const LayerPair& step = edges[places.at(deeper).to_parent];
    path.push_back(step);
    deeper = step.a == deeper ? step.b : step.a;
  }
  return path;
}

std::optional<Contradiction> contradiction(const LayerPair& pair, const SpanningForest& forest,
                                           const EdgeMap& edges) {
  const MergeEdge& edge = edges.at(pair);
  const Pose2& T_root_a = forest.places.at(pair.a).T_root_map;
  const Pose2& T_root_b = forest.places.at(pair.b).T_root_map;
  const Pose2 T_root_b_by_edge = T_root_a * edge.T_a_b;
  const Eigen::Vector2d p_root = T_root_b * edge.overlap_centre_b_m;
  Eigen::Vector3d error;
  error << T_root_b_by_edge * edge.overlap_centre_b_m - p_root,
      normalise_angle(T_root_b_by_edge.yaw_rad - T_root_b.yaw_rad);
  std::vector<LayerPair> path = forest.path(pair);
  Eigen::Matrix3d covariance = spread_at(edge, T_root_a, p_root);
  for (const LayerPair& step : path)
    covariance += spread_at(edges.at(step), forest.places.at(step.a).T_root_map, p_root);
  if (error.dot(covariance.inverse() * error) <= kMaxSquaredDistance) return std::nullopt;
  std::sort(path.begin(), path.end());
  return Contradiction{pair,
                       Contradiction::Why::outvoted,
                       std::move(path),
                       error.head<2>().norm(),
                       std::abs(error.z()),
                       0.0};
}

ConsistentEdges find_consistent_edges(const EdgeMap& edges) {
  ConsistentEdges found = judge(edges, best_tree(edges));
  for (int i = 0; i < kMaxExchanges; ++i) {
    auto better = improve(edges, found);
    if (!better) break;
    found = *std::move(better);
  }
  return found;
}

}  // namespace lifeline::merging
