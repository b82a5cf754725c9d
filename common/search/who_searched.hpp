#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/sharing/fused_map.hpp"

namespace lifeline::search {

/// What a helmet has searched of the common map.
struct SearchShare {
  std::string id;
  double first_m2 = 0.0;  ///< that it was the first to see
  double seen_m2 = 0.0;   ///< that it saw at all
};

/// Which helmet saw which place of the common map, and which saw it first: out of everybody's own
/// layers, in the order in which their tiles came. In squares of kWhoFine cells. A merge that is
/// corrected or withdrawn leaves no trace. One owner, not thread-safe.
class WhoSearched {
 public:
  static constexpr int kWhoFine = 8;
  static constexpr int kSide = kTileSide / kWhoFine;
  static constexpr int kSquares = kSide * kSide;
  /// Of each square, row by row from below: the helmet's place in helmets() and 1 more; 0: nobody.
  using Owners = std::array<std::uint8_t, kSquares>;

  explicit WhoSearched(double map_cell_m) : square_m_(map_cell_m * kWhoFine) {}

  /// A tile of a helmet's layer as it is now: what is new in it was seen now.
  void note(const LayerKey& layer, TileIndex tile, const QuantisedTile& cells);
  /// Where the layers lie. True: everything is to be refreshed.
  bool place(const std::vector<sharing::Placement>& placements);
  /// A tile of the common map changed; nullptr: it is no more. After note() of what made it.
  void refresh(TileIndex tile, const sharing::FusedTile* cells);

  [[nodiscard]] const std::map<TileIndex, Owners>& owners() const { return owners_; }
  /// In the order in which they were first placed.
  [[nodiscard]] const std::vector<std::string>& helmets() const { return helmets_; }
  /// In the order of helmets().
  [[nodiscard]] std::vector<SearchShare> shares() const;
  /// Of the squares that anybody saw.
  [[nodiscard]] double searched_m2() const;

 private:
  static constexpr std::size_t kMostHelmets = 64;
  using Firsts = std::array<std::uint32_t, kSquares>;  ///< when it was first seen; 0: never
  struct Placed {
    std::size_t helmet;
    const std::unordered_map<TileIndex, Firsts>* firsts;
    Pose2 T_layer_common;
  };
  [[nodiscard]] std::uint32_t first_seen(const Placed& placed, const Eigen::Vector2d& p) const;

  double square_m_;
  std::uint32_t now_ = 0;
  std::map<LayerKey, std::unordered_map<TileIndex, Firsts>> firsts_;
  std::vector<sharing::Placement> placements_;
  std::vector<Placed> placed_;
  std::vector<std::string> helmets_;
  std::map<TileIndex, Owners> owners_;
  std::map<TileIndex, std::array<std::uint64_t, kSquares>> seen_by_;  ///< a bit for each helmet
};

}  // namespace lifeline::search
