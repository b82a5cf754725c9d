#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "common/grid/ray_cast.hpp"
#include "common/grid/scan_surface.hpp"

namespace lifeline::slam {

/// M_k or D_k of the paper: points on surfaces, with their normals towards the free side.
struct PointSet {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector2d> normals;  ///< unit

  [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// D_k: a scan's surfaces, in the head frame.
[[nodiscard]] inline PointSet to_points(std::span<const SurfacePiece> pieces) {
  PointSet set;
  for (const SurfacePiece& piece : pieces) {
    set.points.push_back(piece.point.cast<double>());
    set.normals.push_back(piece.normal.cast<double>());
  }
  return set;
}

/// M_k: what the ray cast of the map gave, in the map frame.
[[nodiscard]] inline PointSet to_points(std::span<const RayHit> hits) {
  PointSet set;
  for (const RayHit& hit : hits) {
    set.points.push_back(hit.p_map);
    set.normals.push_back(hit.normal);
  }
  return set;
}

}  // namespace lifeline::slam
