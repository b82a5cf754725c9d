#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::merging {

/// What a match may be off beyond what its covariance says: the walls that it looked at may be bent
/// or coarse.
inline constexpr double kEdgeSigmaM = 0.05;
inline constexpr double kEdgeSigmaRad = 0.004;
/// Squared distance in standard deviations (three dimensions) beyond which edges contradict each
/// other: one right cycle in a thousand.
inline constexpr double kMaxSquaredDistance = 16.3;

/// Covariance of T_a_b with what a match may be off besides, at the middle of its overlap.
[[nodiscard]] Eigen::Matrix3d believed_covariance(const MergeEdge& edge);

/// A set of edges without cycles, and where it puts each layer.
struct SpanningForest {
  struct Place {
    Pose2 T_root_map;
    LayerKey root;
    std::size_t to_parent = 0;  ///< which of `edges`; of no meaning for the root itself
    int depth = 0;
  };
  std::vector<LayerPair> edges;
  std::map<LayerKey, Place> places;

  /// The edges between two layers of one tree.
  [[nodiscard]] std::vector<LayerPair> path(const LayerPair& pair) const;
};

struct ConsistentEdges {
  std::vector<LayerPair> chosen;  ///< agree with each other; the forest's edges among them
  SpanningForest forest;
  std::vector<Contradiction> left_out;  ///< each contradicts the chosen ones
  double weight = 0.0;                  ///< sum of the chosen edges' qualities
};

/// How an edge contradicts a forest that holds both its layers in one tree; nothing where it
/// agrees.
[[nodiscard]] std::optional<Contradiction> contradiction(const LayerPair& pair,
                                                         const SpanningForest& forest,
                                                         const EdgeMap& edges);

/// The heaviest set of edges that agree round every cycle: the best spanning forest and all edges
/// that agree with it, improved by exchanging edges as long as that adds weight.
[[nodiscard]] ConsistentEdges find_consistent_edges(const EdgeMap& edges);

}  // namespace lifeline::merging
