#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/grid/point_transform.hpp"
#include "common/grid/scan2.hpp"

namespace lifeline {

/// How a piece of surface goes with the one before it in the sweep.
enum class SurfaceLink : std::uint8_t {
  none,    ///< some beam between them saw no surface
  jump,    ///< neighbouring beams, but surfaces of different depth
  joined,  ///< one surface
};

/// A piece of surface that a scan shows, in the head frame: a short straight line through `point`.
struct SurfacePiece {
  Eigen::Vector2f point;   ///< smoothed along the surface
  Eigen::Vector2f normal;  ///< unit, towards the free side, where the lidar stands
  float left_m = 0.0F;     ///< how far the piece reaches to the left of the normal ...
  float right_m = 0.0F;    ///< ... and to the right
  float quality = 0.0F;    ///< (0, 1]: how well the piece is placed (range, incidence, neighbours)
  SurfaceLink link = SurfaceLink::none;  ///< to the piece before it; of the first, to the last
  bool has_normal = false;  ///< from neighbours; else the normal points back along the beam
};

/// The piece in another frame.
[[nodiscard]] inline SurfacePiece moved(SurfacePiece piece, const PointTransform& T_a_b) {
  piece.point = (T_a_b * piece.point.cast<double>()).cast<float>();
  piece.normal = T_a_b.turned(piece.normal.cast<double>()).cast<float>();
  return piece;
}

struct SurfaceConfig {
  float merge_m = 0.025F;          ///< hits closer together than this become one piece
  float fit_radius_m = 0.2F;       ///< neighbours on the surface that the normal is fitted to
  float line_rms_m = 0.02F;        ///< a worse fit is a corner: one-sided fits are tried
  float max_gap_m = 1.0F;          ///< neighbours further apart are one surface only if in line ...
  float max_gap_in_line_m = 3.0F;  ///< ... and up to here
  float max_spread_rad = 0.09F;    ///< beams further apart than this are no neighbours
  double range_sigma_m = 0.03;     ///< of a reading ...
  double heading_sigma_rad = 0.005;  ///< ... and of the head's yaw: it moves far surfaces sideways
};

/// The surfaces a scan shows, in the order of its sweep. Neighbouring hits are one surface when
/// their distance fits the beams' spacing at that range, or when they lie in line with a third: so
/// a wall seen at a flat angle stays in one piece.
[[nodiscard]] std::vector<SurfacePiece> extract_surface(const Scan2& scan,
                                                        const SurfaceConfig& config = {});

}  // namespace lifeline
