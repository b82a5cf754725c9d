#include "agents/sharing/helmet_sharing.hpp"

#include <algorithm>

#include "common/base/log.hpp"
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

HelmetSharing::HelmetSharing(HelmetSharingConfig config, HelmetChannels channels,
                             const Clock& clock)
    : config_(std::move(config)),
      channels_(std::move(channels)),
      clock_(clock),
      map_(config_.layer, config_.geometry),
      link_(config_.budget_bit_s, channels_.octets_on_air),
      publisher_(config_.publisher, config_.layer, config_.speaker, *channels_.tile),
      exchange_({config_.speaker, config_.layer, 0.5 * config_.budget_bit_s},
                std::move(channels_.exchange)),
      relay_(config_.speaker.id),
      one_way_(config_.speaker.id),
      alerts_(config_.speaker, wire::Role::helmet, std::move(channels_.alerts),
              std::move(channels_.alert), clock),
      pose_stamper_(config_.speaker),
      scan_stamper_(config_.speaker),
      status_stamper_(config_.speaker, config_.statuses_said),
      detection_stamper_(config_.speaker),
      relay_stamper_(config_.speaker) {}

Result<void> HelmetSharing::resume(const SharingMemory& memory) {
  for (const auto& [layer, tiles] : memory.layers) {
    for (const auto& [tile, kept] : tiles) {
      if (auto held = map_.store().restore(layer, tile, {kept.revision, kept.cells}); !held)
        return held;
    }
  }
  if (memory.directive) {
    if (auto followed = map_.follow(*memory.directive); !followed) return forward_error(followed);
    detections_.follow(*memory.directive);
  }
  const auto own = memory.layers.find(config_.layer);
  publisher_.resume(own == memory.layers.end() ? KeptTiles{} : own->second, memory.newest_before);
  start_ = memory.start;
  map_.update();
  return alerts_.resume(memory.alerts);
}

void HelmetSharing::step() {
  const SteadyTime now = clock_.steady_now();
  hear_statuses(now);
  alerts_.step(roster_, notes_);
  one_way_.step(now, roster_);
  hear_directives();
  hear_told_directives(now);
  hear_tiles(now);
  hear_detections(now);
  hear_poses(now);
  link_.measure(now, [this] { return audience(roster_, config_.speaker.id, clock_); });
  // Own tiles first: what others lack of these nobody else can send.
  speak(now);
  exchange_.step(now, clock_.wall_now(), roster_, map_.store(), link_);
  publisher_.outrank(exchange_.take_newer_elsewhere());
  update_map(now);
}

void HelmetSharing::finish() {
  map_.update();
}

void HelmetSharing::update_map(SteadyTime now) {
  map_.mark_changes();
  if (!fusing_.is_due(now)) return;
  const SteadyTime begun = clock_.steady_now();
  map_.update();
  fusing_.took(begun, clock_.steady_now());
}

void HelmetSharing::speak(SteadyTime now) {
  const Timestamp wall_now = clock_.wall_now();
  if (is_due(status_due_, now, config_.status_interval)) {
    update_map(now);  // the map that a status tells is that of the tiles that it tells
    wire::AgentStatus own = status();
    own.envelope = status_stamper_.next(wall_now);
    send(*channels_.status, own);
    said_ = std::move(own);
  }
  if (relay_.is_due(now, roster_, {map_.directive(), said_})) tell_directive(wall_now);
  if (state_.state == wire::AgentState::starting) return;
  if (is_due(pose_due_, now, pose_interval())) send_pose(wall_now);
  send_detections(now, wall_now);
  if (channels_.scan->has_reader() && link_.allows(Traffic::scan) &&
      is_due(scan_due_, now, config_.scan_interval)) {
    send_scan(wall_now);
  }
  if (auto sent = publisher_.step(now, wall_now, map_.store(), link_); !sent)
    notes_.refusals.note("tsd_tile", sent.error());
}

Duration HelmetSharing::pose_interval() const {
  // Who stands still for good leaves the link to the tiles.
  if (!link_.allows(Traffic::pose) || state_.state == wire::AgentState::finished)
    return config_.sparing_pose_interval;
  if (link_.is_late()) return config_.late_pose_interval;
  const Duration team = config_.team_pose_interval * static_cast<int>(link_.receivers());
  return std::max(config_.pose_interval, std::min(team, config_.longest_pose_interval));
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

void HelmetSharing::tell_directive(Timestamp wall_now) {
  spdlog::info("tells directive {} to helmets that hear no coordinator", map_.epoch().value);
  send(*channels_.relay.tell, wire::DirectiveCopy{relay_stamper_.next(wall_now),
                                                  config_.speaker.id.text(), map_.directive()});
}

/// A new find once it is none of the detector's slips, and what further sightings make of it as
/// often as the interval allows.
void HelmetSharing::send_detections(SteadyTime now, Timestamp wall_now) {
  told_.resize(std::max(told_.size(), state_.detections.size()));
  for (const OwnDetection& own : state_.detections) {
    Told& told = told_[own.number];
    if (own.sightings < OwnDetections::kLeastSightings || own.sightings == told.sightings) continue;
    if (told.sightings > 0 && now - told.at < config_.detection_interval) continue;
    told = {own.sightings, now};
    wire::Detection sample = to_wire(own, config_.layer, start_);
    sample.envelope = detection_stamper_.next(wall_now);
    if (auto applied = detections_.apply(sample); !applied)
      notes_.refusals.note("detection", applied.error());
    send(*channels_.detection, sample);
  }
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
  status.bytes_queued = link_.octets_queued();
  if (channels_.recording) {
    const RecordingStatus recording = channels_.recording();
    status.recording = recording.state;
    status.samples_unrecorded = recording.unrecorded;
  }
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
  roster_.tell_peers(clock_.steady_now(), status);
  return status;
}

std::uint64_t HelmetSharing::refused() const {
  return notes_.refusals.count() + exchange_.refused() + channels_.tiles->refused() +
         channels_.directives->refused() + channels_.statuses->refused() +
         channels_.detections->refused() + channels_.relay.told->refused() + alerts_.refused() +
         (channels_.poses ? channels_.poses->refused() : 0);
}

template <typename Outbox, typename Message>
void HelmetSharing::send(Outbox& outbox, const Message& message) {
  if (auto sent = outbox.put(message); !sent) {
    spdlog::warn("{} (the next sample is tried all the same)", sent.error().text);
  }
}

}  // namespace lifeline::sharing
