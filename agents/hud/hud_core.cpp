#include "agents/hud/hud_core.hpp"

#include <cmath>

namespace lifeline::hud {
namespace {

constexpr double kTrailStep_m = 0.25;
constexpr std::size_t kMostTrailPoints = 8000;
// The picture follows the head without a jerk, and not noticeably later.
constexpr double kFollow_s = 0.08;
constexpr Duration kPlanInterval = std::chrono::seconds(1);
constexpr double kPlanStep_m = 0.5;

Pose2 towards(const Pose2& from, const Pose2& to, double share) {
  return {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m),
          normalise_angle(from.yaw_rad + share * normalise_angle(to.yaw_rad - from.yaw_rad))};
}

}  // namespace

HudCore::HudCore(double cell_size_m, const Path& earlier)
    : map_(cell_size_m), trail_step_m_(kTrailStep_m) {
  for (const auto& point : earlier) extend_trail(point);
}

void HudCore::extend_trail(const Eigen::Vector2d& p_map_m) {
  if (!trail_.empty() && (p_map_m - trail_.back()).norm() < trail_step_m_) return;
  trail_.push_back(p_map_m);
  if (trail_.size() < kMostTrailPoints) return;
  // Hours of walking: every other point still tells the way.
  Path thinned;
  for (std::size_t i = 0; i < trail_.size(); i += 2) thinned.push_back(trail_[i]);
  trail_ = std::move(thinned);
  trail_step_m_ *= 2.0;
}

void HudCore::put(HudFacts facts, SteadyTime now) {
  facts_ = std::move(facts);
  if (is_position_known(facts_.state)) {
    lost_since_.reset();
    extend_trail(facts_.state.T_map_head.translation());
  } else if (!lost_since_ && facts_.state.state != wire::AgentState::starting) {
    lost_since_ = now;
  }
}

void HudCore::move(SteadyTime now) {
  const Pose2& newest = facts_.state.T_map_head;
  if (!shown_) shown_ = newest;
  const double share = 1.0 - std::exp(-to_seconds(now - moved_at_) / kFollow_s);
  moved_at_ = now;
  shown_ = towards(*shown_, newest, share);
}

void HudCore::plan(SteadyTime now) {
  map_changed_ |= map_.refresh();
  if (now < plan_due_ || !is_position_known(facts_.state)) return;
  const Eigen::Vector2d here = facts_.state.T_map_head.translation();
  if (!map_changed_ && planned_at_m_ && (here - *planned_at_m_).norm() < kPlanStep_m) return;
  plan_due_ = now + kPlanInterval;
  map_changed_ = false;
  planned_at_m_ = here;
  way_out_ = find_way_out(map_, trail_, here);
}

void HudCore::follow(Press press) {
  if (press == Press::held) {
    commands_.push_back(
        {picture_.hold_cancels ? HudCommand::Kind::all_well : HudCommand::Kind::mayday});
  } else if (press == Press::brief) {
    if (!picture_.bands.empty() && picture_.bands.front().waits) {
      commands_.push_back({HudCommand::Kind::answer, picture_.bands.front().alert.value()});
    } else {
      scale_ = (scale_ + 1) % std::size(kScales_m);
    }
  }
}

const HudPicture& HudCore::step(SteadyTime now) {
  move(now);
  plan(now);
  follow(button_.step(now));
  HudView view{*shown_, &way_out_, kScales_m[scale_], button_.held_share(now), lost_since_};
  picture_ = compose_picture(facts_, view, now);
  return picture_;
}

}  // namespace lifeline::hud
