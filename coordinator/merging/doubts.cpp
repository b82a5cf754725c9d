#include "coordinator/merging/doubts.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace lifeline::merging {
namespace {

using SetAside = std::map<LayerPair, Contradiction>;

bool connected_without(const std::vector<LayerPair>& edges, const LayerPair& left_out,
                       const LayerPair& ends) {
  std::set<LayerKey> reached{ends.a};
  for (bool grew = true; grew;) {
    grew = false;
    for (const LayerPair& pair : edges) {
      if (pair == left_out || reached.contains(pair.a) == reached.contains(pair.b)) continue;
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

/// The weakest edge between the ends that has nobody beside it.
std::optional<LayerPair> weakest_bridge(const EdgeMap& edges, const ConsistentEdges& consistent,
                                        const LayerPair& ends) {
  std::optional<LayerPair> weakest;
  for (const LayerPair& step : consistent.forest.path(ends)) {
    if (connected_without(consistent.chosen, step, ends)) continue;
    const double quality = edges.at(step).quality;
    if (!weakest || std::pair(quality, step) < std::pair(edges.at(*weakest).quality, *weakest))
      weakest = step;
  }
  return weakest;
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

bool set_aside_objected(const EdgeMap& edges, const ConsistentEdges& consistent,
                        const std::map<LayerPair, Objection>& objections, SetAside& set_aside) {
  for (const auto& [pair, objection] : objections) {
    if (!hang_together(consistent.forest, pair)) continue;
    const auto& places = consistent.forest.places;
    const Pose2 T_a_b = places.at(pair.a).T_root_map.inverse() * places.at(pair.b).T_root_map;
    if (!difference(T_a_b, objection.T_a_b, objection.centre_b_m).within(kSamePlaceM, kSameTurnRad))
      continue;
    const auto bridge = weakest_bridge(edges, consistent, pair);
    if (!bridge) continue;
    set_aside.emplace(
        *bridge,
        Contradiction{*bridge, Contradiction::Why::walls, {pair}, 0.0, 0.0, objection.conflict_m});
    return true;
  }
  return false;
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
