#include "common/wire/coarse_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace lifeline::wire {
namespace {

/// How far a distance may lie beyond each of the four bounds between the levels.
using Slack = std::array<int, 4>;
/// The largest distance that goes to each level but the last: half-way, sides kept apart.
constexpr std::array<int, 4> kUpTo = {-22, 0, 21, 79};
/// To stay where it is held. Little at the surface, whose place it tells; more in front of it.
constexpr Slack kStays = {8, 5, 8, 16};
/// To go with its neighbours: where the surface has no say.
constexpr Slack kJoins = {0, 0, 0, 16};

constexpr std::size_t kTop = kCoarseLevels.size() - 1;

bool fits(std::size_t level, int tsd, const Slack& slack) {
  if (level > 0 && tsd <= kUpTo[level - 1] - slack[level - 1]) return false;
  return level == kTop || tsd <= kUpTo[level] + slack[level];
}

std::optional<std::size_t> level_of(QuantisedCell cell) {
  const auto at = std::find(kCoarseLevels.begin(), kCoarseLevels.end(), cell.tsd);
  if (cell.weight == 0 || at == kCoarseLevels.end()) return std::nullopt;
  return static_cast<std::size_t>(at - kCoarseLevels.begin());
}

std::size_t nearest_level(int tsd) {
  return static_cast<std::size_t>(std::lower_bound(kUpTo.begin(), kUpTo.end(), tsd) -
                                  kUpTo.begin());
}

/// Goes through a tile row by row from below; what is done already is the neighbours'.
class Coarsening {
 public:
  Coarsening(const QuantisedTile& tile, const QuantisedTile* held) : tile_(tile), held_(held) {}

  QuantisedTile run() {
    for (int y = 0; y < kTileSide; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        const std::size_t i = offset_in_tile({x, y});
        if (tile_[i].weight == 0) continue;
        const QuantisedCell held = held_ == nullptr ? QuantisedCell{} : (*held_)[i];
        done_[i] = {static_cast<std::int8_t>(kCoarseLevels[level(x, y, tile_[i].tsd, held)]),
                    static_cast<std::uint8_t>(is_well_seen(x, y, held) ? kWellSeen : kThin)};
      }
    }
    return done_;
  }

 private:
  [[nodiscard]] QuantisedCell done(int x, int y) const {
    if (x < 0 || y < 0 || x >= kTileSide) return {};
    return done_[offset_in_tile({x, y})];
  }

  /// What the cells before it let expect; the median of left, below and left + below - corner.
  [[nodiscard]] std::size_t expected(int x, int y) const {
    const auto left = level_of(done(x - 1, y)), below = level_of(done(x, y - 1)),
               corner = level_of(done(x - 1, y - 1));
    if (left && below && corner) {
      const auto [low, high] = std::minmax(*left, *below);
      return std::clamp(*left + *below, low + *corner, high + *corner) - *corner;
    }
    if (left && below) return (*left + *below + 1) / 2;
    return left.value_or(below.value_or(corner.value_or(kTop)));
  }

  [[nodiscard]] std::size_t level(int x, int y, int tsd, QuantisedCell held) const {
    if (const auto kept = level_of(held); kept && fits(*kept, tsd, kStays)) return *kept;
    const std::size_t joined = expected(x, y);
    return fits(joined, tsd, kJoins) ? joined : nearest_level(tsd);
  }

  /// By the mean weight of the known cells of the 5 x 5 around: from 2.5 on; below 1.5 not (below
  /// 1, where it is held so); between, as it is held or as most of the cells before it are.
  [[nodiscard]] bool is_well_seen(int x, int y, QuantisedCell held) const {
    int sum = 0, known = 0;
    for (int row = std::max(0, y - 2); row <= std::min(kTileSide - 1, y + 2); ++row) {
      for (int column = std::max(0, x - 2); column <= std::min(kTileSide - 1, x + 2); ++column) {
        const int weight = tile_[offset_in_tile({column, row})].weight;
        sum += weight;
        known += weight != 0 ? 1 : 0;
      }
    }
    if (2 * sum >= 5 * known) return true;
    if (held.weight == kWellSeen && sum >= known) return true;
    if (2 * sum < 3 * known || held.weight == kThin) return false;
    int balance = 0;
    for (const QuantisedCell cell :
         {done(x - 1, y), done(x, y - 1), done(x + 1, y - 1), done(x - 1, y - 1)}) {
      balance += cell.weight == kWellSeen ? 1 : cell.weight == kThin ? -1 : 0;
    }
    return balance != 0 ? balance > 0 : sum >= 2 * known;
  }

  const QuantisedTile& tile_;
  const QuantisedTile* held_;
  QuantisedTile done_{};
};

}  // namespace

bool is_coarse(const QuantisedTile& tile) {
  return std::all_of(tile.begin(), tile.end(), [](QuantisedCell cell) {
    if (cell.weight == 0) return cell.tsd == 0;
    return (cell.weight == kThin || cell.weight == kWellSeen) && level_of(cell).has_value();
  });
}

QuantisedTile coarse(const QuantisedTile& tile, const QuantisedTile* held) {
  return Coarsening(tile, held).run();
}

}  // namespace lifeline::wire
