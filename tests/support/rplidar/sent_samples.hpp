#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "tests/support/rplidar/frame_maker.hpp"

namespace lifeline::test {

/// A sample as the device sent it: its exact angle, and its distance.
struct SentSample {
  double angle_deg;  ///< in [0, 360)
  std::uint32_t quarters;
};

/// Ultra capsules leave it to the reader: 8 deg less the angle under which 24.01 mm appear at the
/// distance, and 7.5 deg where it is below 50 mm.
[[nodiscard]] inline double ultra_behind_deg(std::uint32_t quarters) {
  if (quarters < 200) return 7.5;
  return 8.0 - std::asin(24.0137 * 4.0 / quarters) * 180.0 / std::numbers::pi;
}

/// What the frames say, worked out in floating point: the angles of a frame are spread evenly up to
/// the next one's start, less what each lies behind. Of all frames but the last.
[[nodiscard]] inline std::vector<SentSample> sent_samples(std::span<const EmulatedFrame> frames) {
  std::vector<SentSample> samples;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
    const double start_deg = frames[k].start_q6 / 64.0;
    double turn_deg = frames[k + 1].start_q6 / 64.0 - start_deg;
    if (turn_deg < 0.0) turn_deg += 360.0;
    const auto count = static_cast<double>(frames[k].quarters.size());
    for (std::size_t i = 0; i < frames[k].quarters.size(); ++i) {
      double angle_deg = start_deg + turn_deg * static_cast<double>(i) / count;
      if (!frames[k].behind_q3.empty()) angle_deg -= frames[k].behind_q3[i] / 8.0;
      if (frames[k].quarters.size() == 96) angle_deg -= ultra_behind_deg(frames[k].quarters[i]);
      if (angle_deg < 0.0) angle_deg += 360.0;
      if (angle_deg >= 360.0) angle_deg -= 360.0;
      samples.push_back({angle_deg, frames[k].quarters[i]});
    }
  }
  return samples;
}

}  // namespace lifeline::test
