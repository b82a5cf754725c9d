#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "agents/sharing/helmet_sharing.hpp"

namespace lifeline::hud {

/// A team-mate as last heard.
struct MateFacts {
  std::string id;
  /// In the own map frame; empty where their maps do not lie on each other.
  std::optional<Pose2> T_map_mate;
  std::uint8_t trust_percent = 0;
  SteadyTime heard_at{};
};

/// A find that somebody may still have to look after.
struct FindFacts {
  Eigen::Vector2d p_map_m{0.0, 0.0};
  wire::DetectionKind kind = wire::DetectionKind::victim;
  bool confirmed = false;
};

/// The nearest part that nobody has searched and nobody else is nearer to.
struct SearchFacts {
  Eigen::Vector2d p_map_m{0.0, 0.0};  ///< where the way comes to it, in the own map frame
  double distance_m = 0.0;            ///< to be walked
};

/// An alert that is not over and concerns this helmet.
struct AlertFacts {
  sharing::AlertKey key;
  wire::AlertKind kind = wire::AlertKind::mayday;
  std::string about;   ///< of a mayday: who needs help
  std::string text{};  ///< printable ASCII
  bool own = false;
  bool answered = false;  ///< by this helmet's wearer
  bool seen_by_command = false;
};

/// All that a HUD shows of what the sharing half of its helmet knows, copied out: plain values that
/// may cross threads.
struct HudFacts {
  std::string id;
  sharing::HelmetState state;
  bool shares = false;  ///< the own map lies on others'
  /// When the own map last took a scan in; empty before the first.
  std::optional<SteadyTime> mapped_at;
  /// When anybody who gives to the shared map, or the command, was last heard.
  std::optional<SteadyTime> shared_at;
  std::optional<SteadyTime> command_at, mate_at;  ///< newest status of any
  double pose_loss = 0.0;  ///< the largest share of mates' poses that get lost, 0 to 1
  std::uint32_t tiles_behind = 0;
  std::vector<MateFacts> mates;
  std::vector<FindFacts> finds;
  std::vector<AlertFacts> alerts;
  std::optional<SearchFacts> search{};  ///< a suggestion
};

/// `mapped_at`: as of HudFacts.
[[nodiscard]] HudFacts collect_facts(const sharing::HelmetSharing& helmet,
                                     std::optional<SteadyTime> mapped_at);

}  // namespace lifeline::hud
