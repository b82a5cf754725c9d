#include <cmath>
#include <optional>

#include "coordinator/matching/wall_points.hpp"

namespace lifeline::matching {
namespace {

/// Central difference of the TSD at a known cell; one-sided or 0 where a neighbour is unknown.
Eigen::Vector2f gradient(const TsdGrid& tsd, CellIndex cell) {
  const auto along = [&](CellIndex before, CellIndex after) {
    const TsdCell b = tsd.cell(before), a = tsd.cell(after), here = tsd.cell(cell);
    if (b.known() && a.known()) return 0.5F * (a.value() - b.value());
    if (a.known()) return a.value() - here.value();
    if (b.known()) return here.value() - b.value();
    return 0.0F;
  };
  return {along({cell.x - 1, cell.y}, {cell.x + 1, cell.y}),
          along({cell.x, cell.y - 1}, {cell.x, cell.y + 1})};
}

/// The surface between two neighbouring cells of different sign.
std::optional<WallPoint> crossing(const TsdGrid& tsd, CellIndex first, CellIndex second,
                                  const Eigen::Vector2d& p_map_origin) {
  const TsdCell a = tsd.cell(first), b = tsd.cell(second);
  if (!a.known() || !b.known() || (a.tsd > 0) == (b.tsd > 0)) return std::nullopt;
  const float step = a.value() - b.value();
  // A surface rises by cell / truncation; the jump between the back of one wall and the free space
  // of another is not a surface.
  const auto& geometry = tsd.geometry();
  if (std::abs(step) > 2.5F * static_cast<float>(geometry.cell_size_m / geometry.truncation_m)) {
    return std::nullopt;
  }
  const float share = a.value() / step;
  const Eigen::Vector2f slope = (1 - share) * gradient(tsd, first) + share * gradient(tsd, second);
  if (slope.norm() < 1e-3F) return std::nullopt;
  const Eigen::Vector2d p = (1 - share) * tsd.centre_of(first) + share * tsd.centre_of(second);
  return WallPoint{(p - p_map_origin).cast<float>(), slope.normalized(),
                   static_cast<float>(geometry.cell_size_m)};
}

}  // namespace

std::vector<WallPoint> wall_points(const TsdGrid& tsd, const Eigen::Vector2d& p_map_origin) {
  std::vector<WallPoint> points;
  for (const TileIndex tile : tsd.tiles()) {
    const CellIndex first = first_cell(tile);
    for (int y = first.y; y < first.y + kTileSide; ++y) {
      for (int x = first.x; x < first.x + kTileSide; ++x) {
        if (!tsd.cell({x, y}).known()) continue;
        for (const CellIndex next : {CellIndex{x + 1, y}, CellIndex{x, y + 1}}) {
          if (const auto point = crossing(tsd, {x, y}, next, p_map_origin)) {
            points.push_back(*point);
          }
        }
      }
    }
  }
  return points;
}

}  // namespace lifeline::matching
