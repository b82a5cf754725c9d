#include "common/wire/coarse_tile.hpp"

#include <algorithm>
#include <array>

#include "common/base/check.hpp"
#include "common/wire/bit_coder.hpp"
#include "common/wire/coarse_cells.hpp"

namespace lifeline::wire {
namespace {

constexpr unsigned kTopSymbol = 5, kUnknownSymbol = 0;  // as symbols

/// Numbers for contexts: `level` is 0 unknown, else 1 + the index in kCoarseLevels; `weight` 0
/// unknown, 1 thin, 2 well seen.
struct Symbol {
  unsigned level = kUnknownSymbol, weight = 0;
};

Symbol symbol_of(QuantisedCell cell) {
  if (cell.weight == 0) return {};
  const auto level =
      std::find(kCoarseLevels.begin(), kCoarseLevels.end(), cell.tsd) - kCoarseLevels.begin();
  return {static_cast<unsigned>(level) + 1, cell.weight == kThin ? 1U : 2U};
}

QuantisedCell cell_of(Symbol symbol) {
  if (symbol.level == kUnknownSymbol) return {};
  return {static_cast<std::int8_t>(kCoarseLevels[symbol.level - 1]),
          static_cast<std::uint8_t>(symbol.weight == 1 ? kThin : kWellSeen)};
}

/// 0 unknown, 1 free, 2 in front of a surface, 3 behind it.
unsigned side(Symbol s) {
  return s.level == kUnknownSymbol ? 0 : s.level == kTopSymbol ? 1 : s.level >= 3 ? 2 : 3;
}

/// Codes the symbols of a tile, row by row from below; the same steps write and read.
template <class Coder>
class CellCoder {
 public:
  explicit CellCoder(Coder& coder) : coder_(coder) {}

  Symbol code(int x, int y, Symbol symbol) {
    look_around(x, y);
    if (!code_known(symbol.level != kUnknownSymbol)) return {};
    symbol.level = code_level(symbol.level);
    symbol.weight = code_weight(symbol) ? 2 : 1;
    at(x, y) = symbol;
    return symbol;
  }

 private:
  static constexpr int kMargin = 2, kStride = kTileSide + 2 * kMargin;

  Symbol& at(int x, int y) {
    return symbols_[static_cast<std::size_t>((y + kMargin) * kStride + x + kMargin)];
  }
  void look_around(int x, int y) {
    l_ = at(x - 1, y), ll_ = at(x - 2, y), b_ = at(x, y - 1), bb_ = at(x, y - 2);
    bl_ = at(x - 1, y - 1), br_ = at(x + 1, y - 1), brr_ = at(x + 2, y - 1);
  }

  template <std::size_t N>
  bool code_bit(const std::array<BitEstimate*, N>& estimates, bool bit) {
    bit = coder_.code(mean_probability(estimates), bit);
    for (BitEstimate* estimate : estimates) estimate->learn(bit);
    return bit;
  }

  bool code_known(bool known) {
    const auto has = [](Symbol s) { return s.level != kUnknownSymbol ? 1U : 0U; };
    const unsigned all = has(l_) + 2 * has(b_) + 4 * has(bl_) + 8 * has(br_) + 16 * has(ll_) +
                         32 * has(bb_) + 64 * has(brr_);
    return code_bit<3>({&known_by_all_[all],
                        &known_by_side_[side(l_) + 4 * side(b_) + 16 * side(bl_) + 64 * side(br_)],
                        &known_by_level_[l_.level + 6 * b_.level + 36 * has(br_)]},
                       known);
  }

  [[nodiscard]] unsigned predicted() const {
    if (l_.level && b_.level && bl_.level) {
      const auto [low, high] = std::minmax(l_.level, b_.level);
      return std::clamp(l_.level + b_.level, low + bl_.level, high + bl_.level) - bl_.level;
    }
    if (l_.level && b_.level) return (l_.level + b_.level) / 2;
    for (const Symbol s : {l_, b_, bl_, br_}) {
      if (s.level != kUnknownSymbol) return s.level;
    }
    return kTopSymbol;
  }
  [[nodiscard]] unsigned unrest() const {
    const auto apart = [](Symbol a, Symbol b) {
      if (a.level == kUnknownSymbol || b.level == kUnknownSymbol) return 0U;
      return a.level > b.level ? a.level - b.level : b.level - a.level;
    };
    return std::min(7U, apart(l_, bl_) + apart(b_, bl_) + apart(b_, br_));
  }

  unsigned code_level(unsigned level) {
    const unsigned p = predicted() - 1;
    const std::array<unsigned, 5> contexts = {
        p * 8 + unrest(), l_.level + 6 * b_.level, b_.level + 6 * br_.level + 36 * p,
        l_.level + 6 * ll_.level + 36 * bl_.level, b_.level + 6 * bb_.level};
    const auto decide = [&](std::size_t node, bool bit) {
      std::array<BitEstimate*, 5> estimates{};
      for (std::size_t i = 0; i < 5; ++i) estimates[i] = &levels_[node][i][contexts[i]];
      return code_bit(estimates, bit);
    };
    if (decide(0, level == kTopSymbol)) return kTopSymbol;
    if (decide(1, level < 3)) return decide(2, level == 2) ? 2 : 1;
    return decide(3, level == 3) ? 3 : 4;
  }

  bool code_weight(Symbol symbol) {
    const unsigned lb = l_.weight + 3 * b_.weight;
    return code_bit<3>({&weight_by_near_[lb + 9 * br_.weight + 27 * bl_.weight],
                        &weight_by_far_[lb + 9 * (side({symbol.level, 0}) - 1) + 27 * ll_.weight +
                                        81 * bb_.weight],
                        &weight_by_level_[lb + 9 * (symbol.level - 1)]},
                       symbol.weight == 2);
  }

  Coder& coder_;
  std::array<Symbol, kStride*(kTileSide + kMargin)> symbols_{};
  Symbol l_, ll_, b_, bb_, bl_, br_, brr_;
  std::array<BitEstimate, 128> known_by_all_{};
  std::array<BitEstimate, 256> known_by_side_{};
  std::array<BitEstimate, 72> known_by_level_{};
  std::array<std::array<std::array<BitEstimate, 216>, 5>, 4> levels_{};
  std::array<BitEstimate, 81> weight_by_near_{};
  std::array<BitEstimate, 243> weight_by_far_{};
  std::array<BitEstimate, 45> weight_by_level_{};
};

template <class Coder>
void code_all(Coder& coder, QuantisedTile& tile) {
  CellCoder<Coder> cells(coder);
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      QuantisedCell& cell = tile[offset_in_tile({x, y})];
      cell = cell_of(cells.code(x, y, symbol_of(cell)));
    }
  }
}

}  // namespace

std::vector<std::uint8_t> encode_cells(const QuantisedTile& tile) {
  LIFELINE_CHECK(is_coarse(tile));
  QuantisedTile same = tile;
  BitEncoder encoder;
  code_all(encoder, same);
  return std::move(encoder).finish();
}

QuantisedTile decode_cells(std::span<const std::uint8_t> octets) {
  QuantisedTile tile{};
  BitDecoder decoder(octets);
  code_all(decoder, tile);
  return tile;
}

}  // namespace lifeline::wire
