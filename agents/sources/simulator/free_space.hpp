#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"
#include "common/grid/tile_index.hpp"

namespace lifeline::sources {

/// The floor of a plan as a raster: how far each place is from the walls, and where a person can
/// walk. Only the largest connected piece of floor counts as walkable.
class FreeSpace {
 public:
  static constexpr double kCellM = 0.05;
  /// Distances to walls are told apart up to here.
  static constexpr double kFarM = 0.8;

  /// A person keeps 0.35 m from walls, but down to 0.25 m where a plan's doors are too narrow for
  /// that. bad_data where nothing of at least 1 m^2 remains.
  [[nodiscard]] static Result<FreeSpace> make(const FloorPlan& plan);

  /// What is kept from every wall, metres: true for every point of a walkable cell.
  [[nodiscard]] double kept_distance_m() const { return kept_distance_m_; }

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] bool contains(CellIndex cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < columns_ && cell.y < rows_;
  }
  /// Of a cell that the raster contains, row by row; to be used with arrays of size().
  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.x);
  }
  [[nodiscard]] std::size_t size() const { return distance_m_.size(); }
  [[nodiscard]] CellIndex cell(std::size_t index) const;
  [[nodiscard]] CellIndex cell_at(const Eigen::Vector2d& p_world) const;
  [[nodiscard]] Eigen::Vector2d centre(CellIndex cell) const;

  [[nodiscard]] bool is_floor(CellIndex cell) const { return has(cell, kFloor); }
  [[nodiscard]] bool is_walkable(CellIndex cell) const { return has(cell, kWalkable); }
  /// From the cell's centre to the nearest wall, at most kFarM.
  [[nodiscard]] double distance_m(CellIndex cell) const { return distance_m_[index(cell)]; }

  /// Whether a person can go straight from a to b, staying in cells whose centre is at least
  /// `distance_m` from the walls.
  [[nodiscard]] bool can_go(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                            double distance_m = 0.0) const;
  /// Whether the straight line between the cells' centres stays on floor.
  [[nodiscard]] bool can_see(CellIndex a, CellIndex b) const;

 private:
  static constexpr std::uint8_t kFloor = 1;
  static constexpr std::uint8_t kWalkable = 2;

  explicit FreeSpace(const FloorPlan& plan);
  [[nodiscard]] bool has(CellIndex cell, std::uint8_t flag) const {
    return contains(cell) && (flags_[index(cell)] & flag) != 0;
  }
  void mark_floor(const FloorPlan& plan);
  void measure_distances(const FloorPlan& plan);
  [[nodiscard]] std::vector<std::uint32_t> largest_piece(double kept_distance_m) const;

  Eigen::Vector2d lower_;
  int columns_ = 0;
  int rows_ = 0;
  double kept_distance_m_ = 0.0;
  std::vector<float> distance_m_;
  std::vector<std::uint8_t> flags_;
};

}  // namespace lifeline::sources
