#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agents/sharing/directive_relay.hpp"
#include "agents/sharing/own_detections.hpp"
#include "agents/sharing/shared_map.hpp"
#include "agents/sharing/tile_publisher.hpp"
#include "common/sharing/alert_exchange.hpp"
#include "common/sharing/detection_list.hpp"
#include "common/sharing/fusing_pace.hpp"
#include "common/sharing/link_budget.hpp"
#include "common/sharing/one_way_watch.hpp"
#include "common/sharing/pose_watch.hpp"
#include "common/sharing/recording_status.hpp"
#include "common/sharing/roster.hpp"
#include "common/sharing/tile_exchange.hpp"

namespace lifeline::sharing {

/// A helmet's ends of the topics.
struct HelmetChannels {
  std::unique_ptr<wire::Outbox<wire::HelmetPose>> pose;
  std::unique_ptr<wire::Outbox<wire::HelmetScan>> scan;
  std::unique_ptr<wire::Outbox<wire::TsdTile>> tile;
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> status;
  std::unique_ptr<wire::Outbox<wire::Detection>> detection;
  std::unique_ptr<wire::Inbox<wire::TsdTile>> tiles;
  std::unique_ptr<wire::Inbox<wire::MergeDirective>> directives;
  std::unique_ptr<wire::Inbox<wire::AgentStatus>> statuses;
  std::unique_ptr<wire::Inbox<wire::Detection>> detections;
  ExchangeChannels exchange;
  RelayChannels relay;
  /// Octets that left this process so far, as the middleware counts them.
  std::function<std::uint64_t()> bytes_sent;
  /// Octets on the network so far, everything included: what the budget is held by.
  std::function<std::uint64_t()> octets_on_air;
  /// Everybody's alerts, and by what the own ones and answers leave. Without them nobody is
  /// alarmed.
  std::unique_ptr<wire::Inbox<wire::Alert>> alerts{};
  std::unique_ptr<wire::Outbox<wire::Alert>> alert{};
  /// Of the team-mates. Only where somebody looks at them: each reader costs a radio.
  std::unique_ptr<wire::Inbox<wire::HelmetPose>> poses{};
  /// Asked for the status, where there is a recording.
  std::function<RecordingStatus()> recording{};
};

struct HelmetSharingConfig {
  Speaker speaker;
  LayerKey layer;
  GridGeometry geometry;
  TilePublisherConfig publisher;
  double budget_bit_s = 256'000;    ///< of everything that it sends, to all receivers together
  std::uint64_t statuses_said = 0;  ///< while the mission was joined
  Duration pose_interval = std::chrono::milliseconds(100);
  /// What the poses of a large team are apart, all of them together: 100 a second, whoever listens
  /// (docs/decisions/0117). A single helmet's are never further apart than the topic's deadline
  /// allows.
  Duration team_pose_interval = std::chrono::milliseconds(10);
  Duration longest_pose_interval = std::chrono::milliseconds(400);
  /// While more is sent than the link passes, so that its queue drains.
  Duration late_pose_interval = std::chrono::milliseconds(150);
  /// While more is sent than the budget allows.
  Duration sparing_pose_interval = std::chrono::milliseconds(500);
  Duration scan_interval = std::chrono::milliseconds(200);
  Duration status_interval = std::chrono::seconds(1);
  Duration detection_interval = std::chrono::seconds(1);  ///< of the news of one find
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
  std::vector<OwnDetection> detections;  ///< all finds so far
};

/// What a helmet knew of the shared map before it was restarted.
struct SharingMemory {
  KeptLayers layers;  ///< everybody's, the own ones included
  std::optional<wire::MergeDirective> directive;
  Revision newest_before{};           ///< no process before this one gave a larger revision
  std::uint8_t start = 0;             ///< another one for each of 256 starts in a row
  std::vector<wire::Alert> alerts{};  ///< its own
};

/// The sharing half of a helmet: publishes own tiles, pose, status and finds; takes in everybody
/// else's; keeps the common map and the fleet's list of finds. A state machine: step() does
/// whatever is due and never blocks. One owner, not thread-safe.
class HelmetSharing {
 public:
  HelmetSharing(HelmetSharingConfig config, HelmetChannels channels, const Clock& clock);

  /// Goes on where a process before this one was stopped. Before the first step(). bad_data where
  /// the memory contradicts itself: nothing may be built on it then.
  [[nodiscard]] Result<void> resume(const SharingMemory& memory);
  /// Hears of each tile of others that is taken in, to keep it.
  void set_tile_listener(ReplicaStore::Listener listener) {
    map_.store().set_listener(std::move(listener));
  }

