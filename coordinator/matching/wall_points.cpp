#include "coordinator/matching/wall_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace lifeline::matching {
namespace {

constexpr int kAxisRadius = 4;  // cells: neighbourhood in which the wall's direction is estimated
constexpr int kFreeRadius = 3;  // cells: how far the free side is looked for
constexpr int kLineRadius = 5;  // cells: neighbourhood of the line fit
constexpr int kMinLinePoints = 3;

/// Sums of a weighted point set, from which a line is fitted.
struct LineSums {
  float n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(float px, float py) {
    n += 1;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
    yy += py * py;
  }
  [[nodiscard]] Eigen::Vector2f mean() const { return {x / n, y / n}; }
  /// Direction of least spread.
  [[nodiscard]] Eigen::Vector2f normal() const {
    const float mx = x / n, my = y / n;
    const float cxx = xx / n - mx * mx, cxy = xy / n - mx * my, cyy = yy / n - my * my;
    const float along = 0.5F * std::atan2(2 * cxy, cxx - cyy);
    return {-std::sin(along), std::cos(along)};
  }
};

/// A face of one occupied cell.
struct Face {
  int column, row;
  Eigen::Vector2f normal;
};

/// Free cells within the half disc that `normal` points into, as a share of that half disc.
float free_share(const OccupancyGrid& grid, int column, int row, const Eigen::Vector2f& normal) {
  int free = 0, all = 0;
  for (int dy = -kFreeRadius; dy <= kFreeRadius; ++dy) {
    for (int dx = -kFreeRadius; dx <= kFreeRadius; ++dx) {
      const float ahead = static_cast<float>(dx) * normal.x() + static_cast<float>(dy) * normal.y();
      if (ahead < 0.9F || dx * dx + dy * dy > kFreeRadius * kFreeRadius) continue;
      ++all;
      free += grid.at(column + dx, row + dy) == Occupancy::free ? 1 : 0;
    }
  }
  return all == 0 ? 0.0F : static_cast<float>(free) / static_cast<float>(all);
}

/// Whether the cell is the foremost of its wall towards `normal`.
bool is_face(const OccupancyGrid& grid, int column, int row, const Eigen::Vector2f& normal) {
  const int x = column + static_cast<int>(std::lround(1.3F * normal.x()));
  const int y = row + static_cast<int>(std::lround(1.3F * normal.y()));
  return grid.at(x, y) != Occupancy::occupied;
}

bool touches_free(const OccupancyGrid& grid, int column, int row) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (grid.at(column + dx, row + dy) == Occupancy::free) return true;
    }
  }
  return false;
}

/// Direction across the wall at an occupied cell, from the occupied cells within `radius`.
std::optional<Eigen::Vector2f> wall_normal(const OccupancyGrid& grid, int column, int row,
                                           int radius) {
  LineSums sums;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (dx * dx + dy * dy > radius * radius) continue;
      if (grid.at(column + dx, row + dy) == Occupancy::occupied) {
        sums.add(static_cast<float>(dx), static_cast<float>(dy));
      }
    }
  }
  if (sums.n < kMinLinePoints) return std::nullopt;
  return sums.normal();
}

std::vector<Face> find_faces(const OccupancyGrid& grid) {
  constexpr float kMinFreeShare = 0.6F;
  constexpr float kMinSparseShare = 0.2F;
  std::vector<Face> faces;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (grid.cells[grid.index(column, row)] != Occupancy::occupied) continue;
      if (!touches_free(grid, column, row)) continue;
      // Far walls were hit here and there only: look further for the next hit.
      auto normal = wall_normal(grid, column, row, kAxisRadius);
      if (!normal) normal = wall_normal(grid, column, row, 2 * kAxisRadius);
      if (!normal) continue;
      const float ahead = free_share(grid, column, row, *normal);
      const float behind = free_share(grid, column, row, -*normal);
      const auto is_free_side = [&](float here, float there) {
        return here >= kMinFreeShare || (here >= kMinSparseShare && there <= 0.25F * here);
      };
      if (is_free_side(ahead, behind) && is_face(grid, column, row, *normal)) {
        faces.push_back({column, row, *normal});
      }
      if (is_free_side(behind, ahead) && is_face(grid, column, row, -*normal)) {
        faces.push_back({column, row, -*normal});
      }
    }
  }
  return faces;
}

/// Range of `faces` per row, for neighbourhood searches: faces are ordered by row.
std::vector<std::size_t> row_starts(const std::vector<Face>& faces, int rows) {
  std::vector<std::size_t> starts(static_cast<std::size_t>(rows) + 1, faces.size());
  for (std::size_t i = faces.size(); i-- > 0;) starts[static_cast<std::size_t>(faces[i].row)] = i;
  for (std::size_t r = static_cast<std::size_t>(rows); r-- > 0;) {
    starts[r] = std::min(starts[r], starts[r + 1]);
  }
  return starts;
}

