// Frames of what moves: poses, trails, and how everybody is.
#include <cmath>
#include <optional>

#include "common/sharing/accept.hpp"
#include "common/sharing/helmet_mark.hpp"
#include "coordinator/dashboard/frames.hpp"
#include "coordinator/dashboard/on_common.hpp"
#include "coordinator/dashboard/readable.hpp"
#include "idl/dashboard.pb.h"

namespace lifeline::dashboard {
namespace {

namespace pb = proto::dashboard;

constexpr double kTrailStepM = 0.25;
constexpr std::size_t kMostTrailPoints = 1500;

// One standard deviation, in the worst direction, of a point `p` (from the frame's origin, turned
// into the common frame) that a place of this covariance (xx, xy, xa, yy, ya, aa) carries.
double sigma_at(const std::array<double, 6>& c, const Eigen::Vector2d& p) {
  const double xx = c[0] - 2 * p.y() * c[2] + p.y() * p.y() * c[5];
  const double yy = c[3] + 2 * p.x() * c[4] + p.x() * p.x() * c[5];
  const double xy = c[1] + p.x() * c[2] - p.y() * c[4] - p.x() * p.y() * c[5];
  const double mean = 0.5 * (xx + yy), spread = std::hypot(0.5 * (xx - yy), xy);
  return std::sqrt(std::max(0.0, mean + spread));
}

std::string own_map(const wire::AgentStatus& status) {
  const auto key = sharing::to_layer_key({status.agent_id, status.map_id, status.floor});
  return key ? to_string(*key) : std::string();
}

void fill_status(const wire::AgentStatus& status, pb::Agent& agent) {
  agent.set_agent_id(readable(status.agent_id));
  agent.set_is_helmet(status.role == wire::Role::helmet);
  agent.set_state(static_cast<pb::AgentState>(status.state));
  agent.set_lidar(static_cast<pb::Health>(status.lidar));
  agent.set_attitude(static_cast<pb::Health>(status.attitude));
  if (status.battery_percent <= 100) agent.set_battery_percent(status.battery_percent);
  agent.set_bytes_queued(status.bytes_queued);
  agent.set_bytes_sent(status.bytes_sent);
  agent.set_tiles_behind(status.tiles_behind);
  agent.set_explored_m2(status.explored_m2);
  agent.set_epoch_applied(status.epoch_applied);
  agent.set_scans(status.scans);
  agent.set_scans_dropped(status.scans_dropped);
  agent.set_failures(status.failures);
  agent.set_slam_ms(status.slam_ms_median);
  agent.set_floor(status.floor);
}

}  // namespace

std::string poses_frame(const Coordinator& coordinator, SteadyTime now) {
  pb::ServerFrame frame;
  auto& poses = *frame.mutable_poses();
  poses.set_now_s(to_seconds(coordinator.since_start(now)));
  for (const auto& [id, entry] : coordinator.poses().entries()) {
    const auto layer = sharing::to_layer_key({id, entry.pose.map_id, entry.pose.floor});
    if (!layer) continue;
    const auto place = on_common(coordinator, *layer);
    const Pose2 T = place ? place->T_common_map * entry.pose.T_map_head : entry.pose.T_map_head;
    auto& pose = *poses.add_poses();
    pose.set_agent_id(id);
    if (!place) pose.set_map(to_string(*layer));
    pose.set_x_m(static_cast<float>(T.x_m));
    pose.set_y_m(static_cast<float>(T.y_m));
    pose.set_yaw_rad(static_cast<float>(T.yaw_rad));
    if (place) {
      const Eigen::Vector2d from_origin = T.translation() - place->T_common_map.translation();
      pose.set_sigma_m(static_cast<float>(sigma_at(place->covariance, from_origin)));
    }
    pose.set_trust_percent(entry.pose.trust_percent);
    pose.set_speed_m_s(entry.pose.speed_m_s);
    pose.set_heard_at_s(to_seconds(coordinator.since_start(entry.heard_at)));
    pose.set_floor(entry.pose.floor);
  }
  return frame.SerializeAsString();
}

std::string fleet_frame(const Coordinator& coordinator, const Observed& observed, SteadyTime now) {
  const std::string& sha256 = observed.common_map_sha256;
  pb::ServerFrame frame;
  auto& fleet = *frame.mutable_fleet();
  fleet.set_now_s(to_seconds(coordinator.since_start(now)));
  fleet.set_epoch(coordinator.directive().epoch);
  fleet.set_leads(coordinator.leads());
  fleet.set_common_map_sha256(sha256);
  fleet.set_common_map_changed_at_s(
      to_seconds(coordinator.since_start(observed.common_map_changed_at)));
  if (!sha256.empty()) fleet.add_maps("");
  for (const auto& [layer, tiles] : coordinator.store().layers()) fleet.add_maps(to_string(layer));
  for (const auto& [id, entry] : coordinator.roster().entries()) {
    auto& agent = *fleet.add_agents();
    fill_status(entry.status, agent);
    if (const auto number = observed.numbers.find(id); number != observed.numbers.end())
      agent.set_number(number->second);
    if (agent.is_helmet()) {
      const sharing::HelmetMark mark = sharing::mark_of(agent.agent_id());
      agent.set_label(mark.label);
      agent.set_shape(mark.shape);
    }
    agent.set_presence(static_cast<pb::Presence>(sharing::Roster::presence(entry, now)));
    agent.set_heard_at_s(to_seconds(coordinator.since_start(entry.heard_at)));
    agent.set_is_id_used_twice(entry.contested || entry.status.duplicate_id_heard);
    agent.set_map(own_map(entry.status));
    if (const auto* pose = coordinator.poses().find(id))
      agent.set_loss(static_cast<float>(pose->loss));
    const auto key = sharing::to_layer_key({id, entry.status.map_id, entry.status.floor});
    agent.set_is_in_common_map(key && on_common(coordinator, *key).has_value());
    agent.set_holds_same_map(
        !sha256.empty() &&
        std::equal(sha256.begin(), sha256.end(), entry.status.common_map_sha256.begin(),
                   entry.status.common_map_sha256.end(),
                   [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }));
  }
  return frame.SerializeAsString();
}

std::string trails_frame(const Coordinator& coordinator) {
  pb::ServerFrame frame;
  auto& trails = *frame.mutable_trails();
  for (const auto& [layer, path] : coordinator.paths()) {
    const auto place = on_common(coordinator, layer);
    auto& trail = *trails.add_trails();
    trail.set_agent_id(layer.agent_id.text());
    if (!place) trail.set_map(to_string(layer));
    // The newest part of a very long way, in steps that a line does not show.
    std::vector<Eigen::Vector2d> points;
    for (auto p = path.rbegin(); p != path.rend() && points.size() < kMostTrailPoints; ++p) {
      if (points.empty() || (*p - points.back()).norm() >= kTrailStepM) points.push_back(*p);
    }
    Eigen::Vector2i before(0, 0);
    for (auto p = points.rbegin(); p != points.rend(); ++p) {
      const Eigen::Vector2d at = place ? place->T_common_map * *p : *p;
      const Eigen::Vector2i cm = (100.0 * at).array().round().cast<int>();
      trail.add_points_cm(cm.x() - before.x());
      trail.add_points_cm(cm.y() - before.y());
      before = cm;
    }
  }
  return frame.SerializeAsString();
}

}  // namespace lifeline::dashboard
