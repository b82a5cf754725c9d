#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/base/ids.hpp"
#include "common/grid/pose2.hpp"
#include "coordinator/merging/place_difference.hpp"

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
  double quality = 0.0;        ///< in [0, 1]: what it weighs where edges contradict each other
  Eigen::Vector2d overlap_centre_b_m{0.0, 0.0};  ///< middle of the agreeing wall, in b's frame
  bool doubted = false;  ///< followed still, but its last match spoke against it
  bool by_hand = false;  ///< a person accepted it: no match takes it away again
};

using EdgeMap = std::map<LayerPair, MergeEdge>;

/// Two layers whose walls contradict each other where a group laid them, measured there.
struct Objection {
  Pose2 T_a_b;
  Eigen::Vector2d centre_b_m{0.0, 0.0};
  double conflict = 0.0;    ///< share of the jointly seen wall
  double conflict_m = 0.0;  ///< the same as a length
};

/// A layer's place in its group's common frame.
struct Membership {
  LayerKey layer;
  Pose2 T_common_map;
  Eigen::Matrix3d covariance;  ///< of T_common_map; zero for the lead
  double quality = 1.0;        ///< of the best edge that holds it; 1 for the lead
};

/// Layers that hang together; the first is the lead and its map frame is the common frame.
using MergeGroup = std::vector<Membership>;

/// An accepted edge that no group follows, and why.
struct Contradiction {
  enum class Why {
    outvoted,  ///< the edges `against` hold each other and say otherwise
    in_doubt,  ///< it and `against` cannot all be right, and nothing decides between them
    walls,     ///< followed, it would lay the pair `against` so that their walls contradict
  };
  LayerPair pair;
  Why why = Why::outvoted;
  std::vector<LayerPair> against;  ///< not empty
  double distance_m = 0.0;
  double angle_rad = 0.0;
  double conflict_m = 0.0;  ///< contradicting wall, for `walls` alone
};

/// For people, at most 256 characters: "contradicts alpha-beta and beta-gamma by 1.2 m, 4 deg".
[[nodiscard]] std::string describe(const Contradiction& contradiction);
/// "alpha-beta"; with map numbers where they are not 1.
[[nodiscard]] std::string describe(const LayerPair& pair);

struct MergePlan {
  std::vector<MergeGroup> groups;  ///< of two or more layers, the largest first, then by lead
  std::vector<Contradiction> contradictions;  ///< by pair

  /// Where the plan lays b on a; nothing where they are in no common group.
  [[nodiscard]] std::optional<Pose2> T_a_b(const LayerPair& pair) const;
  [[nodiscard]] const Contradiction* find(const LayerPair& pair) const;
  /// Which of `groups` a layer is in; nothing where it is in none.
  [[nodiscard]] std::optional<std::size_t> group_of(const LayerKey& layer) const;
};

/// The accepted merges between all layers. Plain data and a pure plan(): one owner, not
/// thread-safe.
class MergeGraph {
 public:
  /// Sets or replaces the edge of a pair.
  void set_edge(const LayerPair& pair, const MergeEdge& edge) { edges_[pair] = edge; }
  void withdraw(const LayerPair& pair) { edges_.erase(pair); }
  /// The pair must have an edge.
  void set_doubted(const LayerPair& pair, bool doubted) { edges_.at(pair).doubted = doubted; }
  /// nullptr where the pair has none.
  [[nodiscard]] const MergeEdge* edge(const LayerPair& pair) const;
  [[nodiscard]] const EdgeMap& edges() const { return edges_; }

  void object(const LayerPair& pair, const Objection& objection) { objections_[pair] = objection; }
  void lift_objection(const LayerPair& pair) { objections_.erase(pair); }
  /// nullptr where there is none.
  [[nodiscard]] const Objection* objection(const LayerPair& pair) const;

  /// Groups along the heaviest set of edges that agree with each other (docs/decisions/0007), each
  /// member placed by all of its group's edges at once. A group keeps the first of `leads` that is
  /// in it; else its first layer in the order of keys leads.
  [[nodiscard]] MergePlan plan(const std::vector<LayerKey>& leads = {}) const;

 private:
  EdgeMap edges_;
  std::map<LayerPair, Objection> objections_;
};

}  // namespace lifeline::merging
