// The push against a slow reference, and what must hold for any scene.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "common/grid/ray_cast.hpp"
#include "common/grid/tsd_update.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline {
namespace {

using support::FlatWorld;
using support::scan_of;

/// A room with some random furniture; always the same for the same seed.
FlatWorld random_world(std::mt19937& random) {
  std::uniform_real_distribution<double> where(-3.5, 3.5), size(0.2, 1.2), wall(4.0, 6.0);
  FlatWorld world;
  // One after the other: in which order a call's arguments are drawn is the compiler's choice.
  const double x0 = -wall(random), y0 = -wall(random), x1 = wall(random), y1 = wall(random);
  world.add_box(x0, y0, x1, y1);
  for (int i = 0; i < 6; ++i) {
    const double x = where(random), y = where(random);
    if (std::hypot(x, y) < 1.5) continue;
    const double width = size(random), depth = size(random);
    if (i % 2 == 0) {
      world.add_box(x, y, x + width, y + depth);
    } else {
      world.add(x, y, x + width, y - depth);
    }
  }
  return world;
}

Pose2 random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> near(-0.8, 0.8), turn(-M_PI, M_PI);
  const double x_m = near(random), y_m = near(random);
  return {x_m, y_m, turn(random)};
}

/// How far the farther one sees of the two beams beside a direction: a wall without thickness may
/// stand between them.
double seen_m(const FlatWorld& world, const Pose2& T, const Eigen::Vector2d& to) {
  const support::Lidar lidar;
  const double first = T.yaw_rad + lidar.first_angle_rad;
  const double beam = std::floor((std::atan2(to.y(), to.x()) - first) / lidar.step_rad);
  return std::max(world.range(T.translation(), first + beam * lidar.step_rad),
                  world.range(T.translation(), first + (beam + 1.0) * lidar.step_rad));
}

/// tsdf_k by brute force: each cell asks every piece how far it is.
class SlowBand {
 public:
  SlowBand(std::span<const SurfacePiece> pieces, const Pose2& T) : pieces_(pieces), T_(T) {}

  /// The distance to the nearest piece's line whose strip holds `p_map`; NaN outside of all.
  [[nodiscard]] double distance(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d p = T_.inverse() * p_map;
    double best = std::nan("");
    for (const SurfacePiece& piece : pieces_) {
      const Eigen::Vector2d n = piece.normal.cast<double>(), off = p - piece.point.cast<double>();
      const double left = -n.y() * off.x() + n.x() * off.y(), d = n.dot(off);
      if (left > piece.left_m || left < -piece.right_m || d > 0.15 || d < -0.15) continue;
      const double loss = d < 0.0 ? std::pow(1.0 + d / 0.15, 2) : 1.0;
      if (piece.quality * loss * TsdCell::kWeightOne < 0.5) continue;
      if (std::isnan(best) || std::abs(d) < std::abs(best)) best = d;
    }
    return best;
  }

 private:
  std::span<const SurfacePiece> pieces_;
  Pose2 T_;
};

/// Calls use(index, cell) for each known cell.
template <typename Use>
void each_known(const TsdGrid& grid, Use&& use) {
  for (const TileIndex tile : grid.tiles()) {
    for (int y = 0; y < kTileSide; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        const CellIndex i{first_cell(tile).x + x, first_cell(tile).y + y};
        if (grid.cell(i).known()) use(i, grid.cell(i));
      }
    }
  }
}

TEST(PushProperty, FastRasterAgreesWithTheSlowReference) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 6; ++trial) {
    const FlatWorld world = random_world(random);
    const Pose2 T = random_pose(random);
    const auto pieces = extract_surface(scan_of(world, T));
    TsdGrid grid(kGeometry);
    TsdUpdater updater(kGeometry, {});
    (void)updater.push(pieces, T, 1.0, grid);
    const SlowBand slow(pieces, T);
    std::size_t in_band = 0, differ = 0, free = 0, through_walls = 0;
    each_known(grid, [&](CellIndex i, TsdCell cell) {
      const Eigen::Vector2d centre = grid.centre_of(i);
      const double d = slow.distance(centre);
      if (std::isnan(d)) {
        ++free;  // only free space is drawn outside of the band
        EXPECT_EQ(cell.tsd, TsdCell::kTsdOne);
        // And only where the lidar really sees that far.
        const Eigen::Vector2d to = centre - T.translation();
        through_walls += seen_m(world, T, to) < to.norm() ? 1U : 0U;
      } else {
        ++in_band;
        differ += std::abs(cell.value() - d / 0.15) > 0.01 ? 1U : 0U;
      }
    });
    EXPECT_GT(in_band, 500U);
    EXPECT_GT(free, 5000U);
    EXPECT_LE(differ, in_band / 500);  // cells on the very border of a strip
    EXPECT_EQ(through_walls, 0U);
  }
}

