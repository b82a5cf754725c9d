#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "agents/slam/working_map.hpp"
#include "common/grid/tsd_update.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline::slam {

/// A small flat as six scans from random places show it; the parameter is the seed.
class MappedFlat : public ::testing::TestWithParam<unsigned> {
 protected:
  MappedFlat() : random(GetParam()) {
    TsdUpdater updater(kGeometry, {});
    for (int i = 0; i < 6; ++i) {
      const Pose2 T = random_pose();
      (void)updater.push(extract_surface(support::scan_of(support::small_flat(), T)), T, 1.0,
                         map.own());
    }
  }
  Pose2 random_pose() {
    std::uniform_real_distribution<double> near(-1.2, 1.2), turn(-M_PI, M_PI);
    return {near(random), near(random), turn(random)};
  }
  /// A scan of few points, so that none is left out.
  std::vector<SurfacePiece> pieces_at(const Pose2& T) {
    const support::Lidar lidar{.beams = 90, .step_rad = M_PI / 45.0, .noise_m = 0.01};
    return extract_surface(support::scan_of(support::small_flat(), T, lidar, &random));
  }

  std::mt19937 random;
  WorkingMap map{kGeometry};
};

}  // namespace lifeline::slam
