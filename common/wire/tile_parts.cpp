#include "common/wire/tile_parts.hpp"

#include <algorithm>
#include <iterator>

#include "common/base/check.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::wire {

std::vector<std::vector<std::uint8_t>> split_payload(std::span<const std::uint8_t> payload) {
  LIFELINE_CHECK(!payload.empty() && payload.size() <= kMaxTilePayload);
  std::vector<std::vector<std::uint8_t>> parts;
  for (; !payload.empty(); payload = payload.subspan(parts.back().size())) {
    const auto part = payload.first(std::min(payload.size(), kMaxTilePart));
    parts.emplace_back(part.begin(), part.end());
  }
  return parts;
}

Result<std::optional<std::vector<std::uint8_t>>> TileParts::add(const TsdTile& sample) {
  if (sample.part >= sample.parts || sample.parts > kMaxTileParts) {
    return fail(ErrorCode::bad_data,
                "tile refused: part {} (from 0) of {}; a tile has at most {} parts", sample.part,
                sample.parts, kMaxTileParts);
  }
  if (sample.payload.size() > kMaxTilePart) {
    return fail(ErrorCode::bad_data, "tile refused: a part of {} octets, at most {} are allowed",
                sample.payload.size(), kMaxTilePart);
  }
  Parts& parts = begin(sample);
  if (parts.size() != sample.parts) {
    return fail(ErrorCode::bad_data, "tile refused: revision {} comes in {} parts, and in {}",
                sample.revision, parts.size(), sample.parts);
  }
  parts[sample.part] = sample.payload;
  if (!std::all_of(parts.begin(), parts.end(), [](const auto& part) { return part; }))
    return std::nullopt;
  std::vector<std::uint8_t> payload;
  for (const auto& part : parts) payload.insert(payload.end(), part->begin(), part->end());
  begun_.erase(begun_.begin(), begun_.upper_bound(sample.revision));
  return payload;
}

TileParts::Parts& TileParts::begin(const TsdTile& sample) {
  const auto [begun, is_new] = begun_.try_emplace(sample.revision, sample.parts);
  if (begun_.size() > 2) begun_.erase(begun == begun_.begin() ? std::next(begun) : begun_.begin());
  return begun->second;
}

}  // namespace lifeline::wire
