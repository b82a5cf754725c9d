#include "coordinator/merging/doubts.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace lifeline::merging {
namespace {

using SetAside = std::map<LayerPair, Contradiction>;

bool connected(const std::vector<LayerPair>& edges, const LayerPair& ends) {
  std::set<LayerKey> reached{ends.a};
  for (bool grew = true; grew;) {
    grew = false;
    for (const LayerPair& pair : edges) {
      if (reached.contains(pair.a) == reached.contains(pair.b)) continue;
      reached.insert(pair.a);
      reached.insert(pair.b);
      grew = true;
    }
  }
  return reached.contains(ends.b);
}

bool hang_together(const SpanningForest& forest, const LayerPair& pair) {
  const auto a = forest.places.find(pair.a), b = forest.places.find(pair.b);
  return a != forest.places.end() && b != forest.places.end() && a->second.root == b->second.root;
}

/// The edges between the ends that have nobody beside them.
std::vector<LayerPair> bridges(const ConsistentEdges& consistent, const LayerPair& ends) {
  std::vector<LayerPair> alone = consistent.forest.path(ends);
  std::erase_if(alone, [&](const LayerPair& step) {
    std::vector<LayerPair> others = consistent.chosen;
    std::erase(others, step);
    return connected(others, ends);
  });
  return alone;
}

std::optional<LayerPair> weakest_bridge(const EdgeMap& edges, const ConsistentEdges& consistent,
                                        const LayerPair& ends) {
  const auto alone = bridges(consistent, ends);
  const auto weakest =
      std::min_element(alone.begin(), alone.end(), [&](const LayerPair& x, const LayerPair& y) {
        return std::pair(edges.at(x).quality, x) < std::pair(edges.at(y).quality, y);
      });
  return weakest == alone.end() ? std::nullopt : std::optional(*weakest);
}

/// In metres of wall, up to a constant: quality is wall / (wall + constant).
double wall(double quality) {
  return quality / std::max(1e-6, 1.0 - quality);
}

/// An edge that says otherwise, heaviest first: those left out now, and those set aside before.
std::vector<Contradiction> witnesses(const EdgeMap& edges, const ConsistentEdges& consistent,
                                     const SetAside& set_aside) {
  std::vector<Contradiction> all = consistent.left_out;
  for (const auto& [pair, unused] : set_aside) {
    if (!hang_together(consistent.forest, pair)) continue;
    if (auto against = contradiction(pair, consistent.forest, edges))
      all.push_back(*std::move(against));
  }
  std::stable_sort(all.begin(), all.end(), [&](const auto& x, const auto& y) {
    return edges.at(x.pair).quality > edges.at(y.pair).quality;
  });
  return all;
}

bool set_aside_contradicted(const EdgeMap& edges, const ConsistentEdges& consistent,
                            SetAside& set_aside) {
  for (Contradiction against : witnesses(edges, consistent, set_aside)) {
    const auto bridge = weakest_bridge(edges, consistent, against.pair);
    if (!bridge ||
        wall(edges.at(*bridge).quality) >= kClearlyMore * wall(edges.at(against.pair).quality)) {
      continue;
    }
    against.why = Contradiction::Why::in_doubt;
    const LayerPair other = std::exchange(against.pair, *bridge);
    against.against = {other};
    set_aside.emplace(*bridge, against);
    std::swap(against.pair, against.against.front());
    set_aside.emplace(other, against);
    return true;
  }
  return false;
}

using Objections = std::map<LayerPair, Objection>;

/// Objections to where the forest lays two layers; others speak of places that nobody follows.
std::vector<LayerPair> standing(const Objections& objections, const SpanningForest& forest) {
  std::vector<LayerPair> pairs;
  for (const auto& [pair, objection] : objections) {
    if (!hang_together(forest, pair)) continue;
    const Pose2 T_a_b =
        forest.places.at(pair.a).T_root_map.inverse() * forest.places.at(pair.b).T_root_map;
    if (difference(T_a_b, objection.T_a_b, objection.centre_b_m).within(kSamePlaceM, kSameTurnRad))
      pairs.push_back(pair);
  }
  return pairs;
}

/// Edges that may be set aside together, so that some objections fall.
struct Cut {
  std::vector<LayerPair> edges;
  LayerPair objection;    ///< one of those that fall
  double resolved = 0.0;  ///< how many fall; a doubted edge that goes with them counts half
  double lost = 0.0;      ///< quality of the edges that nobody doubts

