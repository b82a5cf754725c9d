#pragma once

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "agents/slam/tsd_slam.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline::slam {

/// A storey of 16 m x 9 m: a corridor from end to end, two rooms above and three below, each with a
/// door and something in it that the others have not.
inline support::FlatWorld wing() {
  support::FlatWorld world;
  world.add_box(0.0, 0.0, 16.0, 9.0);
  world.add(0.0, 4.0, 3.0, 4.0).add(4.0, 4.0, 6.5, 4.0).add(7.5, 4.0, 12.0, 4.0);
  world.add(13.0, 4.0, 16.0, 4.0);
  world.add(0.0, 5.5, 2.0, 5.5).add(3.0, 5.5, 10.0, 5.5).add(11.0, 5.5, 16.0, 5.5);
  world.add(5.0, 0.0, 5.0, 4.0).add(9.0, 0.0, 9.0, 4.0).add(7.0, 5.5, 7.0, 9.0);
  world.add_box(0.5, 0.5, 1.2, 1.5).add(6.0, 0.0, 5.0, 1.0).add_box(14.0, 1.0, 14.6, 3.0);
  world.add_box(4.5, 7.8, 6.4, 8.4).add(16.0, 7.5, 14.5, 9.0).add_box(9.0, 7.0, 9.4, 7.4);
  return world;
}

/// A way along straight lines, 0.1 m a scan (1 m/s at 10 Hz); the head looks about all the while.
class Way {
 public:
  explicit Way(std::vector<Eigen::Vector2d> corners) : corners_(std::move(corners)) {}

  [[nodiscard]] Pose2 at(int k) const {
    double left_m = 0.1 * k;
    const double yaw_rad = 0.7 * std::sin(0.05 * k);
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      const Eigen::Vector2d side = corners_[i] - corners_[i - 1];
      if (left_m <= side.norm()) {
        const Eigen::Vector2d p = corners_[i - 1] + left_m * side.normalized();
        return {p.x(), p.y(), yaw_rad};
      }
      left_m -= side.norm();
    }
    return {corners_.back().x(), corners_.back().y(), yaw_rad};
  }
  [[nodiscard]] int scans() const {
    double length_m = 0.0;
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      length_m += (corners_[i] - corners_[i - 1]).norm();
    }
    return static_cast<int>(length_m / 0.1);
  }

 private:
  std::vector<Eigen::Vector2d> corners_;
};

/// Through all rooms of the wing, once: 41 m.
inline Way through_the_wing() {
  return Way({{2.5, 2.0},  {3.5, 3.0},   {3.5, 4.75},  {2.5, 4.75},  {2.5, 7.0},   {2.5, 4.75},
              {7.0, 4.75}, {7.0, 2.0},   {7.0, 4.75},  {10.5, 4.75}, {10.5, 6.5},  {12.5, 6.5},
              {10.5, 6.5}, {10.5, 4.75}, {12.5, 4.75}, {12.5, 2.0},  {12.5, 4.75}, {7.0, 4.75},
              {3.5, 4.75}, {3.5, 3.0},   {2.5, 2.0}});
}

inline constexpr Duration kTenthSecond = std::chrono::milliseconds(100);
/// A head on its way through a world, and the SLAM that it carries.
class Walk {
 public:
  Walk(support::FlatWorld seen, Way taken) : world(std::move(seen)), way(std::move(taken)) {}

  enum class Sees { all, nothing };
  /// The scan at place k of the way, of which the attitude sensor tells the turn, if it does.
  SlamStep step(int k, Sees sees = Sees::all, bool has_attitude = true) {
    Scan2 scan = support::scan_of(world, way.at(k), lidar, &random_);
    for (Beam2& beam : scan.beams) {
      if (sees == Sees::nothing) beam.kind = BeamKind::invalid;
    }
    scan.stamp = Timestamp(kTenthSecond * scans_);
    MotionPrior prior;
    if (scans_ > 0) {
      prior.elapsed = (1 + std::exchange(missed_, 0)) * kTenthSecond;
      if (has_attitude) prior.yaw_step_rad = normalise_angle(way.at(k).yaw_rad - last_yaw_rad_);
    }
    ++scans_;
    last_yaw_rad_ = way.at(k).yaw_rad;
    return slam.step(scan, prior);
  }
  /// So many scans never reached it.
  void miss(int scans) {
    scans_ += scans;
    missed_ += scans;
  }
  /// Distance to the truth, in a map that began at place 0 of the way.
  [[nodiscard]] double off_m(const SlamStep& step, int k) const {
    const Pose2 truth = way.at(0).inverse() * way.at(k);
    return (truth.translation() - step.T_map_head.translation()).norm();
  }

  support::FlatWorld world;
  Way way;
  support::Lidar lidar{.max_range_m = 12.0, .noise_m = 0.01};
  TsdSlam slam{[] {
                 SlamConfig config;
                 config.stories.max_stories = 1;
                 return config;
               }(),
               kGeometry};

 private:
  std::mt19937 random_{5};
  int scans_ = 0;
  int missed_ = 0;
  double last_yaw_rad_ = 0.0;
};

inline TsdGrid copy_of(const TsdGrid& grid) {
  TsdGrid copy(grid.geometry());
  for (const TileIndex tile : grid.tiles()) copy.at(tile) = *grid.find(tile);
  return copy;
}

inline bool same_cells(const TsdGrid& a, const TsdGrid& b) {
  if (a.tiles() != b.tiles()) return false;
  for (const TileIndex tile : a.tiles()) {
    if (*a.find(tile) != *b.find(tile)) return false;
  }
  return true;
}

/// The layer that comes of walking all of `walk`.
inline TsdGrid map_of(Walk& walk) {
  for (int k = 0; k < walk.way.scans(); ++k) (void)walk.step(k);
  return copy_of(walk.slam.layer());
}

}  // namespace lifeline::slam
