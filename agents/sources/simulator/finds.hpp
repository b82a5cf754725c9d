#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "agents/sensing/raw_scan.hpp"
#include "agents/sources/portable_noise.hpp"
#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "agents/sources/source_spec.hpp"
#include "common/base/result.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::sources {

/// Somebody or something to be found. World frame.
struct Find {
  sensing::SightedKind kind = sensing::SightedKind::victim;
  Eigen::Vector2d p_world{0.0, 0.0};
};

/// Which finds of one kind lie in the building: so many, by the building's seed, or at these
/// places.
struct FindsWanted {
  static constexpr int kMost = 32;
  int count = 0;
  std::vector<Eigen::Vector2d> places;  ///< instead of a count
};

/// The option `name` (victims or tags): a number of finds, or places `x,y;x,y` in metres. wrong_use
/// for anything else.
[[nodiscard]] Result<FindsWanted> read_finds(const SourceSpec& spec, const std::string& name);

/// Lays the finds out: those with a count on walkable floor, at least 2.5 m from each other where
/// there is room for that. The same seed gives the same places. wrong_use for a place that is not
/// on the floor.
[[nodiscard]] Result<std::vector<Find>> place_finds(const FreeSpace& space,
                                                    const FindsWanted& victims,
                                                    const FindsWanted& tags, std::uint64_t seed);

/// A detector of finds on the head: a camera that tells people, a receiver of tags. Sees all round,
/// what no wall or closed door hides.
class SimulatedDetector {
 public:
  struct Model {
    double range_m;        ///< farther, nothing is seen
    double seen_share;     ///< of the looks in which it is noticed
    double range_sigma_m;  ///< at 0 m
    double range_sigma;    ///< more per metre
    double bearing_sigma_rad;
    double confidence_near;  ///< at 0 m, falling in a straight line ...
    double confidence_far;   ///< ... to this at range_m
  };
  /// What is assumed of people in a thermal camera's picture, and of tags of ultra-wide band.
  [[nodiscard]] static const Model& model_of(sensing::SightedKind kind);

  SimulatedDetector(std::vector<Find> finds, std::uint64_t seed)
      : finds_(std::move(finds)), noise_(stir(seed, 0)), luck_(stir(seed, 1)) {}

  /// What is seen from a head at T_world_head. `more_walls` stand there beside the scene's.
  [[nodiscard]] std::vector<sensing::Sighting> look(const RayScene& scene,
                                                    const Pose2& T_world_head,
                                                    std::span<const WallSegment> more_walls);

  [[nodiscard]] const std::vector<Find>& finds() const { return finds_; }

 private:
  std::vector<Find> finds_;
  PortableNoise noise_;
  Draw luck_;  // decides on what is noticed
};

}  // namespace lifeline::sources
