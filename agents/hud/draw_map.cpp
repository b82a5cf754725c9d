// The map below everything else: each pixel looks up its cell.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "agents/hud/draw_hud.hpp"

namespace lifeline::hud {
namespace {

constexpr int kFraction = 16;  // bits of a cell behind the point
constexpr int kMostTilesAcross = 128;

/// The tiles that a picture may show, in a dense table.
struct TileTable {
  TileIndex first;
  int columns = 0, rows = 0;
  std::vector<const HudMap::Shades*> tiles;
};

TileTable tiles_between(const HudMap& map, const Eigen::Vector2d& low,
                        const Eigen::Vector2d& high) {
  static const HudMap::Shades kUnknown{};
  TileTable table;
  table.first = tile_of({static_cast<std::int32_t>(std::floor(low.x())),
                         static_cast<std::int32_t>(std::floor(low.y()))});
  const TileIndex last = tile_of({static_cast<std::int32_t>(std::floor(high.x())),
                                  static_cast<std::int32_t>(std::floor(high.y()))});
  table.columns = std::clamp(last.x - table.first.x + 1, 1, kMostTilesAcross);
  table.rows = std::clamp(last.y - table.first.y + 1, 1, kMostTilesAcross);
  for (int y = 0; y < table.rows; ++y) {
    for (int x = 0; x < table.columns; ++x) {
      const auto* shades = map.shades({table.first.x + x, table.first.y + y});
      table.tiles.push_back(shades == nullptr ? &kUnknown : shades);
    }
  }
  return table;
}

/// In cells, of a pixel's middle.
Eigen::Vector2d cell_of_pixel(const Projection& projection, double cell_size_m, double x,
                              double y) {
  const double scale = 1.0 / projection.pixels_per_m();
  const Eigen::Vector2d p_head((projection.own().y() - y) * scale,
                               (projection.own().x() - x) * scale);
  return (projection.T_map_head() * p_head) / cell_size_m;
}

using Palette = std::array<Colour, 3>;

/// `at` and `step`: cells of the table, with kFraction bits behind the point; a step is `repeat`
/// pixels.
void draw_row(const TileTable& table, CellIndex at, CellIndex step, int repeat,
              const Palette& palette, std::span<std::uint32_t> row) {
  const auto columns = static_cast<std::uint32_t>(table.columns * kTileSide);
  const auto rows = static_cast<std::uint32_t>(table.rows * kTileSide);
  const auto tiles_across = static_cast<std::uint32_t>(table.columns);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (repeat == 2 && i % 2 == 1) {
      row[i] = row[i - 1];
      continue;
    }
    const auto x = static_cast<std::uint32_t>(at.x >> kFraction);
    const auto y = static_cast<std::uint32_t>(at.y >> kFraction);
    at.x += step.x;
    at.y += step.y;
    // The steps' last digits may lead a cell beyond the corners that were looked at.
    if (x >= columns || y >= rows) {
      row[i] = palette[0];
      continue;
    }
    const auto& tile = *table.tiles[(y >> 6U) * tiles_across + (x >> 6U)];
    row[i] = palette[static_cast<std::size_t>(tile[((y & 63U) << 6U) | (x & 63U)])];
  }
}

}  // namespace

void draw_map(const HudPicture& picture, const HudMap& map, const Projection& projection,
              Pen& pen) {
  const bool dim = !picture.position_known;
  const Palette palette{0xff000000U | kGround, 0xff000000U | (dim ? kDimFloor : kFloor),
                        0xff000000U | (dim ? kDimWall : kWall)};
  const double cell_m = map.cell_size_m();
  const auto at = [&](double x, double y) { return cell_of_pixel(projection, cell_m, x, y); };
  Eigen::Vector2d low = at(0, 0), high = low;
  for (const auto& corner :
       {at(pen.width(), 0), at(0, pen.height()), at(pen.width(), pen.height())}) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const TileTable table = tiles_between(map, low, high);
  const Eigen::Vector2d base(first_cell(table.first).x, first_cell(table.first).y);
  const double one = 1 << kFraction;
  // Where a cell is wide, each second pixel tells the next one, too.
  const int repeat = projection.pixels_per_m() * cell_m >= 2.0 ? 2 : 1;
  const Eigen::Vector2d step = one * (at(0.5 + repeat, 0.5) - at(0.5, 0.5));
  const CellIndex step_cells{static_cast<std::int32_t>(std::lround(step.x())),
                             static_cast<std::int32_t>(std::lround(step.y()))};
  const auto pixels = pen.pixels();
  const auto width = static_cast<std::size_t>(pen.width());
  for (int y = 0; y < pen.height(); ++y) {
    const auto row = pixels.subspan(static_cast<std::size_t>(y) * width, width);
    if (y % repeat != 0) {
      std::copy_n(row.data() - width, width, row.data());
      continue;
    }
    const Eigen::Vector2d start = one * (at(0.5, y + 0.5) - base);
    draw_row(table, {static_cast<std::int32_t>(start.x()), static_cast<std::int32_t>(start.y())},
             step_cells, repeat, palette, row);
  }
  pen.pixels_changed();
}

void draw_way(const HudPicture& picture, const Projection& projection, Pen& pen) {
  if (!picture.way_out || picture.way_out->points.size() < 2) return;
  constexpr double kFarthest_px = 1e5;  // cairo counts in 24 bits before the point
  Outline line;
  for (const auto& point : picture.way_out->points) {
    const Point pixel = projection.to_pixel(point);
    if (pixel.allFinite() && pixel.cwiseAbs().maxCoeff() < kFarthest_px) line.push_back(pixel);
  }
  const double u = pen.unit();
  pen.line(line, 0.45 * u, kWay, picture.way_out->by_own_trail);
  // The door one came in by.
  const Point door = line.empty() ? Point(-1e4, -1e4) : line.back();
  if (std::abs(door.x()) > 2.0 * pen.width() || std::abs(door.y()) > 2.0 * pen.height()) return;
  pen.sign({door + Point(-0.8, -1.2) * u, door + Point(0.8, -1.2) * u, door + Point(0.8, 1.2) * u,
            door + Point(-0.8, 1.2) * u},
           kWay);
  pen.fill(Rectangle{door.x() - 0.35 * u, door.y() - 0.75 * u, 0.7 * u, 1.95 * u}, kGround);
}

}  // namespace lifeline::hud
