#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/base/result.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::wire {

/// A payload of encode_tile cut into pieces of at most kMaxTilePart octets, one sample each: a
/// sample that the middleware had to cut up itself would be lost, or worse, on a bad link (see
/// docs/decisions/0104-a-tile-travels-in-parts.md). The payload must not be empty.
[[nodiscard]] std::vector<std::vector<std::uint8_t>> split_payload(
    std::span<const std::uint8_t> payload);

/// The parts of one tile as they arrive, in any order. Only the newest revision is kept.
class TileParts {
 public:
  /// The whole payload once the last part is there; nothing before, and nothing for parts of older
  /// revisions. bad_data where a sample contradicts itself or the parts that came before.
  [[nodiscard]] Result<std::optional<std::vector<std::uint8_t>>> add(const TsdTile& sample);

 private:
  std::uint64_t revision_ = 0;
  std::vector<std::optional<std::vector<std::uint8_t>>> parts_;
};

}  // namespace lifeline::wire
