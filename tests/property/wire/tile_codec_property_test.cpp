// Any tile survives its encoding; any damage to a payload is refused or gives a valid tile.

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <zstd.h>

#include "common/wire/limits.hpp"
#include "common/wire/tile_codec.hpp"
#include "common/wire/tile_planes.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::wire {
namespace {

using Octets = std::vector<std::uint8_t>;

constexpr int kOne = QuantisedCell::kTsdOne;
bool is_valid(const QuantisedTile& tile) {
  return std::all_of(tile.begin(), tile.end(), [](QuantisedCell cell) {
    return cell.weight <= QuantisedCell::kMaxWeight && cell.tsd >= -QuantisedCell::kTsdOne &&
           (cell.weight != 0 || cell.tsd == 0);
  });
}

/// Decodes what may be anything: either an error in one line or a valid tile.
void expect_safe(const Octets& payload) {
  const auto tile = decode_tile(payload, kGeometry);
  if (tile) {
    EXPECT_TRUE(is_valid(*tile));
  } else {
    EXPECT_EQ(tile.error().text.find('\n'), std::string::npos);
    EXPECT_FALSE(tile.error().text.empty());
  }
}

/// What encode_tile compresses, to damage it behind the checksum.
Octets unpacked(const Octets& payload) {
  Octets content(ZSTD_getFrameContentSize(payload.data(), payload.size()));
  (void)ZSTD_decompress(content.data(), content.size(), payload.data(), payload.size());
  return content;
}

Octets packed(const Octets& content) {
  Octets frame(ZSTD_compressBound(content.size()));
  frame.resize(ZSTD_compress(frame.data(), frame.size(), content.data(), content.size(), 1));
  return frame;
}

TEST(TileCodecProperty, RandomTilesSurviveWhateverTheirShare) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const QuantisedTile tile = support::random_tile(random, share(random));
    const Octets payload = encode_tile(tile, kGeometry);
    ASSERT_LE(payload.size(), kMaxTilePayload);
    const auto decoded = decode_tile(payload, kGeometry);
    ASSERT_TRUE(decoded) << decoded.error().text;
    ASSERT_EQ(*decoded, tile) << "tile " << i;
  }
}

TEST(TileCodecProperty, WallsInAnyDirectionSurvive) {
  for (int i = 0; i < 100; ++i) {
    const QuantisedTile tile = support::wall_tile(0.0631 * i, 0.4 * (i % 40) - 8.0);
    ASSERT_EQ(decode_tile(encode_tile(tile, kGeometry), kGeometry).value(), tile) << i;
  }
}

TEST(TileCodecProperty, TheFewestAndTheExtremeCellsSurvive) {
  for (const std::size_t i :
       {std::size_t{0}, std::size_t{63}, std::size_t{64}, std::size_t{4095}}) {
    for (const int tsd : {-kOne, -1, 0, 1, kOne - 1, kOne}) {
      QuantisedTile tile{};
      tile[i] = {static_cast<std::int8_t>(tsd), QuantisedCell::kMaxWeight};
      ASSERT_EQ(decode_tile(encode_tile(tile, kGeometry), kGeometry).value(), tile);
    }
  }
  QuantisedTile board{};
  for (std::size_t i = 0; i < board.size(); ++i) {
    board[i] = {static_cast<std::int8_t>((i + i / 64) % 2 == 0 ? -kOne : kOne),
                QuantisedCell::kMaxWeight};
  }
  ASSERT_EQ(decode_tile(encode_tile(board, kGeometry), kGeometry).value(), board);
}

TEST(TileCodecProperty, EveryTruncationIsRefused) {
  const Octets payload = encode_tile(support::wall_tile(0.4), kGeometry);
  for (std::size_t size = 0; size < payload.size(); ++size) {
    EXPECT_FALSE(decode_tile({payload.data(), size}, kGeometry)) << size;
  }
}

TEST(TileCodecProperty, EveryFlippedBitIsRefusedOrHarmless) {
  const Octets payload = encode_tile(support::wall_tile(0.4), kGeometry);
  for (std::size_t bit = 0; bit < 8 * payload.size(); ++bit) {
    Octets damaged = payload;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    expect_safe(damaged);
  }
}

TEST(TileCodecProperty, DamageBehindTheChecksumIsRefusedOrHarmless) {
  std::mt19937 random(23);
  const Octets content = unpacked(encode_tile(support::wall_tile(1.1), kGeometry));
  for (int i = 0; i < 3000; ++i) {
    Octets damaged = content;
    for (unsigned k = 0; k <= random() % 3U; ++k) {
      damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    }
    if (i % 5 == 0) damaged.resize(random() % damaged.size());
    expect_safe(packed(damaged));
  }
}

TEST(TileCodecProperty, NoOctetOfTheContentIsIgnored) {
  std::mt19937 random(5);
  const Octets content = unpacked(encode_tile(support::random_tile(random, 0.5), kGeometry));
  int read = 0;
  for (int i = 0; i < 500; ++i) {
    Octets damaged = content;
    damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    const auto tile = decode_tile(packed(damaged), kGeometry);
    if (!tile) continue;
    ++read;
    ASSERT_EQ(unpacked(encode_tile(*tile, kGeometry)), damaged);
  }
  EXPECT_GT(read, 50);
}

TEST(TileCodecProperty, AnyOctetsAreRefusedOrHarmless) {
  std::mt19937 random(7);
  for (int i = 0; i < 5000; ++i) {
    Octets octets(random() % 300U);
    for (auto& octet : octets) octet = static_cast<std::uint8_t>(random());
    expect_safe(octets);
  }
}

}  // namespace
}  // namespace lifeline::wire
