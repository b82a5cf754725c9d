#pragma once

#include <optional>
#include <vector>

#include "agents/hud/button.hpp"
#include "agents/hud/hud_map.hpp"
#include "agents/hud/hud_picture.hpp"

namespace lifeline::hud {

/// What the wearer wants of their helmet.
struct HudCommand {
  enum class Kind { mayday, all_well, answer };
  Kind kind = Kind::answer;
  sharing::AlertKey alert{};  ///< to be answered
};

/// What a HUD shows and what its button does, without display or thread: facts and cells in, a
/// picture and commands out. A state machine on the caller's clock. One owner, not thread-safe.
class HudCore {
 public:
  /// `earlier`: where the wearer had walked before a restart; its first point is the entry.
  explicit HudCore(double cell_size_m, const Path& earlier = {});

  void put(const sharing::MapTiles& own) { map_.put(own); }
  void put(const sharing::PeerUpdate& peers) { map_.put(peers); }
  void put(HudFacts facts, SteadyTime now);
  void set_button(bool down, SteadyTime now) { button_.set_down(down, now); }

  /// The picture as it is at `now`; does what is due.
  const HudPicture& step(SteadyTime now);
  [[nodiscard]] std::vector<HudCommand> take_commands() { return std::exchange(commands_, {}); }

  [[nodiscard]] const HudMap& map() const { return map_; }
  [[nodiscard]] const Path& trail() const { return trail_; }

 private:
  void extend_trail(const Eigen::Vector2d& p_map_m);
  void move(SteadyTime now);
  void plan(SteadyTime now);
  void follow(Press press);

  HudMap map_;
  HudFacts facts_;
  Button button_;
  Path trail_;
  double trail_step_m_;
  std::optional<Pose2> shown_;  ///< T_map_head
  SteadyTime moved_at_{};
  std::optional<SteadyTime> lost_since_;
  std::optional<WayOut> way_out_;
  SteadyTime plan_due_{};
  bool map_changed_ = false;
  std::optional<Eigen::Vector2d> planned_at_m_;
  std::size_t scale_ = 0;
  HudPicture picture_;
  std::vector<HudCommand> commands_;
};

}  // namespace lifeline::hud
