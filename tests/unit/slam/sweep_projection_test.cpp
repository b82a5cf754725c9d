// A scan whose attitude changes within the sweep.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "agents/sensing/head_projection.hpp"

namespace lifeline::sensing {
namespace {

/// Beams straight ahead, all of 2 m, over a tenth of a second.
RawScan sweep_ahead(std::size_t beams) {
  RawScan raw;
  raw.angle_step_rad = 1e-9;
  raw.range_max_m = 25.0;
  raw.ranges_m.assign(beams, 2.0F);
  raw.sweep_time = std::chrono::milliseconds(100);
  raw.attitude = Attitude{};
  return raw;
}

TEST(SweepProjection, BeamsTakenWhileTheHeadWasTooSteepAreInvalid) {
  RawScan raw = sweep_ahead(11);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double pitch : {1.5, nan}) {
    raw.later_attitudes = {{std::chrono::milliseconds(45), Attitude{}},
                           {std::chrono::milliseconds(55), Attitude{0.0, pitch, 0.0}},
                           {std::chrono::milliseconds(65), Attitude{}}};
    const Scan2 scan = project_scan(raw, {});
    ASSERT_EQ(scan.beams.size(), 11U);
    for (std::size_t i = 0; i < 11; ++i) {
      EXPECT_EQ(scan.beams[i].kind, i == 5 || i == 6 ? BeamKind::invalid : BeamKind::hit) << i;
      EXPECT_TRUE(std::isfinite(scan.beams[i].angle_rad));
    }
  }
}

TEST(SweepProjection, WithoutAYawOnlyTheLeaningWithinTheSweepIsUndone) {
  RawScan raw = sweep_ahead(2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double yaw : {0.0, nan}) {
    raw.attitude = Attitude{0.0, 0.0, yaw};
    raw.later_attitudes = {{std::chrono::milliseconds(100), Attitude{0.0, 0.3, yaw + 0.2}}};
    const Scan2 scan = project_scan(raw, {});
    EXPECT_EQ(scan.turn_undone, yaw == 0.0);
    ASSERT_EQ(scan.beams[1].kind, BeamKind::hit);
    EXPECT_NEAR(scan.beams[1].range_m, 2.0 * std::cos(0.3), 1e-6);
    EXPECT_NEAR(scan.beams[1].angle_rad, yaw == 0.0 ? 0.2 : 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace lifeline::sensing
