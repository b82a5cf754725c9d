#include "agents/sources/simulator/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lifeline::sources {
namespace {

/// From a cell's centre to its corner, and a little for the steps of can_go().
constexpr double kHalfCellM = 0.045;
constexpr double kStepM = 0.0125;

}  // namespace

FreeSpace::FreeSpace(const FloorPlan& plan) {
  const Eigen::AlignedBox2d box = plan.bounds();
  lower_ = box.min() - Eigen::Vector2d::Constant(2.0 * kCellM);
  columns_ = static_cast<int>(box.sizes().x() / kCellM) + 5;
  rows_ = static_cast<int>(box.sizes().y() / kCellM) + 5;
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  distance_m_.assign(cells, static_cast<float>(kFarM));
  flags_.assign(cells, 0);
  mark_floor(plan);
  measure_distances(plan);
}

Result<FreeSpace> FreeSpace::make(const FloorPlan& plan) {
  if (plan.walls.empty()) return fail(ErrorCode::bad_data, "{}: has no walls", plan.name);
  FreeSpace space(plan);
  constexpr std::array<double, 3> kKept{0.35, 0.30, 0.25};
  const std::array<std::ptrdiff_t, kKept.size()> wide = [&] {
    std::array<std::ptrdiff_t, kKept.size()> counts{};
    const std::vector<std::uint32_t> most = space.largest_piece(kKept.back());
    for (std::size_t k = 0; k < counts.size(); ++k) {
      counts[k] = std::count_if(most.begin(), most.end(), [&](std::uint32_t i) {
        return space.distance_m_[i] >= static_cast<float>(kKept[k] + kHalfCellM);
      });
    }
    return counts;
  }();
  std::vector<std::uint32_t> piece;
  for (std::size_t k = 0; k < kKept.size(); ++k) {
    piece = {};  // not two of them at once
    piece = space.largest_piece(kKept[k]);
    space.kept_distance_m_ = kKept[k];
    // Is everything that is wide enough for this distance also reached with it?
    if (static_cast<double>(piece.size()) >= 0.97 * static_cast<double>(wide[k])) break;
  }
  if (static_cast<double>(piece.size()) * kCellM * kCellM < 1.0) {
    return fail(ErrorCode::bad_data, "{}: has no floor that is wide enough to walk on", plan.name);
  }
  for (const std::uint32_t i : piece) space.flags_[i] |= kWalkable;
  return space;
}

CellIndex FreeSpace::cell(std::size_t index) const {
  const auto columns = static_cast<std::size_t>(columns_);
  return {static_cast<std::int32_t>(index % columns), static_cast<std::int32_t>(index / columns)};
}

CellIndex FreeSpace::cell_at(const Eigen::Vector2d& p_world) const {
  const Eigen::Vector2d p = (p_world - lower_) / kCellM;
  return {static_cast<std::int32_t>(std::floor(p.x())),
          static_cast<std::int32_t>(std::floor(p.y()))};
}

Eigen::Vector2d FreeSpace::centre(CellIndex cell) const {
  return lower_ + Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5) * kCellM;
}

bool FreeSpace::can_go(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       double distance_m) const {
  const int steps = static_cast<int>((b - a).norm() / kStepM) + 1;
  for (int i = 0; i <= steps; ++i) {
    const CellIndex cell = cell_at(a + (b - a) * (static_cast<double>(i) / steps));
    if (!is_walkable(cell) || this->distance_m(cell) < distance_m) return false;
  }
  return true;
}

bool FreeSpace::can_see(CellIndex a, CellIndex b) const {
  const std::int32_t dx = b.x - a.x, dy = b.y - a.y;
  const std::int32_t steps = 2 * std::max(std::abs(dx), std::abs(dy)) + 1;
  const auto rounded = [steps](std::int32_t distance) {  // divided by steps
    return (2 * distance + (distance < 0 ? -steps : steps)) / (2 * steps);
  };
  for (std::int32_t i = 0; i <= steps; ++i) {
    if (!is_floor({a.x + rounded(i * dx), a.y + rounded(i * dy)})) return false;
  }
  return true;
}

