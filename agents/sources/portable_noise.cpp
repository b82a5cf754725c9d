#include "agents/sources/portable_noise.hpp"

#include <numbers>

#include "common/grid/pose2.hpp"

namespace lifeline::sources {

double NoisyYaw::measure(double true_yaw_rad) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  walk_rad_ += kWalkSigmaDegPerScan * kRadPerDeg * noise_.next();
  const double white_rad = kWhiteSigmaDeg * kRadPerDeg * noise_.next();
  return normalise_angle(true_yaw_rad + walk_rad_ + white_rad);
}

}  // namespace lifeline::sources
