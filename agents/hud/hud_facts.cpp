#include "agents/hud/hud_facts.hpp"

#include <algorithm>
#include <map>

#include "common/base/printable.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "common/sharing/groups.hpp"

namespace lifeline::hud {
namespace {

using sharing::HelmetSharing;

/// T_own_other of each layer of the own group, the own one included; only the own one where there
/// is no group.
std::map<LayerKey, Pose2> places_of(const HelmetSharing& helmet) {
  std::map<LayerKey, Pose2> places;
  const auto group = sharing::group_of(helmet.map().directive(), helmet.layer());
  for (const auto& own : group) {
    if (own.layer != helmet.layer()) continue;
    const Pose2 T_own_common = sharing::to_pose(own.T_fused_layer).inverse();
    for (const auto& each : group)
      places.emplace(each.layer, T_own_common * sharing::to_pose(each.T_fused_layer));
  }
  places[helmet.layer()] = {};
  return places;
}

void note_newest(std::optional<SteadyTime>& newest, SteadyTime at) {
  newest = newest ? std::max(*newest, at) : at;
}

void add_mates(const HelmetSharing& helmet, const std::map<LayerKey, Pose2>& places,
               HudFacts& facts) {
  for (const auto& [id, entry] : helmet.poses().entries()) {
    MateFacts mate{id, std::nullopt, entry.pose.trust_percent, entry.heard_at};
    const auto name = AgentId::parse(id);
    const auto place = name
                           ? places.find({*name, MapId{entry.pose.map_id}, Floor{entry.pose.floor}})
                           : places.end();
    if (place != places.end()) mate.T_map_mate = place->second * entry.pose.T_map_head;
    facts.pose_loss = std::max(facts.pose_loss, entry.loss);
    facts.mates.push_back(std::move(mate));
  }
}

void add_voices(const HelmetSharing& helmet, HudFacts& facts) {
  for (const auto& [id, entry] : helmet.roster().entries()) {
    if (entry.status.role == wire::Role::coordinator) {
      note_newest(facts.command_at, entry.heard_at);
      note_newest(facts.shared_at, entry.heard_at);
      continue;
    }
    note_newest(facts.mate_at, entry.heard_at);
    const auto& members = helmet.map().common_map().placements();
    if (std::ranges::any_of(members, [&, &name = id](const sharing::Placement& member) {
          return member.layer.agent_id.text() == name;
        })) {
      note_newest(facts.shared_at, entry.heard_at);
    }
  }
}

void add_finds(const HelmetSharing& helmet, const std::map<LayerKey, Pose2>& places,
               HudFacts& facts) {
  for (const auto& find : helmet.detections()) {
    if (find.state == wire::DetectionState::dismissed ||
        find.state == wire::DetectionState::rescued || find.layer.floor != helmet.layer().floor) {
      continue;
    }
    const auto place = places.find(find.layer);
    if (place == places.end()) continue;
    Eigen::Vector2d p_m(find.x_m, find.y_m);
    if (find.group) {  // in the common frame, of which the layer's own place is known
      const auto& members = helmet.map().common_map().placements();
      const auto own = std::ranges::find(members, helmet.layer(), &sharing::Placement::layer);
      if (own == members.end()) continue;
      p_m = sharing::to_pose(own->T_fused_layer).inverse() * p_m;
    } else {
      p_m = place->second * p_m;
    }
    facts.finds.push_back({p_m, find.kind, find.state == wire::DetectionState::confirmed});
  }
}

bool seen_by_command(const HelmetSharing& helmet, const wire::Alert& alert) {
  return std::ranges::any_of(alert.acknowledged_by, [&](const std::string& name) {
    const auto* entry = helmet.roster().find(name);
    return entry != nullptr && entry->status.role == wire::Role::coordinator;
  });
}

void add_alerts(const HelmetSharing& helmet, HudFacts& facts) {
  for (const auto& [key, entry] : helmet.alerts().list().entries()) {
    const wire::Alert& alert = entry.alert;
    if (!entry.is_told || alert.state == wire::AlertState::cleared) continue;
    const bool is_mayday = alert.kind == wire::AlertKind::mayday;
    if (!is_mayday && !alert.subject_id.empty() && alert.subject_id != facts.id) continue;
    AlertFacts each{key, alert.kind, alert.subject_id, printable(alert.text)};
    if (each.about.empty() && is_mayday) each.about = alert.issuer_id;
    each.own = alert.issuer_id == facts.id;
    each.answered = sharing::has_answered(alert, facts.id);
    each.seen_by_command = seen_by_command(helmet, alert);
    facts.alerts.push_back(std::move(each));
  }
}

}  // namespace

HudFacts collect_facts(const HelmetSharing& helmet, std::optional<SteadyTime> mapped_at) {
  HudFacts facts;
  facts.id = helmet.speaker().id.text();
  facts.state = helmet.state();
  facts.shares = helmet.map().shares() && helmet.map().common_map().placements().size() > 1;
  facts.mapped_at = mapped_at;
  facts.tiles_behind = static_cast<std::uint32_t>(helmet.tiles_behind());
  const auto places = places_of(helmet);
  add_mates(helmet, places, facts);
  add_voices(helmet, facts);
  add_finds(helmet, places, facts);
  add_alerts(helmet, facts);
  return facts;
}

}  // namespace lifeline::hud
