#include "common/wire/tile_planes.hpp"

#include <algorithm>

#include "common/base/check.hpp"

namespace lifeline::wire {
namespace {

constexpr int kOne = QuantisedCell::kTsdOne;
constexpr int kTsdModulus = 2 * kOne + 1;
constexpr unsigned kWeightModulus = QuantisedCell::kMaxWeight + 1;
static_assert(16 % kWeightModulus == 0, "two weights to an octet, and unsigned numbers wrap");

/// The cells that are known before (x, y) when going row by row from below.
struct Neighbours {
  QuantisedCell left, below, corner;  // unknown outside of the tile
};

Neighbours neighbours_of(const QuantisedTile& tile, std::size_t i) {
  const bool has_left = i % kTileSide != 0, has_below = i >= kTileSide;
  return {has_left ? tile[i - 1] : QuantisedCell{},
          has_below ? tile[i - kTileSide] : QuantisedCell{},
          has_left && has_below ? tile[i - kTileSide - 1] : QuantisedCell{}};
}

/// The median of left, below and the plane through all three: follows slopes, does not overshoot
/// at edges.
int median_prediction(int left, int below, int corner) {
  const auto [low, high] = std::minmax(left, below);
  return std::clamp(left + below - corner, low, high);
}

int predict_weight(const Neighbours& n) {
  return median_prediction(n.left.weight, n.below.weight, n.corner.weight);
}

int predict_tsd(const Neighbours& n) {
  const bool left = n.left.weight != 0, below = n.below.weight != 0, corner = n.corner.weight != 0;
  if (left && below && corner) return median_prediction(n.left.tsd, n.below.tsd, n.corner.tsd);
  if (left && below) return (n.left.tsd + n.below.tsd) / 2;
  if (left) return n.left.tsd;
  if (below) return n.below.tsd;
  return corner ? n.corner.tsd : kOne;
}

/// `difference` modulo kTsdModulus in [-kOne, kOne].
int wrap(int difference) {
  if (difference > kOne) return difference - kTsdModulus;
  return difference < -kOne ? difference + kTsdModulus : difference;
}

std::uint8_t fold(int difference) {
  return static_cast<std::uint8_t>(difference >= 0 ? 2 * difference : -2 * difference - 1);
}

int unfold(std::uint8_t octet) {
  return octet % 2 == 0 ? octet / 2 : -(octet + 1) / 2;
}

bool is_valid(QuantisedCell cell) {
  return cell.weight <= QuantisedCell::kMaxWeight && cell.tsd >= -kOne && cell.tsd <= kOne &&
         (cell.weight != 0 || cell.tsd == 0);
}

}  // namespace

TilePlanes to_planes(const QuantisedTile& tile) {
  TilePlanes planes;
  planes.weights.resize(TilePlanes::kWeightOctets);
  planes.free.resize(TilePlanes::kFreeOctets);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const QuantisedCell cell = tile[i];
    LIFELINE_CHECK(is_valid(cell));
    const Neighbours neighbours = neighbours_of(tile, i);
    const auto weight =
        static_cast<unsigned>(cell.weight - predict_weight(neighbours)) % kWeightModulus;
    planes.weights[i / 2] |= static_cast<std::uint8_t>(weight << (i % 2 * 4));
    if (cell.weight == 0) continue;
    if (cell.tsd == kOne) {
      planes.free[i / 8] |= static_cast<std::uint8_t>(1U << (i % 8));
    } else {
      planes.tsd.push_back(fold(wrap(cell.tsd - predict_tsd(neighbours))));
    }
  }
  return planes;
}

Result<QuantisedTile> from_planes(std::span<const std::uint8_t> weights,
                                  std::span<const std::uint8_t> free,
                                  std::span<const std::uint8_t> tsd) {
  if (weights.size() != TilePlanes::kWeightOctets || free.size() != TilePlanes::kFreeOctets) {
    return fail(ErrorCode::bad_data,
                "tile refused: planes of {} and {} octets instead of {} and {}", weights.size(),
                free.size(), TilePlanes::kWeightOctets, TilePlanes::kFreeOctets);
  }
  QuantisedTile tile{};
  std::size_t used = 0;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const Neighbours neighbours = neighbours_of(tile, i);
    const unsigned change = weights[i / 2] >> (i % 2 * 4);
    tile[i].weight = static_cast<std::uint8_t>(
        (change + static_cast<unsigned>(predict_weight(neighbours))) % kWeightModulus);
    const bool is_free = (free[i / 8] >> (i % 8) & 1U) != 0;
    if (tile[i].weight == 0) {
      if (is_free) return fail(ErrorCode::bad_data, "tile refused: cell {} is free but unknown", i);
      continue;
    }
    if (is_free) {
      tile[i].tsd = kOne;
      continue;
    }
    if (used == tsd.size()) {
      return fail(ErrorCode::bad_data, "tile refused: its distances end at cell {}", i);
    }
    const int value = wrap(predict_tsd(neighbours) + unfold(tsd[used]));
    if (tsd[used] >= kTsdModulus || value == kOne) {
      return fail(ErrorCode::bad_data, "tile refused: the distance of cell {} stands for no value",
                  i);
    }
    tile[i].tsd = static_cast<std::int8_t>(value);
    ++used;
  }
  if (used != tsd.size()) {
    return fail(ErrorCode::bad_data, "tile refused: {} distances too many", tsd.size() - used);
  }
  return tile;
}

}  // namespace lifeline::wire
