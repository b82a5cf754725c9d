#include "coordinator/dashboard/frames.hpp"

#include <cmath>

#include "common/sharing/accept.hpp"
#include "coordinator/dashboard/readable.hpp"
#include "idl/dashboard.pb.h"

namespace lifeline::dashboard {

namespace pb = proto::dashboard;

std::string alerts_frame(const Coordinator& coordinator) {
  pb::ServerFrame frame;
  auto& alerts = *frame.mutable_alerts();
  const std::string& self = coordinator.speaker().id.text();
  for (const auto& [key, entry] : coordinator.alerts().entries()) {
    if (!entry.is_told) continue;
    auto& alert = *alerts.add_alerts();
    alert.set_issuer_id(entry.alert.issuer_id);
    alert.set_alert_id(entry.alert.alert_id);
    alert.set_kind(static_cast<pb::AlertKind>(entry.alert.kind));
    alert.set_state(static_cast<pb::AlertState>(entry.alert.state));
    alert.set_subject_id(entry.alert.subject_id);
    alert.set_text(readable(entry.alert.text));
    for (const auto& name : entry.alert.acknowledged_by) alert.add_acknowledged_by(name);
    alert.set_heard_at_s(to_seconds(coordinator.since_start(entry.heard_at)));
    alert.set_needs_answer(entry.alert.issuer_id != self &&
                           entry.alert.state == wire::AlertState::raised &&
                           !sharing::has_answered(entry.alert, self));
  }
  for (const auto& [id, entry] : coordinator.roster().entries()) {
    if (entry.status.role == wire::Role::helmet) alerts.add_helmets(id);
  }
  return frame.SerializeAsString();
}

std::string finds_frame(const Coordinator& coordinator) {
  pb::ServerFrame frame;
  auto& finds = *frame.mutable_finds();
  for (const auto& held : coordinator.detections()) {
    if (held.made_of.empty()) continue;
    auto& find = *finds.add_finds();
    find.set_agent_id(held.made_of.front().first);
    find.set_detection_id(held.made_of.front().second);
    // Finds of a smaller group lie in its lead's map frame.
    if (!held.group) find.set_map(to_string(held.layer));
    if (held.group && *held.group != 0) {
      for (const auto& member : coordinator.directive().members) {
        if (member.group != *held.group) continue;
        if (const auto lead = sharing::to_layer_key(member.layer)) find.set_map(to_string(*lead));
        break;
      }
    }
    find.set_kind(static_cast<pb::FindKind>(held.kind));
    find.set_state(static_cast<pb::FindState>(held.state));
    find.set_x_m(held.x_m);
    find.set_y_m(held.y_m);
    find.set_confidence(static_cast<float>(held.confidence));
    for (const auto& name : held.seen_by) find.add_seen_by(name);
    find.set_first_seen_at_ns(held.first.at_ns);
    find.set_last_seen_at_ns(held.last.at_ns);
    find.set_floor(held.layer.floor.value);
  }
  return frame.SerializeAsString();
}

std::string merges_frame(const Coordinator& coordinator) {
  pb::ServerFrame frame;
  auto& merges = *frame.mutable_merges();
  for (const auto& [pair, record] : coordinator.newest_matches()) {
    auto& merge = *merges.add_merges();
    const auto& result = record.result;
    merge.set_map_a(to_string(pair.a));
    merge.set_map_b(to_string(pair.b));
    merge.set_verdict(static_cast<pb::Verdict>(result.verdict));
    merge.set_reason(result.reason);
    merge.set_in_directive(record.in_directive);
    merge.set_is_parted_by_hand(coordinator.parted_by_hand().contains(pair));
    const auto edge = coordinator.merges().find(pair);
    merge.set_is_merged_by_hand(edge != coordinator.merges().end() && edge->second.by_hand);
    merge.set_at_s(to_seconds(record.at));
    merge.set_margin(result.margin);
    merge.set_match_ms(result.match_ms);
    merge.set_candidates(static_cast<std::uint32_t>(result.candidates.size()));
    if (result.candidates.empty()) continue;
    const auto& best = result.candidates.front();
    merge.set_x_m(best.T_a_b.x_m);
    merge.set_y_m(best.T_a_b.y_m);
    merge.set_yaw_rad(best.T_a_b.yaw_rad);
    merge.set_s_overlapping(best.s_overlapping);
    merge.set_acceptance_index(best.acceptance_index);
    merge.set_agreeing_wall_m(best.agreeing_wall_m);
    merge.set_conflict(best.conflict);
  }
  for (const auto& member : coordinator.directive().members) {
    if (member.group != 0) continue;
    if (const auto key = sharing::to_layer_key(member.layer)) merges.add_members(to_string(*key));
  }
  return frame.SerializeAsString();
}

std::string hello_frame(const Greeting& greeting, bool may_command) {
  pb::ServerFrame frame;
  auto& hello = *frame.mutable_hello();
  hello.set_protocol(1);
  hello.set_mission_id(greeting.mission_id);
  hello.set_coordinator_id(greeting.coordinator_id);
  hello.set_incarnation(greeting.incarnation);
  hello.set_may_command(may_command);
  hello.set_cell_size_um(static_cast<std::uint32_t>(std::lround(greeting.cell_size_m * 1e6)));
  hello.set_area_m2(greeting.area_m2);
  return frame.SerializeAsString();
}

std::string answer_frame(std::uint32_t request_id, const std::string& why_not) {
  pb::ServerFrame frame;
  auto& answer = *frame.mutable_answer();
  answer.set_request_id(request_id);
  answer.set_is_done(why_not.empty());
  answer.set_why_not(why_not);
  return frame.SerializeAsString();
}

}  // namespace lifeline::dashboard
