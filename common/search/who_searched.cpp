#include "common/search/who_searched.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/sharing/fixed_transform.hpp"

namespace lifeline::search {
namespace {

// A square counts once half of its cells are known.
template <typename Tile>
bool is_seen(const Tile& tile, int column, int row) {
  constexpr int kFine = WhoSearched::kWhoFine;
  int known = 0;
  for (int y = row * kFine; y < (row + 1) * kFine; ++y) {
    for (int x = column * kFine; x < (column + 1) * kFine; ++x)
      known += tile[static_cast<std::size_t>(y * kTileSide + x)].weight > 0 ? 1 : 0;
  }
  return 2 * known >= kFine * kFine;
}

std::size_t square_of(int column, int row) {
  return static_cast<std::size_t>(row * WhoSearched::kSide + column);
}

}  // namespace

void WhoSearched::note(const LayerKey& layer, TileIndex tile, const QuantisedTile& cells) {
  ++now_;
  Firsts& firsts = firsts_[layer][tile];
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      std::uint32_t& first = firsts[square_of(column, row)];
      const bool seen = is_seen(cells, column, row);
      if (!seen) first = 0;  // a corrected layer moved
      if (seen && first == 0) first = now_;
    }
  }
}

bool WhoSearched::place(const std::vector<sharing::Placement>& placements) {
  if (placements == placements_) return false;
  placements_ = placements;
  placed_.clear();
  for (const auto& [layer, T_common_layer] : placements_) {
    const std::string& id = layer.agent_id.text();
    auto helmet = std::ranges::find(helmets_, id);
    if (helmet == helmets_.end()) {
      if (helmets_.size() >= kMostHelmets) continue;
      helmet = helmets_.insert(helmet, id);
    }
    placed_.push_back({static_cast<std::size_t>(helmet - helmets_.begin()), &firsts_[layer],
                       sharing::to_pose(T_common_layer).inverse()});
  }
  owners_.clear();
  seen_by_.clear();
  return true;
}

std::uint32_t WhoSearched::first_seen(const Placed& placed, const Eigen::Vector2d& p) const {
  const Eigen::Vector2d at = (placed.T_layer_common * p) / square_m_;
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  static_assert(kSide == 8, "squares are shifted by 3");
  const auto tile = placed.firsts->find({x >> 3, y >> 3});
  return tile == placed.firsts->end() ? 0 : tile->second[square_of(x & 7, y & 7)];
}

void WhoSearched::refresh(TileIndex tile, const sharing::FusedTile* cells) {
  if (cells == nullptr) {
    owners_.erase(tile);
    seen_by_.erase(tile);
    return;
  }
  Owners& owners = owners_[tile];
  auto& seen_by = seen_by_[tile];
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const std::size_t square = square_of(column, row);
      owners[square] = 0;
      seen_by[square] = 0;
      if (!is_seen(*cells, column, row)) continue;
      const Eigen::Vector2d p((tile.x * kSide + column + 0.5) * square_m_,
                              (tile.y * kSide + row + 0.5) * square_m_);
      std::uint32_t first = 0;
      for (const Placed& placed : placed_) {
        const std::uint32_t at = first_seen(placed, p);
        if (at == 0) continue;
        seen_by[square] |= std::uint64_t{1} << placed.helmet;
        if (first != 0 && at >= first) continue;
        first = at;
        owners[square] = static_cast<std::uint8_t>(placed.helmet + 1);
      }
    }
  }
}

std::vector<SearchShare> WhoSearched::shares() const {
  const double square_m2 = square_m_ * square_m_;
  std::vector<SearchShare> shares;
  for (const std::string& id : helmets_) shares.push_back({id});
  for (const auto& [tile, owners] : owners_) {
    for (const std::uint8_t owner : owners)
      if (owner > 0) shares[owner - 1U].first_m2 += square_m2;
  }
  for (const auto& [tile, seen_by] : seen_by_) {
    for (std::uint64_t bits : seen_by) {
      for (; bits != 0; bits &= bits - 1)
        shares[static_cast<std::size_t>(std::countr_zero(bits))].seen_m2 += square_m2;
    }
  }
  return shares;
}

double WhoSearched::searched_m2() const {
  std::size_t squares = 0;
  for (const auto& [tile, owners] : owners_)
    squares +=
        static_cast<std::size_t>(std::ranges::count_if(owners, [](auto o) { return o > 0; }));
  return static_cast<double>(squares) * square_m_ * square_m_;
}

}  // namespace lifeline::search
