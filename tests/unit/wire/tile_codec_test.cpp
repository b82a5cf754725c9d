#include "common/wire/tile_codec.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <zstd.h>

#include "common/wire/limits.hpp"
#include "common/wire/tile_planes.hpp"
#include "idl/tile.pb.h"
#include "tests/support/fine_grid.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::wire {
namespace {

using ::testing::HasSubstr;
using Octets = std::vector<std::uint8_t>;

Octets compressed(const std::string& content, bool states_size = true) {
  ZSTD_CCtx* context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, states_size ? 1 : 0);
  Octets frame(ZSTD_compressBound(content.size()));
  frame.resize(ZSTD_compress2(context, frame.data(), frame.size(), content.data(), content.size()));
  ZSTD_freeCCtx(context);
  return frame;
}

proto::TilePayload payload_of(const QuantisedTile& tile) {
  const TilePlanes planes = to_planes(tile);
  proto::TilePayload payload;
  payload.set_encoding_version(1);
  payload.set_cell_size_um(50000);
  payload.set_truncation_um(150000);
  payload.set_weights({planes.weights.begin(), planes.weights.end()});
  payload.set_free({planes.free.begin(), planes.free.end()});
  payload.set_tsd({planes.tsd.begin(), planes.tsd.end()});
  return payload;
}

std::string error_of(const Octets& payload) {
  const auto tile = decode_tile(payload, kGeometry);
  return tile ? "decoded" : tile.error().text;
}

std::string error_of(const proto::TilePayload& payload) {
  return error_of(compressed(payload.SerializeAsString()));
}

TEST(TileCodec, GivesATileBackBitForBit) {
  for (const double angle : {0.0, 0.3, 1.2, 2.5, -2.0}) {
    const QuantisedTile tile = support::wall_tile(angle);
    const auto decoded = decode_tile(encode_tile(tile, kGeometry), kGeometry);
    ASSERT_TRUE(decoded) << decoded.error().text;
    EXPECT_EQ(*decoded, tile);
  }
}

TEST(TileCodec, AnUnknownTileTakesAFewOctets) {
  const Octets payload = encode_tile(QuantisedTile{}, kGeometry);
  EXPECT_LT(payload.size(), 64U);
  EXPECT_EQ(*decode_tile(payload, kGeometry), QuantisedTile{});
}

TEST(TileCodec, EqualTilesGiveEqualOctets) {
  const auto first = encode_tile(support::wall_tile(0.4), kGeometry);
  (void)encode_tile(support::wall_tile(1.4), kGeometry);
  EXPECT_EQ(encode_tile(support::wall_tile(0.4), kGeometry), first);
}

TEST(TileCodec, AStraightWallFitsOneDatagram) {
  EXPECT_LT(encode_tile(support::wall_tile(0.7), kGeometry).size(), 1200U);
}

TEST(TileCodec, TheWorstTileFitsTheTopicsBound) {
  std::mt19937 random(5);
  const auto payload = encode_tile(support::random_tile(random, 1.0), kGeometry);
  EXPECT_LE(payload.size(), kMaxTilePayload);
}

TEST(TileCodec, RefusesAMapOfOtherCellSize) {
  const auto payload =
      encode_tile(support::wall_tile(0.0), {.cell_size_m = 0.1, .truncation_m = 0.15});
  const auto tile = decode_tile(payload, kGeometry);
  ASSERT_FALSE(tile);
  EXPECT_EQ(tile.error().code, ErrorCode::unsupported);
  EXPECT_THAT(tile.error().text,
              HasSubstr("map of other cell size: the tile has 0.1 m, this map 0.05 m"));
}

TEST(TileCodec, RefusesAMapOfOtherTruncation) {
  const auto payload =
      encode_tile(support::wall_tile(0.0), {.cell_size_m = 0.05, .truncation_m = 0.2});
  EXPECT_THAT(error_of(payload), HasSubstr("map of other truncation"));
}

