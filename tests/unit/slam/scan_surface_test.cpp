#include "common/grid/scan_surface.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/flat_world.hpp"

namespace lifeline {
namespace {

using support::FlatWorld;
using support::hit_beam;
using support::Lidar;
using support::scan_of;

/// A wall 2 m ahead, seen by 61 beams over 60 deg.
Scan2 wall_ahead() {
  const FlatWorld world = FlatWorld().add(2.0, -5.0, 2.0, 5.0);
  return scan_of(world, {}, {.beams = 61, .first_angle_rad = -M_PI / 6, .step_rad = M_PI / 180});
}

TEST(ScanSurface, AStraightWallIsOneSurfaceFacingTheLidar) {
  const auto pieces = extract_surface(wall_ahead());
  ASSERT_EQ(pieces.size(), 61U);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i].link, i == 0 ? SurfaceLink::none : SurfaceLink::joined);
    EXPECT_TRUE(pieces[i].has_normal);
    EXPECT_NEAR(pieces[i].normal.x(), -1.0F, 1e-4F);
    EXPECT_NEAR(pieces[i].point.x(), 2.0F, 1e-4F);
  }
}

TEST(ScanSurface, PiecesOfAWallCoverItWithoutGaps) {
  const auto pieces = extract_surface(wall_ahead());
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    // The sweep goes to the left (+y); seen along the normal, that is to the right.
    const float from = pieces[i - 1].point.y() + pieces[i - 1].right_m;
    const float to = pieces[i].point.y() - pieces[i].left_m;
    EXPECT_NEAR(from, to, 1e-4F);
  }
}

TEST(ScanSurface, HitsThatNearlyCoincideBecomeOnePiece) {
  const FlatWorld world = FlatWorld().add(0.5, -5.0, 0.5, 5.0);
  const Scan2 scan = scan_of(world, {}, {.beams = 201, .first_angle_rad = -0.2, .step_rad = 0.002});
  const auto pieces = extract_surface(scan);
  EXPECT_LT(pieces.size(), 20U);
  for (const SurfacePiece& piece : pieces) EXPECT_NEAR(piece.point.x(), 0.5F, 1e-4F);
}

TEST(ScanSurface, ADepthJumpParts) {
  const FlatWorld world = FlatWorld().add(2.0, 0.0, 2.0, -5.0).add(4.0, -5.0, 4.0, 8.0);
  const Scan2 scan = scan_of(
      world, {}, {.beams = 61, .first_angle_rad = -M_PI / 6 + 1e-3, .step_rad = M_PI / 180});
  int jumps = 0;
  for (const SurfacePiece& piece : extract_surface(scan)) {
    EXPECT_NEAR(std::abs(piece.normal.x()), 1.0F, 1e-3F);  // no slanted surface between the walls
    jumps += piece.link == SurfaceLink::jump ? 1 : 0;
  }
  EXPECT_EQ(jumps, 1);
}

TEST(ScanSurface, ABeamWithoutReturnPartsWithoutAJump) {
  Scan2 scan = wall_ahead();
  scan.beams[30].kind = BeamKind::no_return;
  const auto pieces = extract_surface(scan);
  ASSERT_EQ(pieces.size(), 60U);
  EXPECT_EQ(pieces[30].link, SurfaceLink::none);
}

TEST(ScanSurface, AWallSeenAtAFlatAngleStaysInOnePiece) {
  const FlatWorld world = FlatWorld().add(1.0, 1.0, 9.0, 1.0);
  const Scan2 scan =
      scan_of(world, {}, {.beams = 60, .first_angle_rad = M_PI / 180 * 7, .step_rad = M_PI / 180});
  const auto pieces = extract_surface(scan);
  ASSERT_GT(pieces.size(), 30U);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i].link, SurfaceLink::joined) << i;
    EXPECT_NEAR(pieces[i].normal.y(), -1.0F, 1e-2F) << i;
  }
}

