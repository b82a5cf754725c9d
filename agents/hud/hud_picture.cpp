#include "agents/hud/hud_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/sharing/roster.hpp"

namespace lifeline::hud {
namespace {

constexpr double kArrived_m = 2.0;
// Where the way is looked at to say where to turn: not at the next block, which lies to the side as
// often as ahead.
constexpr double kLookAhead_m = 3.0;
constexpr double kBadLoss = 0.5, kSomeLoss = 0.15;
constexpr Duration kFlash = std::chrono::milliseconds(500);
constexpr std::uint32_t kManyBehind = 20;  // tiles

double seconds_since(SteadyTime then, SteadyTime now) {
  return std::max(0.0, to_seconds(now - then));
}

/// Counter-clockwise from straight ahead.
double bearing_of(const Pose2& T_map_head, const Eigen::Vector2d& p_map_m) {
  const Eigen::Vector2d p_head = T_map_head.inverse() * p_map_m;
  return std::atan2(p_head.y(), p_head.x());
}

/// Nobody is so far away from somebody who does not know where they are.
std::optional<double> distance_to(const HudPicture& picture, const Eigen::Vector2d& p_map_m) {
  if (!picture.position_known) return std::nullopt;
  return (p_map_m - picture.T_map_head.translation()).norm();
}

int bars_of(std::uint8_t trust_percent) {
  return std::min(4, (trust_percent + 24) / 25);
}

int link_bars(const HudFacts& facts, SteadyTime now) {
  const auto within = [&](const std::optional<SteadyTime>& heard, Duration age) {
    return heard && now - *heard <= age;
  };
  if (within(facts.command_at, sharing::kLateAfter)) {
    if (facts.pose_loss >= kBadLoss) return 2;
    return facts.pose_loss >= kSomeLoss || facts.tiles_behind > kManyBehind ? 3 : 4;
  }
  if (within(facts.mate_at, sharing::kLateAfter)) return 2;
  return within(facts.command_at, sharing::kLostAfter) || within(facts.mate_at, sharing::kLostAfter)
             ? 1
             : 0;
}

const MateFacts* find_mate(const HudFacts& facts, const std::string& id) {
  const auto found = std::ranges::find(facts.mates, id, &MateFacts::id);
  return found == facts.mates.end() ? nullptr : &*found;
}

void add_mates(const HudFacts& facts, SteadyTime now, HudPicture& picture) {
  for (const MateFacts& mate : facts.mates) {
    if (!mate.T_map_mate) continue;
    HudMate shown{sharing::mark_of(mate.id), mate.T_map_mate->translation()};
    if (mate.trust_percent > 0) shown.heading_rad = mate.T_map_mate->yaw_rad;
    shown.distance_m = distance_to(picture, shown.p_map_m);
    shown.age_s = seconds_since(mate.heard_at, now);
    shown.stale = now - mate.heard_at > kStaleAfter;
    shown.calls_for_help = std::ranges::any_of(facts.alerts, [&](const AlertFacts& alert) {
      return alert.kind == wire::AlertKind::mayday && alert.about == mate.id;
    });
    picture.mates.push_back(std::move(shown));
  }
}

HudBand mayday_band(const AlertFacts& alert, const HudFacts& facts, const HudPicture& picture) {
  HudBand band{BandKind::mayday, "MAYDAY " + alert.about, alert.text};
  band.waits = !alert.answered;
  const MateFacts* mate = find_mate(facts, alert.about);
  if (mate == nullptr || !mate->T_map_mate) {
    band.detail = alert.text.empty() ? "place unknown" : alert.text + " - place unknown";
    return band;
  }
  const Eigen::Vector2d p_m = mate->T_map_mate->translation();
  band.distance_m = distance_to(picture, p_m);
  if (picture.heading_known) band.bearing_rad = bearing_of(picture.T_map_head, p_m);
  return band;
}

HudBand band_of(const AlertFacts& alert, const HudFacts& facts, SteadyTime now,
                const HudPicture& picture) {
  HudBand band;
  if (alert.kind == wire::AlertKind::mayday && alert.about == facts.id) {
    band = {BandKind::own_mayday, "MAYDAY SENT",
            alert.seen_by_command ? "command has seen it" : "nobody has answered yet"};
    if (!alert.own) {  // somebody called for help for this one
      band.title = "MAYDAY for you";
      band.waits = !alert.answered;
    }
  } else if (alert.kind == wire::AlertKind::mayday) {
    band = mayday_band(alert, facts, picture);
  } else {
    const bool evacuate = alert.kind == wire::AlertKind::evacuate;
    band = {evacuate ? BandKind::evacuate : BandKind::roll_call, evacuate ? "EVACUATE" : "PAR?",
            alert.text};
    band.waits = !alert.answered;
    if (band.waits && band.detail.empty()) band.detail = "press to answer";
  }
  band.alert = alert.key;
  band.flash = band.waits && alert.kind == wire::AlertKind::mayday &&
               now.time_since_epoch() / kFlash % 2 == 1;
  return band;
}

void add_bands(const HudFacts& facts, const HudView& view, SteadyTime now, HudPicture& picture) {
  for (const AlertFacts& alert : facts.alerts) {
    // Who has answered a roll call is done with it.
    if (alert.kind == wire::AlertKind::roll_call && alert.answered) continue;
    picture.bands.push_back(band_of(alert, facts, now, picture));
  }
  if (!picture.position_known && view.lost_since) {
    picture.bands.push_back({BandKind::lost, "POSITION LOST",
                             fmt::format("for {:.0f} s", seconds_since(*view.lost_since, now))});
  }
  std::ranges::stable_sort(picture.bands, [](const HudBand& a, const HudBand& b) {
    return std::pair(!a.waits, a.kind) < std::pair(!b.waits, b.kind);
  });
}

void add_way_out(const HudView& view, HudPicture& picture) {
  if (view.way_out == nullptr || !*view.way_out || !picture.position_known) return;
  const WayOut& way = **view.way_out;
  HudWayOut shown{way.points, way.length_m, 0.0, way.by_own_trail, way.length_m < kArrived_m};
  shown.bearing_rad = bearing_of(picture.T_map_head, point_ahead(way.points, kLookAhead_m));
  picture.way_out = std::move(shown);
}

/// Who is called out, calls for help or hears somebody call has other things to do.
void add_search(const HudFacts& facts, HudPicture& picture) {
  const bool is_urgent = std::ranges::any_of(facts.alerts, [](const AlertFacts& alert) {
    return alert.kind == wire::AlertKind::mayday || alert.kind == wire::AlertKind::evacuate;
  });
  if (!facts.search || !picture.position_known || is_urgent) return;
  picture.search = HudSearch{facts.search->p_map_m, facts.search->distance_m};
}

}  // namespace

bool is_position_known(const sharing::HelmetState& state) {
  return state.trust_percent > 0 &&
         (state.state == wire::AgentState::tracking || state.state == wire::AgentState::weak ||
          state.state == wire::AgentState::finished);
}

bool is_heading_known(const sharing::HelmetState& state) {
  const bool attitude_speaks =
      state.attitude == wire::SensorHealth::good || state.attitude == wire::SensorHealth::degraded;
  // A good match tells the heading by itself.
  return is_position_known(state) && (attitude_speaks || state.state == wire::AgentState::tracking);
}

HudPicture compose_picture(const HudFacts& facts, const HudView& view, SteadyTime now) {
  HudPicture picture;
  picture.T_map_head = view.T_map_head;
  picture.position_known = is_position_known(facts.state);
  picture.heading_known = is_heading_known(facts.state);
  picture.trust_bars = picture.position_known ? bars_of(facts.state.trust_percent) : 0;
  picture.link_bars = link_bars(facts, now);
  picture.shared = facts.shares;
  const auto map_at = facts.shares && facts.shared_at ? facts.shared_at : facts.mapped_at;
  if (map_at) picture.map_age_s = seconds_since(*map_at, now);
  picture.metres_ahead = view.metres_ahead;
  picture.hold_share = view.hold_share;
  picture.hold_cancels = std::ranges::any_of(facts.alerts, [&](const AlertFacts& alert) {
    return alert.kind == wire::AlertKind::mayday && alert.own && alert.about == facts.id;
  });
  add_mates(facts, now, picture);
  for (const FindFacts& find : facts.finds) {
    picture.finds.push_back({find.p_map_m, find.kind == wire::DetectionKind::uwb_tag,
                             find.confirmed, distance_to(picture, find.p_map_m)});
  }
  add_way_out(view, picture);
  add_search(facts, picture);
  add_bands(facts, view, now, picture);
  return picture;
}

}  // namespace lifeline::hud
