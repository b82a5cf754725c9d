#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "coordinator/matching/wall_points.hpp"

namespace lifeline::matching {
namespace {

// All radii in cells.
constexpr int kAxisRadius = 4;    // neighbourhood in which the wall's direction is estimated
constexpr int kSparseRadius = 8;  // the same where the wall was hit here and there only
constexpr int kFreeRadius = 3;    // how far the free side is looked for
constexpr int kLineRadius = 5;    // neighbourhood of the line fit
constexpr int kMinLinePoints = 3;
static_assert(kSparseRadius <= kWallMargin);

/// A neighbouring cell: how far it is, and in memory.
struct Neighbour {
  float x, y;
  std::ptrdiff_t step;
};

std::vector<Neighbour> disc(int radius, int columns) {
  std::vector<Neighbour> cells;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (dx * dx + dy * dy > radius * radius) continue;
      cells.push_back(
          {static_cast<float>(dx), static_cast<float>(dy), std::ptrdiff_t{dy} * columns + dx});
    }
  }
  return cells;
}

/// Sums of a point set, from which a line is fitted.
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

/// Finds which occupied cells are the face of a wall, and where they look.
class FaceFinder {
 public:
  explicit FaceFinder(const OccupancyGrid& grid)
      : grid_(grid),
        near_(disc(1, grid.columns)),
        axis_(disc(kAxisRadius, grid.columns)),
        sparse_(disc(kSparseRadius, grid.columns)),
        free_(disc(kFreeRadius, grid.columns)) {}

  [[nodiscard]] std::vector<Face> find() const {
    std::vector<Face> faces;
    for (int row = kWallMargin; row < grid_.rows - kWallMargin; ++row) {
      for (int column = kWallMargin; column < grid_.columns - kWallMargin; ++column) {
        const Occupancy* const cell = grid_.cells.data() + grid_.index(column, row);
        if (*cell == Occupancy::occupied) add_faces(cell, column, row, faces);
      }
    }
    return faces;
  }

 private:
  void add_faces(const Occupancy* cell, int column, int row, std::vector<Face>& faces) const {
    const bool touches_free = std::any_of(near_.begin(), near_.end(), [&](const Neighbour& n) {
      return cell[n.step] == Occupancy::free;
    });
    if (!touches_free) return;
    auto normal = normal_of(cell, axis_);
    if (!normal) normal = normal_of(cell, sparse_);
    if (!normal) return;
    const auto [ahead, behind] = free_shares(cell, *normal);
    if (is_free_side(ahead, behind) && is_foremost(cell, *normal)) {
      faces.push_back({column, row, *normal});
    }
    if (is_free_side(behind, ahead) && is_foremost(cell, -*normal)) {
      faces.push_back({column, row, -*normal});
    }
  }

  /// Direction across the wall, from the occupied cells among `around`.
  static std::optional<Eigen::Vector2f> normal_of(const Occupancy* cell,
                                                  const std::vector<Neighbour>& around) {
    LineSums sums;
    for (const Neighbour& n : around) {
      if (cell[n.step] == Occupancy::occupied) sums.add(n.x, n.y);
    }
    if (sums.n < kMinLinePoints) return std::nullopt;
    return sums.normal();
  }

  struct Shares {
    float ahead, behind;
  };
  /// Free cells in the half discs before and behind the cell.
  [[nodiscard]] Shares free_shares(const Occupancy* cell, const Eigen::Vector2f& normal) const {
    float free_ahead = 0, free_behind = 0, cells = 0;
    for (const Neighbour& n : free_) {
      const float ahead = n.x * normal.x() + n.y * normal.y();
      if (std::abs(ahead) < 0.9F) continue;
      cells += 0.5F;
      if (cell[n.step] != Occupancy::free) continue;
      (ahead > 0 ? free_ahead : free_behind) += 1;
    }
    return {free_ahead / cells, free_behind / cells};
  }

  /// A side is free where most of it was seen free; where only a few beams passed, more of them
  /// must have passed on this side than on the other.
  static bool is_free_side(float here, float there) {
    return here >= 0.6F || (here >= 0.2F && there <= 0.25F * here);
  }

  /// Whether the next cell towards `normal` is not wall any more.
  [[nodiscard]] bool is_foremost(const Occupancy* cell, const Eigen::Vector2f& normal) const {
    const auto x = static_cast<std::ptrdiff_t>(std::lround(1.3F * normal.x()));
    const auto y = static_cast<std::ptrdiff_t>(std::lround(1.3F * normal.y()));
    return cell[y * grid_.columns + x] != Occupancy::occupied;
  }

  const OccupancyGrid& grid_;
  std::vector<Neighbour> near_, axis_, sparse_, free_;
};

/// Fits lines to the faces that look the same way.
class LineFitter {
 public:
  LineFitter(const std::vector<Face>& faces, int rows)
      : faces_(faces), starts_(static_cast<std::size_t>(rows) + 1, faces.size()) {
    // Faces are ordered by row: where each row begins.
    for (std::size_t i = faces.size(); i-- > 0;)
      starts_[static_cast<std::size_t>(faces[i].row)] = i;
    for (std::size_t r = starts_.size() - 1; r-- > 0;) {
      starts_[r] = std::min(starts_[r], starts_[r + 1]);
    }
  }

  /// The point of the line nearest to the middle of the face's cell, in cells; nothing where the
  /// faces around are too few or a blob.
  [[nodiscard]] std::optional<WallPoint> fit(const Face& face, int radius) const {
    const LineSums sums = sum_around(face, radius);
    if (sums.n < kMinLinePoints) return std::nullopt;
    Eigen::Vector2f normal = sums.normal();
    if (normal.dot(face.normal) < 0) normal = -normal;
    if (normal.dot(face.normal) < kSameWay) return std::nullopt;
    const Eigen::Vector2f middle(static_cast<float>(face.column) + 0.5F,
                                 static_cast<float>(face.row) + 0.5F);
    return WallPoint{middle + normal * normal.dot(sums.mean()), normal, 1.0F};
  }

 private:
  static constexpr float kSameWay = 0.7F;

  [[nodiscard]] LineSums sum_around(const Face& face, int radius) const {
    LineSums sums;
    const int last_row = std::min(static_cast<int>(starts_.size()) - 2, face.row + radius);
    for (int row = std::max(0, face.row - radius); row <= last_row; ++row) {
      const Face* other = faces_.data() + starts_[static_cast<std::size_t>(row)];
      const Face* const end = faces_.data() + starts_[static_cast<std::size_t>(row) + 1];
      other = std::lower_bound(other, end, face.column - radius,
                               [](const Face& f, int column) { return f.column < column; });
      for (; other != end && other->column <= face.column + radius; ++other) {
        if (other->normal.dot(face.normal) < kSameWay) continue;
        sums.add(static_cast<float>(other->column - face.column),
                 static_cast<float>(other->row - face.row));
      }
    }
    return sums;
  }

  const std::vector<Face>& faces_;
  std::vector<std::size_t> starts_;
};

}  // namespace

std::vector<WallPoint> wall_points(const OccupancyGrid& grid) {
  const std::vector<Face> faces = FaceFinder(grid).find();
  const LineFitter fitter(faces, grid.rows);
  const auto cell_m = static_cast<float>(grid.cell_size_m);
  std::vector<WallPoint> points;
  points.reserve(faces.size());
  for (const Face& face : faces) {
    auto point = fitter.fit(face, kLineRadius);
    if (!point) point = fitter.fit(face, 2 * kLineRadius);
    if (point) points.push_back({cell_m * point->p, point->normal, cell_m});
  }
  return points;
}

}  // namespace lifeline::matching