TEST(TileCodec, RefusesAnotherEncodingVersion) {
  auto payload = payload_of(support::wall_tile(0.0));
  payload.set_encoding_version(2);
  EXPECT_THAT(error_of(payload), HasSubstr("encoding version 2"));
}

TEST(TileCodec, RefusesWhatIsNoFrame) {
  EXPECT_THAT(error_of(Octets{}), HasSubstr("encoding version 0"));
  EXPECT_THAT(error_of(Octets(100, 0xFF)), HasSubstr("neither a zstd frame nor a TilePayload"));
  EXPECT_THAT(error_of(Octets(100, 0x28)), HasSubstr("not a zstd frame that states its size"));
  EXPECT_THAT(error_of(Octets(kMaxTilePayload + 1, 0)), HasSubstr("payload of 8193 octets"));
}

TEST(TileCodec, RefusesAFrameThatDoesNotStateItsSize) {
  const auto content = payload_of(support::wall_tile(0.0)).SerializeAsString();
  EXPECT_THAT(error_of(compressed(content, false)), HasSubstr("states its size"));
}

TEST(TileCodec, RefusesABombBeforeUnpackingIt) {
  const Octets bomb = compressed(std::string(std::size_t{20'000'000}, '\0'));
  ASSERT_LT(bomb.size(), kMaxTilePayload);
  EXPECT_THAT(error_of(bomb), HasSubstr("unpacks to 20000000 octets"));
}

TEST(TileCodec, RefusesTrailingOctetsAndSecondFrames) {
  Octets payload = encode_tile(support::wall_tile(0.0), kGeometry);
  Octets twice = payload;
  twice.insert(twice.end(), payload.begin(), payload.end());
  EXPECT_THAT(error_of(twice), HasSubstr("not exactly one whole zstd frame"));
  payload.push_back(0);
  EXPECT_THAT(error_of(payload), HasSubstr("not exactly one whole zstd frame"));
}

TEST(TileCodec, RefusesAFrameWhoseChecksumDiffers) {
  Octets payload = encode_tile(support::wall_tile(0.0), kGeometry);
  payload.back() ^= 1U;
  EXPECT_THAT(error_of(payload), HasSubstr("damaged zstd frame"));
}

TEST(TileCodec, RefusesContentThatIsNoMessage) {
  EXPECT_THAT(error_of(compressed(std::string(50, '\xff'))), HasSubstr("not a TilePayload"));
}

TEST(TileCodec, RefusesPlanesOfWrongLength) {
  auto payload = payload_of(support::wall_tile(0.0));
  payload.mutable_weights()->pop_back();
  EXPECT_THAT(error_of(payload), HasSubstr("planes of 2047 and 512 octets"));
  payload = payload_of(support::wall_tile(0.0));
  payload.mutable_free()->push_back('\0');
  EXPECT_THAT(error_of(payload), HasSubstr("planes of 2048 and 513 octets"));
  payload = payload_of(support::wall_tile(0.0));
  payload.mutable_tsd()->push_back('\0');
  EXPECT_THAT(error_of(payload), HasSubstr("1 distances too many"));
  payload = payload_of(support::wall_tile(0.0));
  payload.mutable_tsd()->pop_back();
  EXPECT_THAT(error_of(payload), HasSubstr("its distances end at cell"));
}

TEST(TileCodec, RefusesCellsThatContradictThemselves) {
  proto::TilePayload payload = payload_of(QuantisedTile{});
  (*payload.mutable_free())[0] = 1;
  EXPECT_THAT(error_of(payload), HasSubstr("cell 0 is free but unknown"));
  payload = payload_of(support::wall_tile(0.0));
  (*payload.mutable_tsd())[3] = '\xff';
  EXPECT_THAT(error_of(payload), HasSubstr("stands for no value"));
}

TEST(TilePlanesDeath, AnInvalidCellIsABug) {
  QuantisedTile tile{};
  tile[7].tsd = 3;
  EXPECT_DEATH((void)to_planes(tile), "is_valid");
}

}  // namespace
}  // namespace lifeline::wire