/// Even-odd rule along the middle of every row of cells; half-open in y, so that a corner that two
/// walls share counts once.
void FreeSpace::mark_floor(const FloorPlan& plan) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows_));
  const auto first_row_above = [&](double y) {
    return static_cast<int>(std::ceil((y - lower_.y()) / kCellM - 0.5));
  };
  for (const WallSegment& wall : plan.walls) {
    const auto [low, high] = std::minmax(wall.a.y(), wall.b.y());
    const int end = std::min(first_row_above(high), rows_);
    for (int row = std::max(first_row_above(low), 0); row < end; ++row) {
      const double y = lower_.y() + (row + 0.5) * kCellM;
      const double share = (y - wall.a.y()) / (wall.b.y() - wall.a.y());
      crossings[static_cast<std::size_t>(row)].push_back(wall.a.x() +
                                                         share * (wall.b.x() - wall.a.x()));
    }
  }
  for (int row = 0; row < rows_; ++row) {
    std::vector<double>& at = crossings[static_cast<std::size_t>(row)];
    std::sort(at.begin(), at.end());
    for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
      const auto column_after = [&](double x) {
        return std::clamp(static_cast<int>(std::ceil((x - lower_.x()) / kCellM - 0.5)), 0,
                          columns_);
      };
      for (int column = column_after(at[i]); column < column_after(at[i + 1]); ++column) {
        flags_[index({column, row})] |= kFloor;
      }
    }
  }
}

void FreeSpace::measure_distances(const FloorPlan& plan) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(kFarM);
  std::vector<WallSegment> walls = plan.walls;
  walls.insert(walls.end(), plan.panes.begin(), plan.panes.end());
  for (const WallSegment& wall : walls) {
    // Piece by piece, so that a long slanted wall does not touch the whole raster.
    const int pieces = static_cast<int>((wall.b - wall.a).norm()) + 1;
    for (int i = 0; i < pieces; ++i) {
      const WallSegment piece{wall.a + (wall.b - wall.a) * (static_cast<double>(i) / pieces),
                              wall.a + (wall.b - wall.a) * (static_cast<double>(i + 1) / pieces)};
      const CellIndex low = cell_at(piece.a.cwiseMin(piece.b) - reach);
      const CellIndex high = cell_at(piece.a.cwiseMax(piece.b) + reach);
      for (int y = std::max(low.y, 0); y <= std::min(high.y, rows_ - 1); ++y) {
        for (int x = std::max(low.x, 0); x <= std::min(high.x, columns_ - 1); ++x) {
          float& distance = distance_m_[index({x, y})];
          distance = std::min(distance, static_cast<float>(distance_to(piece, centre({x, y}))));
        }
      }
    }
  }
}

std::vector<std::uint32_t> FreeSpace::largest_piece(double kept_distance_m) const {
  const auto least = static_cast<float>(kept_distance_m + kHalfCellM);
  std::vector<bool> seen(size());
  std::vector<std::uint32_t> largest, piece;
  for (std::size_t seed = 0; seed < size(); ++seed) {
    piece.clear();
    const auto reach = [&](CellIndex next) {
      if (!is_floor(next)) return;
      const auto i = static_cast<std::uint32_t>(index(next));
      if (seen[i] || distance_m_[i] < least) return;
      seen[i] = true;
      piece.push_back(i);
    };
    reach(cell(seed));
    for (std::size_t done = 0; done < piece.size(); ++done) {
      const CellIndex from = cell(piece[done]);
      reach({from.x + 1, from.y});
      reach({from.x - 1, from.y});
      reach({from.x, from.y + 1});
      reach({from.x, from.y - 1});
    }
    if (piece.size() > largest.size()) largest.swap(piece);
  }
  return largest;
}

}  // namespace lifeline::sources
