#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "agents/hud/hud_facts.hpp"
#include "agents/hud/way_out.hpp"
#include "common/sharing/helmet_mark.hpp"

namespace lifeline::hud {

/// A team-mate on the map, or at its edge.
struct HudMate {
  sharing::HelmetMark mark;
  Eigen::Vector2d p_map_m{0.0, 0.0};
  std::optional<double> heading_rad{};  ///< in the map frame; empty: shown as "?"
  std::optional<double> distance_m{};   ///< empty where the own position is lost
  double age_s = 0.0;
  bool stale = false;
  bool calls_for_help = false;
};

struct HudFind {
  Eigen::Vector2d p_map_m{0.0, 0.0};
  bool is_tag = false;
  bool confirmed = false;
  std::optional<double> distance_m{};  ///< as of a mate
};

/// Where to search next: a suggestion.
struct HudSearch {
  Eigen::Vector2d p_map_m{0.0, 0.0};
  double distance_m = 0.0;  ///< to be walked
};

enum class BandKind { own_mayday, evacuate, mayday, roll_call, lost };

/// A line across the whole picture.
struct HudBand {
  BandKind kind = BandKind::lost;
  std::string title;   ///< a few words
  std::string detail;  ///< may be cut off
  std::optional<double> distance_m{};
  std::optional<double> bearing_rad{};  ///< where it is, counter-clockwise from straight ahead
  bool flash = false;                   ///< right now, to draw the eye
  bool waits = false;                   ///< for the wearer's answer
  std::optional<sharing::AlertKey> alert{};
};

struct HudWayOut {
  Path points;  ///< in the map frame, metres
  double length_m = 0.0;
  double bearing_rad = 0.0;  ///< where to turn to, counter-clockwise from straight ahead
  bool by_own_trail = false;
  bool arrived = false;  ///< at the entry
};

/// All that a HUD shows besides the map itself: plain values, drawn by draw_hud().
struct HudPicture {
  Pose2 T_map_head;
  bool position_known = false;
  bool heading_known = false;
  int trust_bars = 0;               ///< 0 to 4
  int link_bars = 0;                ///< 0 to 4
  std::optional<double> map_age_s;  ///< empty where there is no map yet
  bool shared = false;
  double metres_ahead = 12.0;  ///< from the own arrow to the upper edge
  std::vector<HudMate> mates;
  std::vector<HudFind> finds;
  std::optional<HudWayOut> way_out;  ///< empty: none is known
  std::optional<HudSearch> search;   ///< empty: there is none, or it must not be thought of now
  std::vector<HudBand> bands;        ///< the most urgent first
  double hold_share = 0.0;           ///< of the button's hold, 0 to 1
  bool hold_cancels = false;         ///< a hold takes the own mayday back
};

/// What the button's brief presses switch through, metres ahead.
inline constexpr double kScales_m[] = {8.0, 16.0, 32.0};
/// A mate not heard for so long is shown as one who may be elsewhere by now.
inline constexpr Duration kStaleAfter = std::chrono::seconds(3);

/// What the HUD itself knows besides the facts.
struct HudView {
  Pose2 T_map_head;  ///< as shown: smoothed
  const std::optional<WayOut>* way_out = nullptr;
  double metres_ahead = kScales_m[0];
  double hold_share = 0.0;
  std::optional<SteadyTime> lost_since{};
};

/// A pure function of its arguments.
[[nodiscard]] HudPicture compose_picture(const HudFacts& facts, const HudView& view,
                                         SteadyTime now);

/// Whether SLAM knows where the head is, and which way it looks.
[[nodiscard]] bool is_position_known(const sharing::HelmetState& state);
[[nodiscard]] bool is_heading_known(const sharing::HelmetState& state);

}  // namespace lifeline::hud
