#pragma once

#include <cstdint>
#include <span>

namespace lifeline::hud {

/// 0xRRGGBB
using Colour = std::uint32_t;

// Three luminance levels: near-black, the lit floor, and what is to be seen. Colours only help:
// each sign has a shape of its own.
inline constexpr Colour kGround = 0x05070a;  ///< the unknown, and behind all text
inline constexpr Colour kFloor = 0x5f666e;   ///< seen to be free
inline constexpr Colour kWall = 0xffffff;
inline constexpr Colour kInk = 0xffffff;    ///< text, own arrow
inline constexpr Colour kFaint = 0xbcbcbc;  ///< what is old
inline constexpr Colour kMate = 0x8fd3ff;
inline constexpr Colour kFind = 0xffe94a;
inline constexpr Colour kWay = 0x63f09a;
inline constexpr Colour kMayday = 0xff7a45;  ///< kept for maydays
inline constexpr Colour kOrder = 0xffe94a;   ///< ground of an order to evacuate
// While the position is lost, the map is only a memory.
inline constexpr Colour kDimFloor = 0x23272b;
inline constexpr Colour kDimWall = 0x8a9097;

/// WCAG 2: from 1 (the same) to 21 (black on white).
[[nodiscard]] double contrast(Colour a, Colour b);

/// What is drawn on what.
struct ColourPair {
  const char* what;
  Colour on, ground;
  bool is_text;
};
/// Every pair that must be told apart.
[[nodiscard]] std::span<const ColourPair> colour_pairs();

}  // namespace lifeline::hud