/// Line through the faces around `face` that look the same way; empty when there are too few.
std::optional<WallPoint> fit_line(const Face& face, const std::vector<Face>& faces,
                                  const std::vector<std::size_t>& starts, int rows, float cell_m,
                                  int radius) {
  LineSums sums;
  const int last_row = std::min(rows - 1, face.row + radius);
  for (int row = std::max(0, face.row - radius); row <= last_row; ++row) {
    const auto from =
        faces.begin() + static_cast<std::ptrdiff_t>(starts[static_cast<std::size_t>(row)]);
    const auto to =
        faces.begin() + static_cast<std::ptrdiff_t>(starts[static_cast<std::size_t>(row) + 1]);
    auto other = std::lower_bound(from, to, face.column - radius,
                                  [](const Face& f, int column) { return f.column < column; });
    for (; other != to && other->column <= face.column + radius; ++other) {
      if (other->normal.dot(face.normal) < 0.7F) continue;
      sums.add(static_cast<float>(other->column - face.column),
               static_cast<float>(other->row - face.row));
    }
  }
  if (sums.n < kMinLinePoints) return std::nullopt;
  Eigen::Vector2f normal = sums.normal();
  if (normal.dot(face.normal) < 0) normal = -normal;
  if (normal.dot(face.normal) < 0.7F) return std::nullopt;  // not a line: a blob
  const Eigen::Vector2f offset = normal * normal.dot(sums.mean());
  const Eigen::Vector2f centre(static_cast<float>(face.column) + 0.5F,
                               static_cast<float>(face.row) + 0.5F);
  return WallPoint{(centre + offset) * cell_m, normal, cell_m};
}

}  // namespace

std::vector<WallPoint> wall_points(const OccupancyGrid& grid) {
  const std::vector<Face> faces = find_faces(grid);
  const std::vector<std::size_t> starts = row_starts(faces, grid.rows);
  std::vector<WallPoint> points;
  points.reserve(faces.size());
  for (const Face& face : faces) {
    const auto cell_m = static_cast<float>(grid.cell_size_m);
    auto point = fit_line(face, faces, starts, grid.rows, cell_m, kLineRadius);
    if (!point) point = fit_line(face, faces, starts, grid.rows, cell_m, 2 * kLineRadius);
    if (point) points.push_back(*point);
  }
  return points;
}

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

namespace {

/// Points of one square that look roughly the same way.
struct Cluster {
  Eigen::Vector2f p = Eigen::Vector2f::Zero();
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();
  float count = 0.0F;
};

/// Adds the point to the cluster that looks the same way, or opens a new one.
void add_to_clusters(const WallPoint& point, std::vector<Cluster>& clusters) {
  const auto same_way = [&](const Cluster& c) {
    return c.normal.dot(point.normal) > 0.6F * c.normal.norm();
  };
  auto cluster = std::find_if(clusters.begin(), clusters.end(), same_way);
  if (cluster == clusters.end()) cluster = clusters.insert(clusters.end(), Cluster{});
  cluster->p += point.p;
  cluster->normal += point.normal;
  cluster->count += 1.0F;
}

struct Keyed {
  std::uint64_t square;
  std::uint32_t index;
  auto operator<=>(const Keyed&) const = default;
};

/// The points' indices, ordered by the square they lie in.
std::vector<Keyed> order_by_square(const std::vector<WallPoint>& points, float spacing_m) {
  std::vector<Keyed> keyed;
  keyed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    constexpr std::int64_t kBias = 1LL << 30;  // keeps negative squares in order
    const auto x = static_cast<std::int64_t>(std::floor(points[i].p.x() / spacing_m)) + kBias;
    const auto y = static_cast<std::int64_t>(std::floor(points[i].p.y() / spacing_m)) + kBias;
    keyed.push_back({(static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x),
                     static_cast<std::uint32_t>(i)});
  }
  std::sort(keyed.begin(), keyed.end());
  return keyed;
}

}  // namespace

std::vector<WallPoint> thin_out(const std::vector<WallPoint>& points, float spacing_m) {
  const std::vector<Keyed> keyed = order_by_square(points, spacing_m);
  std::vector<WallPoint> thinned;
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    add_to_clusters(points[keyed[i].index], clusters);
    if (i + 1 < keyed.size() && keyed[i + 1].square == keyed[i].square) continue;
    for (const Cluster& cluster : clusters) {
      const Eigen::Vector2f normal = cluster.normal.normalized();
      // A line crosses (|nx| + |ny|) / spacing squares per metre.
      const float length_m = spacing_m / (std::abs(normal.x()) + std::abs(normal.y()));
      thinned.push_back({cluster.p / cluster.count, normal, length_m});
    }
    clusters.clear();
  }
  return thinned;
}

}  // namespace lifeline::matching