TEST(ScanSurface, FarSurfacesSeenFlatlyAreTrustedLeast) {
  const FlatWorld world = FlatWorld().add(-1.0, 1.0, 9.0, 1.0).add(9.0, 1.0, 9.0, -5.0);
  const auto pieces = extract_surface(
      scan_of(world, {}, {.beams = 120, .first_angle_rad = -0.5, .step_rad = M_PI / 180}));
  float near = 0.0F, flat = 1.0F, ahead = 0.0F;
  for (const SurfacePiece& piece : pieces) {
    EXPECT_GT(piece.quality, 0.0F);
    EXPECT_LE(piece.quality, 1.0F);
    const bool is_side = std::abs(piece.normal.y()) > 0.9F;
    if (is_side && piece.point.x() < 0.5F) near = std::max(near, piece.quality);
    if (is_side && piece.point.x() > 6.0F) flat = std::min(flat, piece.quality);
    if (!is_side && std::abs(piece.point.y()) < 0.3F) ahead = std::max(ahead, piece.quality);
  }
  EXPECT_GT(near, 0.9F);
  EXPECT_GT(ahead, 0.9F);  // far, but head-on: the head's yaw does not move it
  EXPECT_LT(flat, 0.7F);
}

TEST(ScanSurface, CornersKeepTheNormalsOfTheirWalls) {
  const FlatWorld world = FlatWorld().add(2.0, -5.0, 2.0, 1.0).add(2.0, 1.0, -5.0, 1.0);
  const auto pieces = extract_surface(
      scan_of(world, {}, {.beams = 160, .first_angle_rad = -0.8, .step_rad = M_PI / 180}));
  for (const SurfacePiece& piece : pieces) {
    const float along_x = std::abs(piece.normal.x()), along_y = std::abs(piece.normal.y());
    EXPECT_GT(std::max(along_x, along_y), 0.99F) << piece.point.transpose();
  }
}

TEST(ScanSurface, AClosedRoomIsOneSurfaceAllAround) {
  const FlatWorld world = FlatWorld().add_box(-2.0, -2.0, 2.0, 2.0);
  const auto pieces = extract_surface(scan_of(world, {}));
  int parted = 0;
  for (const SurfacePiece& piece : pieces) parted += piece.link == SurfaceLink::joined ? 0 : 1;
  EXPECT_LE(parted, 1);
}

TEST(ScanSurface, BeamsFarApartAreNoNeighbours) {
  Scan2 scan;
  for (int i = 0; i < 5; ++i) scan.beams.push_back(hit_beam(0.5 * i, 1.0));
  for (const SurfacePiece& piece : extract_surface(scan)) {
    EXPECT_EQ(piece.link, SurfaceLink::none);
    EXPECT_FALSE(piece.has_normal);
    EXPECT_LT(piece.normal.dot(piece.point), 0.0F);
  }
}

TEST(ScanSurface, PoorScansGiveFewPiecesAndNoHarm) {
  EXPECT_TRUE(extract_surface({}).empty());
  Scan2 blind = wall_ahead();
  for (Beam2& beam : blind.beams) beam.kind = BeamKind::invalid;
  EXPECT_TRUE(extract_surface(blind).empty());
  Scan2 one;
  one.beams.push_back(hit_beam(0.0, 3.0));
  one.full_circle = true;
  EXPECT_EQ(extract_surface(one).size(), 1U);
  Scan2 touching;
  touching.beams.push_back(hit_beam(0.0, 1e-4));
  EXPECT_TRUE(extract_surface(touching).empty());
}

TEST(ScanSurface, NoiseIsSmoothedAlongTheWall) {
  std::mt19937 random(3);
  const FlatWorld world = FlatWorld().add(2.0, -5.0, 2.0, 5.0);
  const Lidar lidar{.beams = 300, .first_angle_rad = -0.4, .step_rad = 0.8 / 300, .noise_m = 0.01};
  const auto pieces = extract_surface(scan_of(world, {}, lidar, &random));
  double off2 = 0.0;
  for (const SurfacePiece& piece : pieces) {
    off2 += std::pow(static_cast<double>(piece.point.x()) - 2.0, 2);
    EXPECT_GT(-piece.normal.x(), 0.97F);
  }
  EXPECT_LT(std::sqrt(off2 / static_cast<double>(pieces.size())), 0.006);
}

}  // namespace
}  // namespace lifeline
