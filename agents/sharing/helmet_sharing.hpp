#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agents/sharing/shared_map.hpp"
#include "agents/sharing/tile_publisher.hpp"
#include "common/sharing/roster.hpp"

namespace lifeline::sharing {

/// A helmet's ends of the topics.
struct HelmetChannels {
  std::unique_ptr<wire::Outbox<wire::HelmetPose>> pose;
  std::unique_ptr<wire::Outbox<wire::HelmetScan>> scan;
  std::unique_ptr<wire::Outbox<wire::TsdTile>> tile;
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> status;
  std::unique_ptr<wire::Inbox<wire::TsdTile>> tiles;
  std::unique_ptr<wire::Inbox<wire::MergeDirective>> directives;
  std::unique_ptr<wire::Inbox<wire::AgentStatus>> statuses;
  /// Octets that left this process so far, as the middleware counts them.
  std::function<std::uint64_t()> bytes_sent;
};

struct HelmetSharingConfig {
  Speaker speaker;
  LayerKey layer;
  GridGeometry geometry;
  TilePublisherConfig publisher;
  Duration pose_interval = std::chrono::milliseconds(100);
  Duration scan_interval = std::chrono::milliseconds(200);
  Duration status_interval = std::chrono::seconds(1);
};

/// What SLAM last said of itself.
struct HelmetState {
  wire::AgentState state = wire::AgentState::starting;
  wire::SensorHealth lidar = wire::SensorHealth::good;
  wire::SensorHealth attitude = wire::SensorHealth::good;
  Pose2 T_map_head;
  double speed_m_s = 0.0;
  std::uint8_t trust_percent = 0;
  std::uint64_t scans = 0;
  std::uint64_t scans_dropped = 0;
  std::uint64_t failures = 0;
  double slam_ms_median = 0.0;
  double first_angle_rad = 0.0;  ///< of `ranges_cm`
  double angle_step_rad = 0.0;
  std::vector<std::uint16_t> ranges_cm;  ///< the latest projected scan, thinned; 0 = nothing known
};

/// The sharing half of a helmet: publishes own tiles, pose and status; takes in everybody else's;
/// keeps the common map. A state machine: step() does whatever is due and never blocks. One owner,
/// not thread-safe.
class HelmetSharing {
 public:
  HelmetSharing(HelmetSharingConfig config, HelmetChannels channels, const Clock& clock);

  /// What SLAM hands over: changed tiles of the own layer, and its state.
  void put(const MapTiles& tiles) { publisher_.put(tiles); }
  void put(HelmetState state) { state_ = std::move(state); }

  void step();

  /// For SLAM: what changed in the peers' part of the working map.
  [[nodiscard]] std::optional<PeerUpdate> take_peer_update() { return map_.take_peer_update(); }

  /// Own tiles not yet published.
  [[nodiscard]] std::size_t tiles_behind() const { return publisher_.waiting(); }
  [[nodiscard]] const SharedMap& map() const { return map_; }
  [[nodiscard]] wire::AgentStatus status() const;
  /// Samples that were refused, ours and the middleware's count.
  [[nodiscard]] std::uint64_t refused() const;

 private:
  void hear_statuses(SteadyTime now);
  void hear_directives();
  void hear_tiles();
  void speak(SteadyTime now);
  void send_pose(Timestamp wall_now);
  void send_scan(Timestamp wall_now);
  void refuse(const std::string& topic, const Error& error);
  template <typename Outbox, typename Message>
  void send(Outbox& outbox, const Message& message);

  HelmetSharingConfig config_;
  HelmetChannels channels_;
  const Clock& clock_;
  SharedMap map_;
  TilePublisher publisher_;
  Roster roster_;
  HelmetState state_;
  EnvelopeStamper pose_stamper_, scan_stamper_, status_stamper_;
  SteadyTime pose_due_{}, scan_due_{}, status_due_{};
  bool contested_ = false;
  std::uint64_t refused_ = 0;
};

/// Logs one line and then only every thousandth: a flood of bad samples must not become a flood of
/// text.
void log_refused(std::uint64_t count, const std::string& topic, const Error& error);

}  // namespace lifeline::sharing
