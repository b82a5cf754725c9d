#include "agents/helmet_mapper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/log.hpp"
#include "common/base/quantile.hpp"
#include "common/wire/limits.hpp"

namespace lifeline {
namespace {

constexpr std::size_t kMedianOver = 100;  // scans

wire::AgentState state_of(const slam::SlamStep& step) {
  if (step.lost) return wire::AgentState::lost;
  switch (step.verdict) {
    case slam::Verdict::accepted:
      return wire::AgentState::tracking;
    case slam::Verdict::weak:
      return wire::AgentState::weak;
    case slam::Verdict::rejected:
      break;
  }
  return step.trust_percent == 0 ? wire::AgentState::lost : wire::AgentState::weak;
}

wire::SensorHealth health_of(sensing::AttitudeHealth attitude) {
  switch (attitude) {
    case sensing::AttitudeHealth::good:
      return wire::SensorHealth::good;
    case sensing::AttitudeHealth::degraded:
      return wire::SensorHealth::degraded;
    case sensing::AttitudeHealth::silent:
      return wire::SensorHealth::silent;
    case sensing::AttitudeHealth::failed:
      break;
  }
  return wire::SensorHealth::failed;
}

wire::DetectionKind kind_of(sensing::SightedKind kind) {
  return kind == sensing::SightedKind::victim ? wire::DetectionKind::victim
                                              : wire::DetectionKind::uwb_tag;
}

// Every n-th beam, so that a sweep fits into one sample; ranges up to 655 m, 0 = nothing known.
void thin_out(const Scan2& scan, sharing::HelmetState& state) {
  state.ranges_cm.clear();
  if (scan.beams.size() < 2) return;
  const std::size_t stride = (scan.beams.size() + wire::kMaxScanBeams - 1) / wire::kMaxScanBeams;
  state.first_angle_rad = scan.beams[0].angle_rad;
  state.angle_step_rad =
      (scan.beams[1].angle_rad - scan.beams[0].angle_rad) * static_cast<float>(stride);
  for (std::size_t i = 0; i < scan.beams.size(); i += stride) {
    const Beam2& beam = scan.beams[i];
    const float range_cm =
        beam.kind == BeamKind::hit ? std::min(100.0F * beam.range_m, 65535.0F) : 0.0F;
    state.ranges_cm.push_back(static_cast<std::uint16_t>(std::lround(range_cm)));
  }
}

}  // namespace

void HelmetMapper::resume(MapperMemory memory) {
  earlier_ = std::move(memory.trajectory);
  state_ = std::move(memory.state);
  lost_scans_ = memory.lost_scans;
  relocalisations_ = memory.relocalisations;
  just_resumed_ = true;
  slam_.resume(std::move(memory.layer), memory.last);
  for (const TileIndex tile : slam_.take_changed_tiles()) changed_.insert(tile);
}

std::vector<StampedPose> HelmetMapper::trajectory() const {
  std::vector<StampedPose> all = earlier_;
  const auto own = slam_.trajectory();
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

void HelmetMapper::step(const sensing::RawScan& raw) {
  const auto started = std::chrono::steady_clock::now();
  Scan2 scan = sensing::project_scan(raw, projection_);
  const sensing::SensedMotion motion = motion_.next(raw);
  const slam::ScanFaults faults = check_.next(raw, motion);
  if (faults.frozen) scan.beams.clear();
  const slam::SlamStep step = slam_.step(scan, motion, slam::is_doubtful(faults, raw));
  step_ms_.push_back(1e3 * to_seconds(std::chrono::steady_clock::now() - started));
  for (const TileIndex tile : slam_.take_changed_tiles()) changed_.insert(tile);
  note_sightings(raw, step);
  note_step(raw, scan, step);
}

/// Where the head is not known well, nobody is to be looked for where it was seen from there.
void HelmetMapper::note_sightings(const sensing::RawScan& raw, const slam::SlamStep& step) {
  if (step.lost || step.verdict == slam::Verdict::rejected) return;
  for (const sensing::Sighting& each : raw.sightings) {
    detections_.note({kind_of(each.kind), step.T_map_head * each.p_head_m, each.sigma_m,
                      each.confidence, raw.stamp});
  }
}

void HelmetMapper::note_step(const sensing::RawScan& raw, const Scan2& scan,
                             const slam::SlamStep& step) {
  if (last_) {
    const double elapsed_s = to_seconds(raw.stamp - last_->stamp);
    const double moved_m = (step.T_map_head.translation() - last_->pose.translation()).norm();
    state_.speed_m_s = elapsed_s > 0.0 ? moved_m / elapsed_s : 0.0;
  }
  last_ = StampedPose{raw.stamp, step.T_map_head};
  if (raw.T_world_head_truth) truth_.push_back({raw.stamp, *raw.T_world_head_truth});
  state_.state = state_of(step);
  state_.attitude = health_of(raw.attitude_health);
  state_.T_map_head = step.T_map_head;
  state_.trust_percent = static_cast<std::uint8_t>(std::clamp(step.trust_percent, 0, 100));
  ++state_.scans;
  if (step.verdict == slam::Verdict::rejected) ++state_.failures;
  note_lost(raw, step);
  thin_out(scan, state_);
}

void HelmetMapper::note_lost(const sensing::RawScan& raw, const slam::SlamStep& step) {
  if (step.lost) ++lost_scans_;
  if (step.lost && !was_lost_) {
    spdlog::warn("lost: looks for its place; nothing is mapped until it is found");
  }
  was_lost_ = step.lost;
  if ((step.lost || std::exchange(just_resumed_, false)) && !lost_since_) lost_since_ = raw.stamp;
  if (step.source == slam::PoseSource::relocalised) ++relocalisations_;
  if (!step.lost && step.verdict != slam::Verdict::rejected && lost_since_) {
    spdlog::info("found its place, {:.1f} s of scans later: x {:.2f} m, y {:.2f} m",
                 to_seconds(raw.stamp - *std::exchange(lost_since_, {})), step.T_map_head.x_m,
                 step.T_map_head.y_m);
  }
}

void HelmetMapper::apply(const sharing::PeerUpdate& peers) {
  slam_.set_own_weight(peers.own_weight);
  for (const auto& [tile, cells] : peers.tiles) slam_.set_peer_tile(tile, cells);
}

sharing::MapTiles HelmetMapper::take_changed_tiles() {
  sharing::MapTiles tiles;
  for (const TileIndex tile : changed_) {
    const TsdTile* cells = slam_.layer().find(tile);
    tiles.emplace_back(tile, std::make_shared<const QuantisedTile>(quantise(*cells)));
  }
  changed_.clear();
  return tiles;
}

sharing::HelmetState HelmetMapper::state() const {
  sharing::HelmetState state = state_;
  state.detections = detections_.all();
  const std::size_t recent = std::min(step_ms_.size(), kMedianOver);
  state.slam_ms_median =
      quantile({step_ms_.end() - static_cast<std::ptrdiff_t>(recent), step_ms_.end()}, 0.5);
  return state;
}

}  // namespace lifeline
