#include "common/wire/tile_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>

#include <zstd.h>

#include "common/base/check.hpp"
#include "common/wire/coarse_cells.hpp"
#include "common/wire/coarse_tile.hpp"
#include "common/wire/limits.hpp"
#include "common/wire/tile_planes.hpp"
#include "idl/tile.pb.h"

namespace lifeline::wire {
namespace {

constexpr std::uint32_t kFineVersion = 1, kCoarseVersion = 2;
/// A zstd frame, and so a payload of version 1, begins with this; no TilePayload does.
constexpr std::uint8_t kFrameMark = 0x28;
constexpr int kCompressionLevel = 19;
/// Three planes of at most 2048, 512 and 4096 octets, and a few dozen of Protobuf about them.
constexpr std::size_t kMaxContent = 6800;
/// Headers of blocks that zstd's own bound does not count.
constexpr std::size_t kRoomForBlocks = 64;
static_assert(ZSTD_COMPRESSBOUND(kMaxContent) + kRoomForBlocks <= kMaxTilePayload);

struct FreeContext {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

std::string to_text(const std::vector<std::uint8_t>& octets) {
  return {octets.begin(), octets.end()};
}

std::span<const std::uint8_t> octets_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// One frame of all of `content`, with a block of its own from each of the `cuts` on: planes differ
/// so much that an entropy table for each saves more than it costs (4 % on recorded maps).
std::vector<std::uint8_t> compress(std::span<const std::uint8_t> content,
                                   std::initializer_list<std::size_t> cuts) {
  // One context for each thread: making one costs more than compressing a tile.
  thread_local const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
  LIFELINE_CHECK(context != nullptr);
  ZSTD_CCtx_reset(context.get(), ZSTD_reset_session_and_parameters);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  ZSTD_CCtx_setPledgedSrcSize(context.get(), content.size());
  std::vector<std::uint8_t> frame(ZSTD_compressBound(content.size()) + kRoomForBlocks);
  ZSTD_outBuffer out{frame.data(), frame.size(), 0};
  ZSTD_inBuffer in{content.data(), 0, 0};
  for (const std::size_t cut : cuts) {
    in.size = cut;
    LIFELINE_CHECK(ZSTD_compressStream2(context.get(), &out, &in, ZSTD_e_flush) == 0);
  }
  in.size = content.size();
  LIFELINE_CHECK(ZSTD_compressStream2(context.get(), &out, &in, ZSTD_e_end) == 0);
  frame.resize(out.pos);
  return frame;
}

/// Decompresses into `room`. In one go and without a window: zstd's memory does not depend on what
/// the frame claims.
Result<std::span<const std::uint8_t>> decompress(std::span<const std::uint8_t> frame,
                                                 std::span<std::uint8_t> room) {
  const auto stated = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (stated == ZSTD_CONTENTSIZE_ERROR || stated == ZSTD_CONTENTSIZE_UNKNOWN) {
    return fail(ErrorCode::bad_data, "tile refused: not a zstd frame that states its size");
  }
  if (stated > room.size()) {
    return fail(ErrorCode::bad_data, "tile refused: unpacks to {} octets, at most {} are allowed",
                stated, room.size());
  }
  if (ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size()) {
    return fail(ErrorCode::bad_data, "tile refused: not exactly one whole zstd frame");
  }
  thread_local const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
  LIFELINE_CHECK(context != nullptr);
  const std::size_t size =
      ZSTD_decompressDCtx(context.get(), room.data(), room.size(), frame.data(), frame.size());
  if (ZSTD_isError(size) != 0) {
    return fail(ErrorCode::bad_data, "tile refused: damaged zstd frame ({})",
                ZSTD_getErrorName(size));
  }
  return room.first(size);
}

Result<void> check_header(const proto::TilePayload& payload, std::uint32_t version,
                          const GridGeometry& expected) {
  if (payload.encoding_version() != version) {
    return fail(ErrorCode::unsupported,
                "tile refused: encoding version {}, this program reads {} here; run the same "
                "release everywhere",
                payload.encoding_version(), version);
  }
  if (payload.cell_size_um() != to_micrometres(expected.cell_size_m)) {
    return fail(ErrorCode::unsupported,
                "map of other cell size: the tile has {} m, this map {} m; set grid.cell_size_m "
                "alike everywhere",
                payload.cell_size_um() / 1e6, expected.cell_size_m);
  }
  if (payload.truncation_um() != to_micrometres(expected.truncation_m)) {
    return fail(ErrorCode::unsupported,
                "map of other truncation: the tile has {} m, this map {} m; set grid.truncation_m "
                "alike everywhere",
                payload.truncation_um() / 1e6, expected.truncation_m);
  }
  return {};
}

proto::TilePayload header(std::uint32_t version, const GridGeometry& geometry) {
  proto::TilePayload payload;
  payload.set_encoding_version(version);
  payload.set_cell_size_um(to_micrometres(geometry.cell_size_m));
  payload.set_truncation_um(to_micrometres(geometry.truncation_m));
  return payload;
}

/// CRC-16 (polynomial 0x1021, start 0xFFFF) of header and cells.
std::uint32_t checksum(const proto::TilePayload& payload) {
  std::uint32_t crc = 0xFFFF;
  const auto add = [&crc](std::uint32_t octet) {
    crc ^= octet << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc << 1 ^ (crc & 0x8000U ? 0x1021U : 0U)) & 0xFFFFU;
  };
  for (const std::uint32_t number : {payload.cell_size_um(), payload.truncation_um()}) {
    for (unsigned shift = 0; shift < 32; shift += 8) add(number >> shift & 0xFFU);
  }
  for (const std::uint8_t octet : octets_of(payload.cells())) add(octet);
  return crc;
}

/// What a payload of version 2 leaves out.
constexpr std::uint32_t kUsualCell_um = 50'000, kUsualTruncation_um = 150'000;

std::vector<std::uint8_t> encode_coarse(const QuantisedTile& tile, const GridGeometry& geometry) {
  proto::TilePayload payload = header(kCoarseVersion, geometry);
  if (payload.cell_size_um() == kUsualCell_um) payload.clear_cell_size_um();
  if (payload.truncation_um() == kUsualTruncation_um) payload.clear_truncation_um();
  payload.set_cells(to_text(encode_cells(tile)));
  payload.set_checksum(checksum(payload));
  const std::string content = payload.SerializeAsString();
  return {content.begin(), content.end()};
}

/// True where `payload` holds the fields of version 2 once each, in order, and nothing else.
bool is_whole(std::span<const std::uint8_t> payload, const proto::TilePayload& message) {
  proto::TilePayload fields;
  fields.set_encoding_version(message.encoding_version());
  fields.set_cell_size_um(message.cell_size_um());
  fields.set_truncation_um(message.truncation_um());
  fields.set_cells(message.cells());
  fields.set_checksum(message.checksum());
  const std::string content = fields.SerializeAsString();
  return std::ranges::equal(octets_of(content), payload);
}

Result<QuantisedTile> decode_coarse(std::span<const std::uint8_t> payload,
                                    const GridGeometry& expected) {
  proto::TilePayload message;
  if (!message.ParseFromArray(payload.data(), static_cast<int>(payload.size()))) {
    return fail(ErrorCode::bad_data, "tile refused: neither a zstd frame nor a TilePayload");
  }
  const std::uint32_t stated = message.checksum(), counted = checksum(message);
  const bool whole = is_whole(payload, message);
  if (message.cell_size_um() == 0) message.set_cell_size_um(kUsualCell_um);
  if (message.truncation_um() == 0) message.set_truncation_um(kUsualTruncation_um);
  if (const auto checked = check_header(message, kCoarseVersion, expected); !checked) {
    return forward_error(checked);
  }
  if (stated != counted || !whole) {
    return fail(ErrorCode::bad_data,
                "tile refused: damaged payload (checksum {:04x} stated, {:04x} counted)", stated,
                counted);
  }
  return decode_cells(octets_of(message.cells()));
}

}  // namespace

std::uint32_t to_micrometres(double length_m) {
  LIFELINE_CHECK(length_m >= 0.0 && length_m < 4000.0);
  return static_cast<std::uint32_t>(std::llround(length_m * 1e6));
}

std::vector<std::uint8_t> encode_tile(const QuantisedTile& tile, const GridGeometry& geometry) {
  if (is_coarse(tile)) {
    auto coarse = encode_coarse(tile, geometry);
    if (coarse.size() <= kMaxTilePayload) return coarse;
  }
  const TilePlanes planes = to_planes(tile);
  proto::TilePayload payload = header(kFineVersion, geometry);
  payload.set_weights(to_text(planes.weights));
  payload.set_free(to_text(planes.free));
  payload.set_tsd(to_text(planes.tsd));
  const std::string content = payload.SerializeAsString();
  LIFELINE_CHECK(content.size() <= kMaxContent);
  // Protobuf writes the fields in the order of their numbers: the last plane ends the content.
  const std::size_t before_tsd = content.size() - planes.tsd.size();
  const std::size_t before_free = before_tsd - std::min(before_tsd, planes.free.size());
  return compress(octets_of(content), {before_free, before_tsd});
}

Result<QuantisedTile> decode_tile(std::span<const std::uint8_t> payload,
                                  const GridGeometry& expected) {
  if (payload.size() > kMaxTilePayload) {
    return fail(ErrorCode::bad_data, "tile refused: payload of {} octets, at most {} are allowed",
                payload.size(), kMaxTilePayload);
  }
  if (payload.empty() || payload.front() != kFrameMark) return decode_coarse(payload, expected);
  std::array<std::uint8_t, kMaxContent> room;
  const auto content = decompress(payload, room);
  if (!content) return forward_error(content);
  proto::TilePayload message;
  if (!message.ParseFromArray(content->data(), static_cast<int>(content->size()))) {
    return fail(ErrorCode::bad_data, "tile refused: not a TilePayload message");
  }
  if (const auto checked = check_header(message, kFineVersion, expected); !checked) {
    return forward_error(checked);
  }
  return from_planes(octets_of(message.weights()), octets_of(message.free()),
                     octets_of(message.tsd()));
}

}  // namespace lifeline::wire