TEST(PushProperty, PushesCommuteBelowTheCap) {
  std::mt19937 random(22);
  for (int trial = 0; trial < 4; ++trial) {
    const FlatWorld world = random_world(random);
    std::vector<Pose2> poses;
    for (int i = 0; i < 5; ++i) {
      // Looks from one side: no surface is seen from both.
      Pose2 pose = random_pose(random);
      pose.x_m *= 0.1;
      pose.y_m *= 0.1;
      poses.push_back(pose);
    }
    TsdGrid forth(kGeometry), back(kGeometry);
    TsdUpdater updater(kGeometry, {});
    const auto push = [&](const Pose2& T, TsdGrid& grid) {
      (void)updater.push(extract_surface(scan_of(world, T)), T, 1.0, grid);
    };
    for (std::size_t i = 0; i < poses.size(); ++i) {
      push(poses[i], forth);
      push(poses[poses.size() - 1 - i], back);
    }
    std::size_t known = 0, differ = 0;
    each_known(forth, [&](CellIndex i, TsdCell cell) {
      const TsdCell other = back.cell(i);
      ++known;
      // Contradictions (at the edges of what is seen) are resolved by who came last.
      differ += std::abs(cell.tsd - other.tsd) > 50 || std::abs(cell.weight - other.weight) > 2;
    });
    EXPECT_LT(static_cast<double>(differ), 0.02 * static_cast<double>(known));
  }
}

TEST(PushProperty, CellsCommuteExactlyWhereNothingContradicts) {
  std::mt19937 random(23);
  std::uniform_int_distribution<int> tsd(-8000, 8000), weight(1, 64);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto seen = [&] {
      return TsdCell{static_cast<std::int16_t>(tsd(random)),
                     static_cast<std::uint16_t>(weight(random))};
    };
    const TsdCell a = seen(), b = seen(), c = seen();
    constexpr int kCap = 32 * TsdCell::kWeightOne;
    const TsdCell one = updated(updated(a, b, kCap), c, kCap);
    const TsdCell two = updated(updated(c, a, kCap), b, kCap);
    EXPECT_EQ(one.weight, two.weight);
    EXPECT_NEAR(one.tsd, two.tsd, 1);  // rounding of the mean
  }
}

TEST(PushProperty, APushedScanRayCastsBackWithinACell) {
  std::mt19937 random(24);
  for (int trial = 0; trial < 8; ++trial) {
    const FlatWorld world = random_world(random);
    const Pose2 T = random_pose(random);
    const Scan2 scan = scan_of(world, T);
    TsdGrid grid(kGeometry);
    TsdUpdater updater(kGeometry, {});
    (void)updater.push(extract_surface(scan), T, 1.0, grid);
    TsdView view;
    view.assign(grid, T.translation(), 12.0);
    std::size_t hits = 0, met = 0, near = 0;
    for (const Beam2& beam : scan.beams) {
      if (beam.kind != BeamKind::hit) continue;
      ++hits;
      const auto hit =
          cast_ray(view, T.translation(), T.yaw_rad + static_cast<double>(beam.angle_rad), 20.0);
      if (!hit) continue;
      ++met;
      near += world.distance(hit->p_map) < kGeometry.cell_size_m ? 1U : 0U;
    }
    // A single scan shows too little of what it sees at a flat angle or in two or three beams.
    EXPECT_GT(static_cast<double>(met), 0.90 * static_cast<double>(hits));
    // Past a wall's free end its band goes on a little, and gaps seen at a flat angle are bridged.
    EXPECT_GT(static_cast<double>(near), 0.97 * static_cast<double>(met)) << trial;
  }
}

