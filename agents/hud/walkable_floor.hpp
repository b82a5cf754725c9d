#pragma once

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "agents/hud/hud_map.hpp"

namespace lifeline::hud {

struct BlockHash {
  std::size_t operator()(CellIndex block) const {
    return std::hash<TileIndex>{}({block.x, block.y});
  }
};

/// Where one may walk, in blocks of a map: where a person fits, and where the trail says that one
/// did, however narrow it looks. Looks at the map for as long as it lives.
class WalkableFloor {
 public:
  /// `trail`: points in the map frame, metres, as they were walked.
  WalkableFloor(const HudMap& map, const std::vector<Eigen::Vector2d>& trail);

  [[nodiscard]] bool allows(CellIndex block) const;
  /// From a block to one beside it: side by side or, where no corner is cut, aslant; through narrow
  /// places as they were walked.
  [[nodiscard]] bool allows(CellIndex from, CellIndex to) const;
  /// Where a way goes through the block: where it was walked, or its middle.
  [[nodiscard]] Eigen::Vector2d point(CellIndex block) const;
  /// The nearest block that is allowed, at most a metre off.
  [[nodiscard]] std::optional<CellIndex> nearest(const Eigen::Vector2d& p_m) const;

 private:
  struct Walked {
    Eigen::Vector2d p_m;
    std::vector<CellIndex> on_to;  ///< blocks walked right before or after
  };
  [[nodiscard]] double block_size_m() const;
  [[nodiscard]] std::optional<Eigen::Vector2d> free_near(const Eigen::Vector2d& p_m) const;
  void add_walked(const Eigen::Vector2d& trail_m, std::optional<Eigen::Vector2d>& before_m);
  void join(CellIndex a, CellIndex b);

  const HudMap& map_;
  std::unordered_map<CellIndex, Walked, BlockHash> walked_;
};

}  // namespace lifeline::hud
