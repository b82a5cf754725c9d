#include "coordinator/merging/merge_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "coordinator/merging/doubts.hpp"
#include "coordinator/merging/refine_places.hpp"

namespace lifeline::merging {
namespace {

constexpr std::size_t kMaxReason = 256;
constexpr std::size_t kMostNamed = 3;  // edges that a sentence names

LayerKey choose_lead(const std::set<LayerKey>& members, const std::vector<LayerKey>& leads) {
  for (const LayerKey& lead : leads) {
    if (members.contains(lead)) return lead;
  }
  return *members.begin();
}

/// The edges of one group between its members by number.
std::vector<PlaceEdge> edges_of(const EdgeMap& edges, const std::vector<LayerPair>& chosen,
                                const MergeGroup& group) {
  std::map<LayerKey, std::size_t> number;
  for (std::size_t i = 0; i < group.size(); ++i) number.emplace(group[i].layer, i);
  std::vector<PlaceEdge> between;
  for (const LayerPair& pair : chosen) {
    if (!number.contains(pair.a)) continue;
    const MergeEdge& edge = edges.at(pair);
    between.push_back(
        {number.at(pair.a), number.at(pair.b), edge.T_a_b, believed_covariance(edge)});
  }
  return between;
}

MergeGroup place_group(const EdgeMap& edges, const ConsistentEdges& consistent,
                       const std::set<LayerKey>& members, const LayerKey& lead) {
  const auto& places = consistent.forest.places;
  const Pose2 T_lead_root = places.at(lead).T_root_map.inverse();
  MergeGroup group{{lead, {}, Eigen::Matrix3d::Zero(), 1.0}};
  for (const LayerKey& layer : members) {
    if (layer == lead) continue;
    double quality = 0.0;
    for (const LayerPair& pair : consistent.chosen) {
      if (pair.a == layer || pair.b == layer) quality = std::max(quality, edges.at(pair).quality);
    }
    group.push_back(
        {layer, T_lead_root * places.at(layer).T_root_map, Eigen::Matrix3d::Zero(), quality});
  }
  std::vector<Pose2> start;
  for (const Membership& member : group) start.push_back(member.T_common_map);
  const RefinedPlaces refined = refine_places(start, edges_of(edges, consistent.chosen, group));
  for (std::size_t i = 1; i < group.size(); ++i) {
    group[i].T_common_map = refined.T_common_map[i];
    group[i].covariance = refined.covariance[i];
  }
  return group;
}

std::string join(const std::vector<LayerPair>& pairs) {
  std::string text;
  const std::size_t named = std::min(pairs.size(), kMostNamed);
  for (std::size_t i = 0; i < named; ++i) {
    const bool last = i + 1 == named && named == pairs.size();
    if (i > 0) text += last ? " and " : ", ";
    text += describe(pairs[i]);
  }
  if (pairs.size() > named) text += fmt::format(" and {} more", pairs.size() - named);
  return text;
}

std::string name(const LayerKey& layer) {
  return layer.map_id.value == 1 && layer.floor.value == 0 ? layer.agent_id.text()
                                                           : to_string(layer);
}

}  // namespace

std::string describe(const LayerPair& pair) {
  return name(pair.a) + "-" + name(pair.b);
}

std::string describe(const Contradiction& contradiction) {
  const PlaceDifference off{contradiction.distance_m, contradiction.angle_rad};
  const std::string figures = fmt::format("{:.1f} m, {:.0f} deg", off.distance_m, off.angle_deg());
  const std::string others = join(contradiction.against);
  std::string text;
  switch (contradiction.why) {
    case Contradiction::Why::outvoted:
      text = fmt::format("contradicts {} by {}", others, figures);
      break;
    case Contradiction::Why::in_doubt:
      text = fmt::format("contradicts {} by {}, and no third match decides between them", others,
                         figures);
      break;
    case Contradiction::Why::walls:
      text = fmt::format("would lay {} so that {:.1f} m of wall contradict", others,
                         contradiction.conflict_m);
      break;
  }
  return text.substr(0, kMaxReason);
}

std::optional<Pose2> MergePlan::T_a_b(const LayerPair& pair) const {
  for (const MergeGroup& group : groups) {
    const auto find = [&](const LayerKey& layer) {
      return std::find_if(group.begin(), group.end(),
                          [&](const Membership& member) { return member.layer == layer; });
    };
    const auto a = find(pair.a), b = find(pair.b);
    if (a != group.end() && b != group.end()) return a->T_common_map.inverse() * b->T_common_map;
  }
  return std::nullopt;
}

std::optional<std::size_t> MergePlan::group_of(const LayerKey& layer) const {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const Membership& member : groups[i]) {
      if (member.layer == layer) return i;
    }
  }
  return std::nullopt;
}

const Contradiction* MergePlan::find(const LayerPair& pair) const {
  const auto found = std::find_if(contradictions.begin(), contradictions.end(),
                                  [&](const auto& other) { return other.pair == pair; });
  return found == contradictions.end() ? nullptr : &*found;
}

const MergeEdge* MergeGraph::edge(const LayerPair& pair) const {
  const auto found = edges_.find(pair);
  return found == edges_.end() ? nullptr : &found->second;
}

const Objection* MergeGraph::objection(const LayerPair& pair) const {
  const auto found = objections_.find(pair);
  return found == objections_.end() ? nullptr : &found->second;
}

MergePlan MergeGraph::plan(const std::vector<LayerKey>& leads) const {
  FollowedEdges followed = find_followed_edges(edges_, objections_);
  std::map<LayerKey, std::set<LayerKey>> members;  // by root
  for (const auto& [layer, place] : followed.consistent.forest.places)
    members[place.root].insert(layer);
  MergePlan plan;
  plan.contradictions = std::move(followed.contradictions);
  for (const auto& [root, layers] : members) {
    plan.groups.push_back(
        place_group(edges_, followed.consistent, layers, choose_lead(layers, leads)));
  }
  std::stable_sort(
      plan.groups.begin(), plan.groups.end(), [](const MergeGroup& x, const MergeGroup& y) {
        return std::pair(y.size(), x.front().layer) < std::pair(x.size(), y.front().layer);
      });
  return plan;
}

}  // namespace lifeline::merging
