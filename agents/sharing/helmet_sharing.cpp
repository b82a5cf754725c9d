#include "agents/sharing/helmet_sharing.hpp"

#include <algorithm>

#include "common/base/log.hpp"
#include "common/sharing/accept.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::sharing {
namespace {

// True when `due` has passed; then sets it one interval on.
bool is_due(SteadyTime& due, SteadyTime now, Duration interval) {
  if (now < due) return false;
  due = now + interval;
  return true;
}

double known_area_m2(const ReplicaStore& store, const LayerKey& layer) {
  std::int64_t known = 0;
  if (const auto* tiles = store.find(layer); tiles != nullptr) {
    for (const auto& [tile, held] : *tiles) {
      known += std::count_if(held.cells->begin(), held.cells->end(),
                             [](QuantisedCell cell) { return cell.weight != 0; });
    }
  }
  return static_cast<double>(known) * store.geometry().cell_size_m * store.geometry().cell_size_m;
}

}  // namespace

void log_refused(std::uint64_t count, const std::string& topic, const Error& error) {
  if (count % 1000 == 1)
    spdlog::warn("{}: refused a sample ({} so far): {}", topic, count, error.text);
}

HelmetSharing::HelmetSharing(HelmetSharingConfig config, HelmetChannels channels,
                             const Clock& clock)
    : config_(std::move(config)),
      channels_(std::move(channels)),
      clock_(clock),
      map_(config_.layer, config_.geometry),
      publisher_(config_.publisher, config_.layer, config_.speaker, *channels_.tile),
      pose_stamper_(config_.speaker),
      scan_stamper_(config_.speaker),
      status_stamper_(config_.speaker) {}

void HelmetSharing::step() {
  const SteadyTime now = clock_.steady_now();
  hear_statuses(now);
  hear_directives();
  hear_tiles();
  speak(now);
  map_.update();
}

void HelmetSharing::hear_statuses(SteadyTime now) {
  for (const auto& status : channels_.statuses->take()) {
    if (auto accepted = check_envelope(status.envelope, config_.speaker.mission_id); !accepted) {
      refuse("agent_status", accepted.error());
      continue;
    }
    const bool own_id = status.agent_id == config_.speaker.id.text();
    if (own_id && status.envelope.incarnation != config_.speaker.incarnation.value) {
      if (!contested_) {
        spdlog::error("another helmet calls itself {} too; rename one of them", status.agent_id);
      }
      contested_ = true;
    }
    if (!own_id) roster_.hear(status, now);
  }
}

void HelmetSharing::hear_directives() {
  for (const auto& directive : channels_.directives->take()) {
    auto accepted = check_envelope(directive.envelope, config_.speaker.mission_id);
    if (!accepted) {
      refuse("merge_directive", accepted.error());
      continue;
    }
    if (auto followed = map_.follow(directive); !followed) {
      refuse("merge_directive", followed.error());
    } else if (*followed) {
      spdlog::info("follows directive {}: {} helmets in the common map", directive.epoch,
                   map_.common_map().placements().size());
    }
  }
}

void HelmetSharing::hear_tiles() {
  for (const auto& sample : channels_.tiles->take()) {
    if (sample.layer.agent_id == config_.speaker.id.text() &&
        sample.layer.map_id == config_.layer.map_id.value) {
      continue;  // our own, come back
    }
    auto accepted = check_envelope(sample.envelope, config_.speaker.mission_id);
    if (!accepted) {
      refuse("tsd_tile", accepted.error());
    } else if (auto applied = map_.store().apply(sample); !applied) {
      refuse("tsd_tile", applied.error());
    }
  }
}

void HelmetSharing::speak(SteadyTime now) {
  const Timestamp wall_now = clock_.wall_now();
  if (is_due(status_due_, now, config_.status_interval)) {
    wire::AgentStatus own = status();
    own.envelope = status_stamper_.next(wall_now);
    send(*channels_.status, own);
  }
  if (state_.state == wire::AgentState::starting) return;
  if (is_due(pose_due_, now, config_.pose_interval)) send_pose(wall_now);
  if (channels_.scan->has_reader() && is_due(scan_due_, now, config_.scan_interval))
    send_scan(wall_now);
  if (auto sent = publisher_.step(now, wall_now, map_.store()); !sent)
    refuse("tsd_tile", sent.error());
}

void HelmetSharing::send_pose(Timestamp wall_now) {
  wire::HelmetPose pose;
  pose.envelope = pose_stamper_.next(wall_now);
  pose.agent_id = config_.speaker.id.text();
  pose.map_id = config_.layer.map_id.value;
  pose.floor = config_.layer.floor.value;
  pose.T_map_head = state_.T_map_head;
  pose.speed_m_s = static_cast<float>(state_.speed_m_s);
  pose.trust_percent = state_.trust_percent;
  send(*channels_.pose, pose);
}

void HelmetSharing::send_scan(Timestamp wall_now) {
  if (state_.ranges_cm.empty()) return;
  wire::HelmetScan scan;
  scan.envelope = scan_stamper_.next(wall_now);
  scan.agent_id = config_.speaker.id.text();
  scan.map_id = config_.layer.map_id.value;
  scan.floor = config_.layer.floor.value;
  scan.T_map_head = state_.T_map_head;
  scan.first_angle_rad = static_cast<float>(state_.first_angle_rad);
  scan.angle_step_rad = static_cast<float>(state_.angle_step_rad);
  scan.ranges_cm = state_.ranges_cm;
  send(*channels_.scan, scan);
}

wire::AgentStatus HelmetSharing::status() const {
  wire::AgentStatus status;
  status.agent_id = config_.speaker.id.text();
  status.role = wire::Role::helmet;
  status.state = state_.state;
  status.lidar = state_.lidar;
  status.attitude = state_.attitude;
  status.duplicate_id_heard = contested_;
  status.map_id = config_.layer.map_id.value;
  status.floor = config_.layer.floor.value;
  status.scans = state_.scans;
  status.scans_dropped = state_.scans_dropped;
  status.failures = state_.failures;
  status.samples_refused = refused();
  status.bytes_sent = channels_.bytes_sent ? channels_.bytes_sent() : 0;
  status.tiles_behind = static_cast<std::uint32_t>(publisher_.waiting());
  status.explored_m2 = static_cast<float>(known_area_m2(map_.store(), config_.layer));
  status.slam_ms_median = static_cast<float>(state_.slam_ms_median);
  status.epoch_applied = map_.epoch().value;
  status.fingerprint = map_.fingerprint();
  status.common_map_sha256 = map_.common_map_sha256();
  for (const auto& [layer, tiles] : map_.store().layers()) {
    if (status.layers.size() == wire::kMaxLayers) break;
    status.layers.push_back({to_layer_name(layer), static_cast<std::uint32_t>(tiles.size()),
                             map_.store().digest(layer)});
  }
  status.peers_heard = roster_.present(clock_.steady_now());
  if (status.peers_heard.size() > wire::kMaxPeers) status.peers_heard.resize(wire::kMaxPeers);
  return status;
}

std::uint64_t HelmetSharing::refused() const {
  return refused_ + channels_.tiles->refused() + channels_.directives->refused() +
         channels_.statuses->refused();
}

void HelmetSharing::refuse(const std::string& topic, const Error& error) {
  log_refused(++refused_, topic, error);
}

template <typename Outbox, typename Message>
void HelmetSharing::send(Outbox& outbox, const Message& message) {
  if (auto sent = outbox.put(message); !sent) {
    spdlog::warn("{} (the next sample is tried all the same)", sent.error().text);
  }
}

}  // namespace lifeline::sharing
