// A simulated walk, mapped by the real SLAM: the HUD knows the way out, by floor that was seen.

#include <algorithm>

#include <gtest/gtest.h>

#include "agents/helmet_mapper.hpp"
#include "agents/hud/hud_core.hpp"
#include "agents/sources/open_source.hpp"
#include "tests/support/hud_samples.hpp"

namespace lifeline::hud {
namespace {

/// Every 2 cm, to a cell.
bool is_off_the_floor(const HudMap& map, const Path& path) {
  for (std::size_t i = 2; i + 1 < path.size(); ++i) {  // both ends may lie beside a wall
    const Eigen::Vector2d step = path[i] - path[i - 1];
    for (double t = 0.0; t <= 1.0; t += 0.02 / std::max(0.02, step.norm())) {
      const Eigen::Vector2d p_m = path[i - 1] + t * step;
      const CellIndex cell = cell_at(p_m, map.cell_size_m());
      bool floor = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx)
          floor = floor || map.at({cell.x + dx, cell.y + dy}) == Occupancy::free;
      }
      if (!floor) return true;
    }
  }
  return false;
}

class HudOnAWalk : public testing::TestWithParam<std::string> {};

TEST_P(HudOnAWalk, TheWayOutIsKnownAndLeadsOverFloorThatWasSeen) {
  auto scans = sources::open_source(GetParam()).value();
  HelmetMapper mapper({}, {}, {});
  HudCore core(0.05);
  SteadyTime now{std::chrono::hours(1)};
  int looks = 0, free_ways = 0;
  for (int scan = 1;; ++scan) {
    const auto next = scans->next().value();
    if (!next) break;
    mapper.step(*next);
    if (scan % 10 != 0) continue;
    now += std::chrono::seconds(1);
    core.put(mapper.take_changed_tiles());
    HudFacts facts = test::sound_facts(now);
    facts.state = mapper.state();
    core.put(facts, now);
    const HudPicture& picture = core.step(now);
    if (!picture.way_out) continue;
    ++looks;
    const HudWayOut& way = *picture.way_out;
    const double straight_m = (way.points.back() - way.points.front()).norm();
    EXPECT_GE(way.length_m, straight_m - 1e-6);
    if (way.by_own_trail) continue;
    ++free_ways;
    EXPECT_FALSE(is_off_the_floor(core.map(), way.points)) << "after scan " << scan;
  }
  EXPECT_GE(looks, 50);
  // The rest by the own trail, which leads through doorways that the map closed (decision 0907).
  EXPECT_GE(free_ways, looks / 5) << "of " << looks;
}

INSTANTIATE_TEST_SUITE_P(
    Offices, HudOnAWalk,
    testing::Values("sim:office?walkers=2&walker=0&seed=1&beams=400&duration=60",
                    "sim:office?walkers=2&walker=1&seed=1&beams=400&duration=60",
                    "sim:office?seed=3&walk_seed=5&beams=400&duration=60"));

}  // namespace
}  // namespace lifeline::hud
