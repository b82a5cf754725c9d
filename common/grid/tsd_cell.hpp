#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/grid/tile_index.hpp"

namespace lifeline {

/// One cell of a TSD grid, packed. tsd is the signed distance to the nearest seen surface in units
/// of truncation / kTsdOne: positive on the free side, 0 on the surface. weight is W of Eq. 3 in
/// units of 1 / kWeightOne; weight 0 means unknown, and then tsd is 0.
struct TsdCell {
  std::int16_t tsd = 0;
  std::uint16_t weight = 0;

  static constexpr int kTsdOne = 32000;
  static constexpr int kWeightOne = 64;

  [[nodiscard]] constexpr bool known() const { return weight != 0; }
  /// Signed distance in [-1, 1] of the truncation distance.
  [[nodiscard]] float value() const { return static_cast<float>(tsd) * (1.0F / kTsdOne); }
  [[nodiscard]] float weight_value() const {
    return static_cast<float>(weight) * (1.0F / kWeightOne);
  }
  bool operator==(const TsdCell&) const = default;
};

using TsdTile = std::array<TsdCell, kTileCells>;

/// A cell as it is published: what every machine fuses. tsd in [-127, 127] of the truncation
/// distance, weight in [0, 15] steps of kWeightStep (in units of TsdCell::weight); weight 0 means
/// unknown, and then tsd is 0.
struct QuantisedCell {
  std::int8_t tsd = 0;
  std::uint8_t weight = 0;

  static constexpr int kTsdOne = 127;
  static constexpr int kMaxWeight = 15;
  static constexpr int kWeightStep = 2 * TsdCell::kWeightOne;
  bool operator==(const QuantisedCell&) const = default;
};

using QuantisedTile = std::array<QuantisedCell, kTileCells>;

/// Rounds to the published precision; a known cell stays known.
[[nodiscard]] constexpr QuantisedCell quantise(TsdCell cell) {
  if (!cell.known()) return {};
  const int scaled = cell.tsd * QuantisedCell::kTsdOne;
  const int half = scaled >= 0 ? TsdCell::kTsdOne / 2 : -TsdCell::kTsdOne / 2;
  const int weight = (cell.weight + QuantisedCell::kWeightStep / 2) / QuantisedCell::kWeightStep;
  return {static_cast<std::int8_t>(std::clamp((scaled + half) / TsdCell::kTsdOne,
                                              -QuantisedCell::kTsdOne, QuantisedCell::kTsdOne)),
          static_cast<std::uint8_t>(std::clamp(weight, 1, QuantisedCell::kMaxWeight))};
}

/// Back to a TSD cell, for matching and for maps read from files.
[[nodiscard]] constexpr TsdCell dequantise(QuantisedCell cell) {
  if (cell.weight == 0) return {};
  return {static_cast<std::int16_t>(cell.tsd * TsdCell::kTsdOne / QuantisedCell::kTsdOne),
          static_cast<std::uint16_t>(cell.weight * QuantisedCell::kWeightStep)};
}

}  // namespace lifeline
