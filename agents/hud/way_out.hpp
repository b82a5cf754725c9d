#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "agents/hud/hud_map.hpp"

namespace lifeline::hud {

/// Points in the map frame, metres, in the order in which they are walked.
using Path = std::vector<Eigen::Vector2d>;

/// How to get out.
struct WayOut {
  Path points;  ///< from where one stands to the entry
  double length_m = 0;
  /// No way through cells seen to be free is known: the points are the own trail, walked back.
  bool by_own_trail = false;
};

[[nodiscard]] double length_of(const Path& path);

/// The shortest way through cells that were seen to be free, never through the unknown: where a
/// person fits, and where `trail` says that one did, however narrow it looks. Either end may lie up
/// to a metre off such a place. Empty where no way is known (or the search would take too long:
/// 400,000 blocks of 0.2 m).
[[nodiscard]] std::optional<Path> find_free_way(const HudMap& map, const Path& trail,
                                                const Eigen::Vector2d& from_m,
                                                const Eigen::Vector2d& to_m);

/// The trail walked back to its first point, without the detours after which it came back to where
/// it had been (within `kSamePlaceM`).
inline constexpr double kSamePlaceM = 0.4;
[[nodiscard]] Path walk_back(const Path& trail, const Eigen::Vector2d& from_m);

/// The way to the first point of `trail`, which is where its wearer came in: by free cells, else
/// along the trail. Empty where the trail is.
[[nodiscard]] std::optional<WayOut> find_way_out(const HudMap& map, const Path& trail,
                                                 const Eigen::Vector2d& from_m);

/// The point of a path `ahead_m` along it, or its end: where to turn to now.
[[nodiscard]] Eigen::Vector2d point_ahead(const Path& path, double ahead_m);

}  // namespace lifeline::hud
