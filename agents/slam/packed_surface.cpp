#include "agents/slam/packed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lifeline::slam {
namespace {

constexpr float kStep_m = 0.002F;
constexpr float kDirections = 65536.0F;
constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;
constexpr float kQualities = 255.0F;
constexpr std::uint8_t kHasNormal = 4;
constexpr std::uint8_t kLinkBits = 3;

bool fits(float metres) {
  return std::abs(metres) < kStep_m * static_cast<float>(std::numeric_limits<std::int16_t>::max());
}

std::uint16_t packed_length(float length_m) {
  constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::clamp(std::round(length_m / kStep_m), 0.0F, kMost));
}

}  // namespace

PackedSurface::PackedSurface(std::span<const SurfacePiece> pieces) {
  pieces_.reserve(pieces.size());
  for (const SurfacePiece& piece : pieces) {
    if (!fits(piece.point.x()) || !fits(piece.point.y())) continue;
    const float turn = std::atan2(piece.normal.y(), piece.normal.x()) / kTurn;
    Piece packed{};
    packed.x = static_cast<std::int16_t>(std::lround(piece.point.x() / kStep_m));
    packed.y = static_cast<std::int16_t>(std::lround(piece.point.y() / kStep_m));
    packed.direction = static_cast<std::uint16_t>(std::lround(turn * kDirections));
    packed.left = packed_length(piece.left_m);
    packed.right = packed_length(piece.right_m);
    // Never 0: a piece without any weight would not have been one.
    packed.quality = static_cast<std::uint8_t>(
        std::clamp(std::round(piece.quality * kQualities), 1.0F, kQualities));
    packed.link_and_kind = static_cast<std::uint8_t>(static_cast<std::uint8_t>(piece.link) |
                                                     (piece.has_normal ? kHasNormal : 0));
    pieces_.push_back(packed);
  }
}

void PackedSurface::unpack(std::vector<SurfacePiece>& pieces) const {
  for (const Piece& packed : pieces_) {
    const float angle_rad = static_cast<float>(packed.direction) * (kTurn / kDirections);
    SurfacePiece piece;
    piece.point = {static_cast<float>(packed.x) * kStep_m, static_cast<float>(packed.y) * kStep_m};
    piece.normal = {std::cos(angle_rad), std::sin(angle_rad)};
    piece.left_m = static_cast<float>(packed.left) * kStep_m;
    piece.right_m = static_cast<float>(packed.right) * kStep_m;
    piece.quality = static_cast<float>(packed.quality) / kQualities;
    piece.link = static_cast<SurfaceLink>(packed.link_and_kind & kLinkBits);
    piece.has_normal = (packed.link_and_kind & kHasNormal) != 0;
    pieces.push_back(piece);
  }
}

}  // namespace lifeline::slam