  /// Hears of each tile of the common map that changed or vanished.
  void set_map_listener(SharedMap::MapListener listener) {
    map_.set_map_listener(std::move(listener));
  }

  /// For measuring: hear of each own revision that leaves, and of each tile that came into the
  /// common map.
  void set_journal(TilePublisher::Listener published, SharedMap::FusedListener fused) {
    publisher_.set_listener(std::move(published));
    map_.set_fused_listener(std::move(fused));
  }

  /// What SLAM hands over: changed tiles of the own layer, and its state.
  /// `scanned_at`: when the oldest scan was taken that is new in the tiles.
  void put(const MapTiles& tiles, SteadyTime scanned_at = {}) { publisher_.put(tiles, scanned_at); }
  void put(HelmetState state) {
    state_ = std::move(state);
    publisher_.set_finished(state_.state == wire::AgentState::finished);
  }

  void step();
  /// After the last step(): brings the maps up to date, which a busy machine may be behind with.
  void finish();

  // What its wearer does (helmet_alerts.cpp).

  /// Calls everybody for help; nothing more where a mayday of its own is open.
  [[nodiscard]] Result<void> raise_mayday(const std::string& text);
  /// All is well again. not_found where no mayday of its own is open.
  [[nodiscard]] Result<void> cancel_mayday();
  /// The wearer has seen it. The alert's state stays: to acknowledge is the commander's.
  [[nodiscard]] Result<void> answer(const AlertKey& alert);
  /// Its own mayday, while it is open.
  [[nodiscard]] std::optional<AlertKey> own_mayday() const;

  /// For SLAM: what changed in the peers' part of the working map.
  [[nodiscard]] std::optional<PeerUpdate> take_peer_update() { return map_.take_peer_update(); }

  [[nodiscard]] const Speaker& speaker() const { return config_.speaker; }
  [[nodiscard]] const LayerKey& layer() const { return config_.layer; }
  [[nodiscard]] const HelmetState& state() const { return state_; }
  /// Everybody's alerts.
  [[nodiscard]] const AlertExchange& alerts() const { return alerts_; }
  [[nodiscard]] const Roster& roster() const { return roster_; }
  /// Where the team-mates were last heard to be, where poses are heard at all.
  [[nodiscard]] const PoseWatch& poses() const { return poses_; }
  /// Own tiles not yet published.
  [[nodiscard]] std::size_t tiles_behind() const { return publisher_.waiting(); }
  [[nodiscard]] const SharedMap& map() const { return map_; }
  /// Everybody's finds, each once.
  [[nodiscard]] std::vector<FleetDetection> detections() const { return detections_.list(); }
  [[nodiscard]] wire::AgentStatus status() const;
  /// Samples that were refused, ours and the middleware's count.
  [[nodiscard]] std::uint64_t refused() const;

 private:
  void hear_statuses(SteadyTime now);
  void hear_directives();
  void hear_told_directives(SteadyTime now);
  void follow(const wire::MergeDirective& directive, std::string_view topic);
  void hear_tiles(SteadyTime now);
  void hear_detections(SteadyTime now);
  void hear_poses(SteadyTime now);
  [[nodiscard]] bool is_own_map(const std::string& agent_id, std::uint32_t map_id) const;
  void speak(SteadyTime now);
  void update_map(SteadyTime now);
  [[nodiscard]] Duration pose_interval() const;
  void send_pose(Timestamp wall_now);
  void send_scan(Timestamp wall_now);
  void tell_directive(Timestamp wall_now);
  void send_detections(SteadyTime now, Timestamp wall_now);
  template <typename Outbox, typename Message>
  void send(Outbox& outbox, const Message& message);

  HelmetSharingConfig config_;
  HelmetChannels channels_;
  const Clock& clock_;
  SharedMap map_;
  LinkBudget link_;
  TilePublisher publisher_;
  TileExchange exchange_;
  Roster roster_;
  DirectiveRelay relay_;
  wire::AgentStatus said_;  ///< the last own status
  FusingPace fusing_;
  OneWayWatch one_way_;
  HelmetState state_;
  DetectionList detections_;
  AlertExchange alerts_;
  PoseWatch poses_;
  struct Told {
    std::uint32_t sightings = 0;
    SteadyTime at{};
  };
  std::uint8_t start_ = 0;
  std::vector<Told> told_;  ///< of each own find, what was published last
  EnvelopeStamper pose_stamper_, scan_stamper_, status_stamper_, detection_stamper_, relay_stamper_;
  SteadyTime pose_due_{}, scan_due_{}, status_due_{};
  bool contested_ = false;
  HearingNotes notes_;
};

}  // namespace lifeline::sharing