  [[nodiscard]] bool better_than(const Cut& other) const {
    return resolved > other.resolved || (resolved == other.resolved && lost < other.lost);
  }
};

Cut weigh(const EdgeMap& edges, const ConsistentEdges& consistent,
          const std::vector<LayerPair>& objected, std::vector<LayerPair> cut_edges) {
  Cut cut{std::move(cut_edges), objected.front(), 0.0, 0.0};
  std::vector<LayerPair> left = consistent.chosen;
  for (const LayerPair& pair : cut.edges) {
    std::erase(left, pair);
    const MergeEdge& edge = edges.at(pair);
    cut.resolved += edge.doubted ? 0.5 : 0.0;
    cut.lost += edge.doubted ? 0.0 : edge.quality;
  }
  for (const LayerPair& pair : objected) {
    if (connected(left, pair)) continue;
    cut.objection = pair;
    cut.resolved += 1.0;
  }
  return cut;
}

/// All edges at `layer`, if at least as many others object to it as hold it without doubt.
std::vector<LayerPair> edges_to_part(const EdgeMap& edges, const ConsistentEdges& consistent,
                                     const std::vector<LayerPair>& objected,
                                     const LayerKey& layer) {
  const auto touches = [&](const LayerPair& pair) { return pair.a == layer || pair.b == layer; };
  std::vector<LayerPair> at;
  std::copy_if(consistent.chosen.begin(), consistent.chosen.end(), std::back_inserter(at), touches);
  const auto holding = std::count_if(
      at.begin(), at.end(), [&](const LayerPair& pair) { return !edges.at(pair).doubted; });
  const auto objecting = std::count_if(objected.begin(), objected.end(), touches);
  return holding <= objecting ? at : std::vector<LayerPair>{};
}

bool set_aside_objected(const EdgeMap& edges, const ConsistentEdges& consistent,
                        const Objections& objections, SetAside& set_aside) {
  const std::vector<LayerPair> objected = standing(objections, consistent.forest);
  std::optional<Cut> best;
  const auto consider = [&](std::vector<LayerPair> cut_edges) {
    if (cut_edges.empty()) return;
    const Cut cut = weigh(edges, consistent, objected, std::move(cut_edges));
    if (!best || cut.better_than(*best)) best = cut;
  };
  for (const LayerPair& pair : objected) {
    for (const LayerPair& bridge : bridges(consistent, pair)) consider({bridge});
    for (const LayerKey& layer : {pair.a, pair.b})
      consider(edges_to_part(edges, consistent, objected, layer));
  }
  if (!best) return false;
  for (const LayerPair& pair : best->edges) {
    set_aside.emplace(pair, Contradiction{pair,
                                          Contradiction::Why::walls,
                                          {best->objection},
                                          0.0,
                                          0.0,
                                          objections.at(best->objection).conflict_m});
  }
  return true;
}

}  // namespace

FollowedEdges find_followed_edges(const EdgeMap& edges,
                                  const std::map<LayerPair, Objection>& objections) {
  SetAside set_aside;
  for (;;) {  // each round sets an edge aside
    EdgeMap left;
    for (const auto& [pair, edge] : edges) {
      if (!set_aside.contains(pair)) left.emplace(pair, edge);
    }
    FollowedEdges followed{find_consistent_edges(left), {}};
    if (set_aside_contradicted(edges, followed.consistent, set_aside) ||
        set_aside_objected(edges, followed.consistent, objections, set_aside)) {
      continue;
    }
    for (const auto& out : followed.consistent.left_out) set_aside.emplace(out.pair, out);
    for (auto& [pair, why] : set_aside) followed.contradictions.push_back(std::move(why));
    return followed;
  }
}

}  // namespace lifeline::merging
