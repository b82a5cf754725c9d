#include "common/grid/ray_cast.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/grid/tsd_update.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline {
namespace {

using support::FlatWorld;
using support::scan_of;

/// Cells of x in [x0, x1), for all |y| < 2 m, hold the distance to a wall at `wall_x` seen from
/// below.
void fill(TsdGrid& grid, double x0, double x1, double wall_x) {
  for (double x = x0 + 0.025; x < x1; x += 0.05) {
    for (double y = -1.975; y < 2.0; y += 0.05) {
      const CellIndex i = grid.cell_at({x, y});
      const double tsd = std::clamp((wall_x - grid.centre_of(i).x()) / 0.15, -1.0, 1.0);
      grid.at(tile_of(i))[offset_in_tile(i)] = {
          static_cast<std::int16_t>(std::lround(tsd * TsdCell::kTsdOne)), TsdCell::kWeightOne};
    }
  }
}

TsdView view_of(const TsdGrid& grid) {
  TsdView view;
  view.assign(grid, {0.0, 0.0}, 12.0);
  return view;
}

TEST(CastRay, MeetsTheZeroCrossingToAFractionOfACell) {
  TsdGrid grid(kGeometry);
  fill(grid, 0.0, 3.1, 3.013);
  const TsdView view = view_of(grid);
  for (const double angle : {0.0, 0.2, -0.3}) {
    const auto hit = cast_ray(view, {0.5, 0.1}, angle, 10.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->p_map.x(), 3.013, 1e-3);
    EXPECT_NEAR(hit->p_map.y(), 0.1 + 2.513 * std::tan(angle), 1e-3);
    EXPECT_NEAR(hit->range_m, 2.513 / std::cos(angle), 1e-3);
    EXPECT_NEAR(hit->normal.x(), -1.0, 1e-3);
  }
}

TEST(CastRay, UnknownSpaceStopsNothing) {
  TsdGrid grid(kGeometry);
  fill(grid, 0.0, 1.0, 9.0);
  fill(grid, 2.0, 3.1, 3.0);
  const auto hit = cast_ray(view_of(grid), {0.5, 0.0}, 0.0, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->p_map.x(), 3.0, 1e-3);
}

TEST(CastRay, NoSurfaceIsMetComingOutOfTheUnknown) {
  TsdGrid grid(kGeometry);
  fill(grid, 0.0, 1.0, 9.0);
  fill(grid, 3.0, 3.5, 2.9);  // known from its inside only
  EXPECT_FALSE(cast_ray(view_of(grid), {0.5, 0.0}, 0.0, 10.0));
}

TEST(CastRay, SurfacesAreNotMetFromBehind) {
  TsdGrid grid(kGeometry);
  fill(grid, 2.0, 3.1, 3.0);
  EXPECT_FALSE(cast_ray(view_of(grid), {4.0, 0.0}, M_PI, 10.0));
}

TEST(CastRay, NothingWithinReachIsEmpty) {
  TsdGrid grid(kGeometry);
  fill(grid, 0.0, 3.1, 3.0);
  EXPECT_FALSE(cast_ray(view_of(grid), {0.5, 0.0}, 0.0, 2.0));
  EXPECT_TRUE(cast_ray(view_of(grid), {0.5, 0.0}, 0.0, 2.6));
  EXPECT_FALSE(cast_ray(view_of(TsdGrid(kGeometry)), {0.0, 0.0}, 0.0, 10.0));
}

TEST(RayCast, APushedScanComesBackFromAnotherPlace) {
  const FlatWorld world = support::small_flat();
  TsdGrid grid(kGeometry);
  TsdUpdater updater(kGeometry, {});
  for (double x = -1.0; x < 1.2; x += 0.2) {
    const Pose2 T{x, 0.3, 0.1 * x};
    (void)updater.push(extract_surface(scan_of(world, T)), T, 1.0, grid);
  }
  const Pose2 elsewhere{0.33, 0.21, 0.7};
  const Scan2 truth = scan_of(world, elsewhere);
  const auto model = ray_cast(view_of(grid), elsewhere, truth, 30.0);
  EXPECT_GT(model.size(), 300U);
  std::size_t good = 0;
  for (const RayHit& hit : model) {
    good += world.distance(hit.p_map) < 0.02 ? 1U : 0U;
    EXPECT_NEAR(hit.normal.norm(), 1.0, 1e-6);
    EXPECT_LT(hit.normal.dot(hit.p_map - elsewhere.translation()), 0.0);
  }
  EXPECT_GT(static_cast<double>(good), 0.95 * static_cast<double>(model.size()));
}

TEST(TsdView, ReadsAcrossTilesAndKnowsItsBounds) {
  TsdGrid grid(kGeometry);
  fill(grid, -4.0, 4.0, 3.25);
  const TsdView view = view_of(grid);
  TsdView::Sample sample{};
  // Across the corner of four tiles, at (3.2, 0), the field stays linear.
  for (double x = -0.06; x < 0.06; x += 0.01) {
    const Pose2 p = view.to_view({3.2 + x, 0.01, 0.0});
    ASSERT_TRUE(view.sample(static_cast<float>(p.x_m), static_cast<float>(p.y_m), sample));
    EXPECT_NEAR(sample.value, (0.05 - x) / 0.15, 1e-3);
  }
  EXPECT_FALSE(view.sample(-5.0F, 0.0F, sample));
  EXPECT_FALSE(view.sample(1e6F, 1e6F, sample));
  EXPECT_FALSE(view.cell(-1, 5).known());
}

TEST(TsdView, SamplesNothingWhereACornerIsUnknown) {
  TsdGrid grid(kGeometry);
  fill(grid, 0.0, 1.0, 0.9);
  const TsdView view = view_of(grid);
  TsdView::Sample sample{};
  const Pose2 inside = view.to_view({0.5, 0.5, 0.0}), edge = view.to_view({0.99, 0.5, 0.0});
  EXPECT_TRUE(view.sample(static_cast<float>(inside.x_m), static_cast<float>(inside.y_m), sample));
  EXPECT_FALSE(view.sample(static_cast<float>(edge.x_m), static_cast<float>(edge.y_m), sample));
}

}  // namespace
}  // namespace lifeline