/// A walk in steps of a tenth of a cell.
std::optional<Eigen::Vector2d> slow_cast(const TsdView& view, const Eigen::Vector2d& from,
                                         double angle_rad, double max_range_m) {
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  bool was_free = false;
  for (double at = 0.0; at < max_range_m; at += 0.005) {
    const Eigen::Vector2d p = from + at * along;
    const Pose2 v = view.to_view({p.x(), p.y(), 0.0});
    TsdView::Sample sample{};
    if (!view.sample(static_cast<float>(v.x_m), static_cast<float>(v.y_m), sample)) {
      was_free = false;
    } else if (sample.value > 0.0F) {
      was_free = true;
    } else if (was_free) {
      return p;
    } else {
      was_free = false;
    }
  }
  return std::nullopt;
}

TEST(RayCastProperty, FastWalkAgreesWithTheSlowOne) {
  std::mt19937 random(25);
  std::size_t rays = 0, agree = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const FlatWorld world = random_world(random);
    TsdGrid grid(kGeometry);
    TsdUpdater updater(kGeometry, {});
    for (int i = 0; i < 4; ++i) {
      const Pose2 T = random_pose(random);
      (void)updater.push(extract_surface(scan_of(world, T)), T, 1.0, grid);
    }
    TsdView view;
    view.assign(grid, {0.0, 0.0}, 12.0);
    const Eigen::Vector2d from = random_pose(random).translation();
    for (double angle = -3.0; angle < 3.0; angle += 0.037) {
      ++rays;
      const auto slow = slow_cast(view, from, angle, 15.0);
      const auto fast = cast_ray(view, from, angle, 15.0);
      agree +=
          slow.has_value() == fast.has_value() && (!slow || (*slow - fast->p_map).norm() < 0.02)
              ? 1U
              : 0U;
    }
  }
  // They may part where a ray grazes an edge: a step more or less decides.
  EXPECT_GT(static_cast<double>(agree), 0.98 * static_cast<double>(rays));
}

/// Is there a way from free to behind a surface along +x, within 15 cm of (x, y)?
bool is_wall_at(const TsdGrid& grid, double x, double y) {
  const CellIndex middle = grid.cell_at({x, y});
  for (int k = -3; k < 3; ++k) {
    const TsdCell a = grid.cell({middle.x + k, middle.y});
    const TsdCell b = grid.cell({middle.x + k + 1, middle.y});
    if (a.known() && b.known() && a.tsd > 0 && b.tsd <= 0) return true;
  }
  return false;
}

/// Two rooms with a doorway of 0.9 m at `x`; its leaf is there or not.
FlatWorld rooms_with_door(double x, bool is_closed) {
  FlatWorld world;
  world.add_box(-4.0, -3.0, 6.0, 3.0);
  for (const double side : {-1.0, 1.0}) {
    world.add(x - 0.05, side * 3.0, x - 0.05, side * 0.45)
        .add(x + 0.05, side * 3.0, x + 0.05, side * 0.45)
        .add(x - 0.05, side * 0.45, x + 0.05, side * 0.45);
  }
  if (is_closed) world.add(x - 0.02, -0.45, x - 0.02, 0.45).add(x + 0.02, -0.45, x + 0.02, 0.45);
  return world;
}

TEST(PushProperty, ADoorThatMovedIsLearntWithin20DenseLooksBothWays) {
  const support::Lidar lidar{.noise_m = 0.01};
  std::mt19937 random(24);
  std::normal_distribution<double> off(0.0, 1.0);
  for (const double x : {1.0, 1.013, 2.025, 2.037}) {
    for (const bool closes : {true, false}) {
      for (const int looks_before : {2, 8, 40, 200}) {
        TsdGrid grid(kGeometry);
        TsdUpdater updater(kGeometry, {});
        const auto look = [&](bool is_closed) {
          const Pose2 T{0.1, 0.2, 0.3};
          const Pose2 seen_from{0.1 + 0.01 * off(random), 0.2 + 0.01 * off(random),
                                0.3 + 0.004 * off(random)};
          const Scan2 scan = scan_of(rooms_with_door(x, is_closed), T, lidar, &random);
          (void)updater.push(extract_surface(scan), seen_from, 1.0, grid, Looks::dense);
        };
        for (int i = 0; i < looks_before; ++i) look(!closes);
        for (int i = 0; i < 20; ++i) look(closes);
        for (double y = -0.3; y < 0.31; y += 0.05) {
          EXPECT_EQ(is_wall_at(grid, x, y), closes) << x << " " << y << " " << looks_before;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lifeline
