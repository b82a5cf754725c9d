#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sources/simulator/free_space.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

/// The floor that a source's beams have passed over, cell by cell.
std::vector<bool> explored(const FreeSpace& space, const std::string& source) {
  std::vector<bool> seen(space.size());
  for (const auto& scan : support::scans_of(source)) {
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double angle = scan.first_angle_rad + scan.angle_step_rad * static_cast<double>(i);
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      if (!std::isfinite(scan.ranges_m[i])) continue;
      for (double r = 0.0; r < static_cast<double>(scan.ranges_m[i]); r += FreeSpace::kCellM) {
        const CellIndex cell = space.cell_at(*scan.T_world_head_truth * (r * direction));
        if (space.is_floor(cell)) seen[space.index(cell)] = true;
      }
    }
  }
  return seen;
}

double count(const std::vector<bool>& cells) {
  return static_cast<double>(std::count(cells.begin(), cells.end(), true));
}

TEST(ExploredOverlap, ThreeWalkersOfAnOfficeShareEnoughOfItToMergeTheirMaps) {
  for (const char* building : {"seed=1", "seed=2&walk_seed=2"}) {
    SCOPED_TRACE(building);
    const std::string source =
        std::string("sim:office?hz=2&beams=360&noise=0&duration=90&walkers=3&") + building;
    const FloorPlan plan = load_plan(parse_source_spec(source).value()).value();
    const FreeSpace space = FreeSpace::make(plan).value();
    std::vector<std::vector<bool>> seen;
    for (const char* walker : {"0", "1", "2"}) {
      seen.push_back(explored(space, source + "&walker=" + walker));
    }
    std::vector<bool> together(space.size());
    for (std::size_t i = 0; i < space.size(); ++i)
      together[i] = seen[0][i] || seen[1][i] || seen[2][i];
    const double floor_cells = plan.floor_area_m2() / (FreeSpace::kCellM * FreeSpace::kCellM);
    EXPECT_GT(count(together), 0.85 * floor_cells);
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_LT(count(seen[a]), 0.97 * count(together)) << "nobody sees everything alone";
      for (std::size_t b = a + 1; b < 3; ++b) {
        std::vector<bool> both(space.size());
        for (std::size_t i = 0; i < space.size(); ++i) both[i] = seen[a][i] && seen[b][i];
        EXPECT_GT(count(both), 0.4 * std::min(count(seen[a]), count(seen[b])))
            << "walkers " << a << " and " << b;
      }
    }
  }
}

}  // namespace
}  // namespace lifeline::sources
