// The bytes of tiles are a contract with other releases, other machines and files on disk. When one
// of these tests fails, either undo what changed the bytes, or give them a new encoding_version and
// new files: LIFELINE_GOLDEN_OUT=tests/golden/wire makes the tests write instead of compare.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zstd.h>

#include "common/base/sha256.hpp"
#include "common/wire/coarse_cells.hpp"
#include "common/wire/tile_codec.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::wire {
namespace {

using Octets = std::vector<std::uint8_t>;

constexpr int kOne = QuantisedCell::kTsdOne, kMost = QuantisedCell::kMaxWeight;
/// A corner of two walls seen from inside, in integers: the same on every machine.
QuantisedTile corner_tile() {
  QuantisedTile tile{};
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      const int to_wall = std::min(50 - x - y / 8, 40 - y + x / 16);
      if (to_wall < -3) continue;
      const int wobble = (x * 7 + y * 13) % 5;
      auto& cell = tile[offset_in_tile({x, y})];
      cell.tsd = static_cast<std::int8_t>(
          to_wall > 3 ? kOne : std::clamp(to_wall * kOne / 3 + wobble, -kOne, kOne));
      cell.weight = static_cast<std::uint8_t>(std::clamp(kMost - (x + y) / 8, 1, kMost));
    }
  }
  return tile;
}

/// Every value a cell can have, without order. Raw engine output: distributions differ between
/// libraries.
QuantisedTile noise_tile() {
  std::mt19937 random(2024);
  QuantisedTile tile{};
  for (auto& cell : tile) {
    const auto weight = static_cast<std::uint8_t>(random() % (kMost + 1U));
    const auto tsd = static_cast<std::int8_t>(static_cast<int>(random() % (2U * kOne + 1U)) - kOne);
    if (weight > 0) cell = {tsd, weight};
  }
  return tile;
}

Octets from_hex(const std::string& text) {
  Octets octets;
  std::string digits;
  for (const char c : text) {
    if (c == '\n') continue;
    digits += c;
    if (digits.size() < 2) continue;
    octets.push_back(static_cast<std::uint8_t>(std::stoi(digits, nullptr, 16)));
    digits.clear();
  }
  return octets;
}

std::string hex_lines(const Octets& octets) {
  constexpr std::size_t kLine = 96;
  const std::string digits = to_hex(octets);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); i += kLine) text += digits.substr(i, kLine) + "\n";
  return text;
}

Octets unpacked(const Octets& payload) {
  Octets content(ZSTD_getFrameContentSize(payload.data(), payload.size()));
  EXPECT_EQ(ZSTD_decompress(content.data(), content.size(), payload.data(), payload.size()),
            content.size());
  return content;
}

/// Coarse values as the stored payloads hold them, whatever wire::coarse makes of a tile today: the
/// nearest level of the side; well seen where the known cells of the 5 x 5 around average 2 or
/// more.
QuantisedCell coarse_cell(const QuantisedTile& tile, int x, int y) {
  const QuantisedCell cell = tile[offset_in_tile({x, y})];
  if (cell.weight == 0) return {};
  const int tsd = cell.tsd < -21   ? -32
                  : cell.tsd <= 0  ? -10
                  : cell.tsd <= 21 ? 10
                  : cell.tsd < 80  ? 32
                                   : kOne;
  int sum = 0, known = 0;
  for (int row = std::max(0, y - 2); row <= std::min(kTileSide - 1, y + 2); ++row) {
    for (int column = std::max(0, x - 2); column <= std::min(kTileSide - 1, x + 2); ++column) {
      const int weight = tile[offset_in_tile({column, row})].weight;
      sum += weight;
      known += weight != 0 ? 1 : 0;
    }
  }
  return {static_cast<std::int8_t>(tsd), static_cast<std::uint8_t>(sum >= 2 * known ? 6 : 1)};
}

QuantisedTile coarse_tile(const QuantisedTile& tile) {
  QuantisedTile result{};
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) result[offset_in_tile({x, y})] = coarse_cell(tile, x, y);
  }
  return result;
}

struct Golden {
  const char* name;
  QuantisedTile tile;
};

void PrintTo(const Golden& golden, std::ostream* out) {
  *out << golden.name;
}

class TileGolden : public ::testing::TestWithParam<Golden> {
 protected:
  static Octets stored(const std::string& kind) {
    return from_hex(support::content_of(std::filesystem::path(LIFELINE_SOURCE_DIR) /
                                        "tests/golden/wire" / (GetParam().name + kind)));
  }
  void SetUp() override {
    const char* const out = std::getenv("LIFELINE_GOLDEN_OUT");
    if (out == nullptr) return;
    const Octets payload = encode_tile(GetParam().tile, kGeometry);
    const std::filesystem::path folder(out);
    std::ofstream(folder / (GetParam().name + std::string(".payload.hex"))) << hex_lines(payload);
    if (is_coarse(GetParam().tile)) return;
    std::ofstream(folder / (GetParam().name + std::string(".content.hex")))
        << hex_lines(unpacked(payload));
  }
};

// Compression may change with zstd's release, its content not. A coarse tile is coded by us alone.
TEST_P(TileGolden, TheContentHasNotChanged) {
  if (is_coarse(GetParam().tile)) {
    EXPECT_EQ(hex_lines(encode_tile(GetParam().tile, kGeometry)),
              hex_lines(stored(".payload.hex")));
    return;
  }
  ASSERT_FALSE(stored(".content.hex").empty());
  EXPECT_EQ(hex_lines(unpacked(encode_tile(GetParam().tile, kGeometry))),
            hex_lines(stored(".content.hex")));
}

TEST_P(TileGolden, AStoredPayloadIsStillRead) {
  const auto tile = decode_tile(stored(".payload.hex"), kGeometry);
  ASSERT_TRUE(tile) << tile.error().text;
  EXPECT_EQ(*tile, GetParam().tile);
}

// A release that wrote version 1 alone wrote an unknown tile so.
TEST(TileGoldenOld, AnUnknownTileOfVersion1IsStillRead) {
  const auto tile =
      decode_tile(from_hex(support::content_of(std::filesystem::path(LIFELINE_SOURCE_DIR) /
                                               "tests/golden/wire/unknown.payload.hex")),
                  kGeometry);
  ASSERT_TRUE(tile) << tile.error().text;
  EXPECT_EQ(*tile, QuantisedTile{});
}

INSTANTIATE_TEST_SUITE_P(Stored, TileGolden,
                         ::testing::Values(Golden{"coarse_unknown", {}},
                                           Golden{"coarse_corner", coarse_tile(corner_tile())},
                                           Golden{"coarse_noise", coarse_tile(noise_tile())},
                                           Golden{"corner", corner_tile()},
                                           Golden{"noise", noise_tile()}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace lifeline::wire
