#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/base/ids.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::merging {

/// Two layers, the smaller key first.
struct LayerPair {
  LayerKey a;
  LayerKey b;
  auto operator<=>(const LayerPair&) const = default;
};

/// An accepted merge of two layers: the paper's T_G.
struct MergeEdge {
  Pose2 T_a_b;                 ///< takes b's coordinates to a's
  Eigen::Matrix3d covariance;  ///< of T_a_b, x y yaw
  double quality = 0.0;  ///< in [0, 1]; the better edge wins where edges contradict each other
};

/// A layer's place in its group's common frame.
struct Membership {
  LayerKey layer;
  Pose2 T_common_map;
  Eigen::Matrix3d covariance;  ///< of T_common_map, grown along the edges from the lead
  double quality = 1.0;        ///< of the weakest edge on the way to the lead
};

/// Layers that hang together; the first is the lead and its map frame is the common frame.
using MergeGroup = std::vector<Membership>;

/// An edge that no group can follow, because better edges say otherwise.
struct Contradiction {
  LayerPair pair;
  double distance_m = 0.0;
  double angle_rad = 0.0;
};

struct MergePlan {
  std::vector<MergeGroup> groups;  ///< of two or more layers, the largest first, then by lead
  std::vector<Contradiction> contradictions;
};

/// The accepted merges between all layers. Plain data and a pure plan(): one owner, not
/// thread-safe.
class MergeGraph {
 public:
  /// Sets or replaces the edge of a pair.
  void set_edge(const LayerPair& pair, const MergeEdge& edge) { edges_[pair] = edge; }
  void withdraw(const LayerPair& pair) { edges_.erase(pair); }
  [[nodiscard]] const std::map<LayerPair, MergeEdge>& edges() const { return edges_; }

  /// Groups along the best spanning forest of the edges. The lead of a group is its first layer in
  /// the order of keys, so that it does not depend on who came first. Edges outside of the forest
  /// must agree with it within `max_distance_m` and `max_angle_rad`, else they are named.
  [[nodiscard]] MergePlan plan(double max_distance_m = 0.5, double max_angle_rad = 0.05) const;

 private:
  std::map<LayerPair, MergeEdge> edges_;
};

}  // namespace lifeline::merging
