#pragma once

#include <cstdint>
#include <string>

namespace lifeline::sharing {

/// How many shapes there are for helmets on a map: circle, square, triangle, pentagon, hexagon.
inline constexpr std::uint32_t kMarkShapes = 5;

/// What a helmet looks like on every map, its mates' and the commander's: out of its id alone, so
/// that all name it alike, whoever was heard first and whoever was restarted.
struct HelmetMark {
  std::string label;        ///< two or three characters, ASCII
  std::uint32_t shape = 0;  ///< 0 to kMarkShapes - 1, in the order above
  bool operator==(const HelmetMark&) const = default;
};

/// Label: the first letter and the number at the end of the id, of which the last two digits
/// ("ff12" is F12, "engine1-2" E2), or the first two letters ("bravo" is BR), or a number alone
/// ("007" is 7). Two helmets may have the same; their shapes may still tell them apart.
[[nodiscard]] HelmetMark mark_of(const std::string& id);

}  // namespace lifeline::sharing
