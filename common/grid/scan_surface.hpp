#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/grid/scan2.hpp"

namespace lifeline {

/// A piece of surface that a scan shows, in the head frame: a short straight line through `point`.
struct SurfacePiece {
  Eigen::Vector2f point;    ///< smoothed along the surface
  Eigen::Vector2f normal;   ///< unit, towards the free side, where the lidar stands
  float left_m = 0.0F;      ///< how far the piece reaches to the left of the normal ...
  float right_m = 0.0F;     ///< ... and to the right
  float quality = 0.0F;     ///< (0, 1]: how well the piece is placed (range, incidence, neighbours)
  bool has_normal = false;  ///< from neighbours; else the normal points back along the beam
};

struct SurfaceConfig {
  float merge_m = 0.025F;         ///< hits closer together than this become one piece
  float fit_radius_m = 0.2F;      ///< neighbours along the surface that the normal is fitted to
  float line_rms_m = 0.02F;       ///< a fit worse than this is a corner: one-sided fits are tried
  float max_gap_m = 1.0F;         ///< neighbours further apart are never one surface
  float full_quality_m = 10.0F;   ///< quality falls with range beyond this
};

/// The surfaces a scan shows, in the order of its sweep. Neighbouring hits are one surface when their
/// distance fits the beams' spacing at that range, unless the surface is seen at a very flat angle.
[[nodiscard]] std::vector<SurfacePiece> extract_surface(const Scan2& scan,
                                                        const SurfaceConfig& config = {});

/// Whether two neighbouring hits show one surface. `spread_rad` is the angle between their beams.
[[nodiscard]] bool is_one_surface(const Beam2& a, const Beam2& b, float spread_rad,
                                  const SurfaceConfig& config);

}  // namespace lifeline
