#pragma once

#include <cstdint>
#include <map>
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

/// The parts of one tile as they arrive, in any order, of two revisions at a time: of the newest
/// one the rest may never come (its sender is gone), while somebody sends the one before it again.
class TileParts {
 public:
  /// The whole payload once the last part of a revision is there, which ends all older ones;
  /// nothing before. bad_data where a sample contradicts itself or the parts that came before.
  [[nodiscard]] Result<std::optional<std::vector<std::uint8_t>>> add(const TsdTile& sample);

  [[nodiscard]] bool empty() const { return begun_.empty(); }

 private:
  using Parts = std::vector<std::optional<std::vector<std::uint8_t>>>;
  Parts& begin(const TsdTile& sample);
  std::map<std::uint64_t, Parts> begun_;  ///< by revision
};

}  // namespace lifeline::wire
