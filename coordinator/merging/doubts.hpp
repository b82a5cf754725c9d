#pragma once

#include <map>
#include <vector>

#include "coordinator/merging/consistent_edges.hpp"

namespace lifeline::merging {

/// An edge that nothing seconds is followed against a contradicting one only where this many times
/// as much wall speaks for it.
inline constexpr double kClearlyMore = 4.0;

struct FollowedEdges {
  ConsistentEdges consistent;
  std::vector<Contradiction> contradictions;  ///< of all edges that are not followed, by pair
};

/// The edges that may be followed. An edge that no cycle confirms holds a member by its word alone:
/// where another edge or the walls of another pair speak against it, neither is followed until a
/// third decides.
[[nodiscard]] FollowedEdges find_followed_edges(const EdgeMap& edges,
                                                const std::map<LayerPair, Objection>& objections);

}  // namespace lifeline::merging
