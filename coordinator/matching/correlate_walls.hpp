#pragma once

#include <cstddef>
#include <vector>

#include "common/grid/pose2.hpp"
#include "coordinator/matching/map_features.hpp"

namespace lifeline::matching {

/// A maximum of the 2D correlation of two maps' walls at one rotation.
struct CorrelationPeak {
  Pose2 T_a_b;         ///< between the local frames; the translation is good to about a square
  float value = 0.0F;  ///< about agreeing less conflicting wall, metres
};

/// For every translation, with b turned by `yaw_rad`: how much wall lies on wall that faces the
/// same way, less `conflict_weight` times the wall that lies in the other map's clear space. Pairs
/// of wall points vote directly instead of through a Fourier transform: walls fill little of the
/// plane, and only one direction in six or so counts. Returns the `count` highest local maxima,
/// from high to low.
[[nodiscard]] std::vector<CorrelationPeak> correlate_walls(const MapFeatures& a,
                                                           const MapFeatures& b, double yaw_rad,
                                                           float conflict_weight,
                                                           std::size_t count);

}  // namespace lifeline::matching
