#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/grid/scan_surface.hpp"

namespace lifeline::slam {

/// A scan's surfaces in a third of their memory, to be kept for as long as the map may have to be
/// drawn anew. Points keep 2 mm (up to 65 m from the head), directions 0.01 deg, lengths 2 mm, the
/// quality 1/255. What does not fit is left out by pack().
class PackedSurface {
 public:
  PackedSurface() = default;
  explicit PackedSurface(std::span<const SurfacePiece> pieces);

  /// Appends the pieces to `pieces`.
  void unpack(std::vector<SurfacePiece>& pieces) const;

  [[nodiscard]] std::size_t size() const { return pieces_.size(); }

 private:
  struct Piece {
    std::int16_t x, y;           // 2 mm
    std::uint16_t direction;     // of the normal, 1/65536 of a turn
    std::uint16_t left, right;   // 2 mm
    std::uint8_t quality;        // 1/255
    std::uint8_t link_and_kind;  // SurfaceLink, and kHasNormal
  };
  std::vector<Piece> pieces_;
};

}  // namespace lifeline::slam
