#pragma once

// What goes between processes, as plain structs: one per topic of docs/topics.md, field by field as
// in idl/*.idl. They hold whatever the sender said; what may be believed is checked by the reader
// (common/sharing/accept.hpp).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/grid/pose2.hpp"

namespace lifeline::wire {

inline constexpr std::uint16_t kProtocolVersion = 1;

/// How every sample begins.
struct Envelope {
  std::uint16_t protocol_version = kProtocolVersion;
  std::string mission_id;
  std::string sender_id;
  std::uint64_t incarnation = 0;  ///< random, new at each start of the sender
  /// Counts the sender's samples of this topic, from 1 (`sequence_number` in the IDL, where
  /// `sequence` is a keyword).
  std::uint64_t sequence = 0;
  std::int64_t sent_at_ns = 0;  ///< the sender's own wall clock; never compared with another's
  std::vector<std::uint8_t> signature;  ///< empty, or 64 octets once signing is switched on
};

/// Which layer a sample speaks of.
struct LayerName {
  std::string agent_id;
  std::uint32_t map_id = 0;
  std::int16_t floor = 0;
  auto operator<=>(const LayerName&) const = default;
};

/// lifeline/pose
struct HelmetPose {
  Envelope envelope;
  std::string agent_id;
  std::uint32_t map_id = 0;
  std::int16_t floor = 0;
  Pose2 T_map_head;
  float speed_m_s = 0.0F;
  std::uint8_t trust_percent = 0;  ///< 0 = lost
};

/// lifeline/scan: the projected scan, thinned.
struct HelmetScan {
  Envelope envelope;
  std::string agent_id;
  std::uint32_t map_id = 0;
  std::int16_t floor = 0;
  Pose2 T_map_head;
  float first_angle_rad = 0.0F;
  float angle_step_rad = 0.0F;
  std::vector<std::uint16_t> ranges_cm;  ///< 0 = nothing known
};

/// lifeline/tsd_tile: a part of a tile at a revision; see tile_parts.hpp.
struct TsdTile {
  Envelope envelope;
  LayerName layer;
  std::int32_t tile_x = 0;
  std::int32_t tile_y = 0;
  std::uint8_t part = 0;              ///< from 0
  std::uint8_t parts = 1;             ///< of this revision
  std::uint64_t revision = 0;         ///< from 1; grows with each publication of this tile
  std::vector<std::uint8_t> payload;  ///< this part of it
};

/// lifeline/tile_copy: a tile sent again by whoever was asked for it, word for word as its owner
/// published it. The envelope is the sender's.
struct TileCopy : TsdTile {};

struct TileName {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::uint64_t revision_held = 0;  ///< the newest revision that the requester has
};

/// lifeline/tile_request: of the layer's tiles with after < (x, y) <= to, ordered by x and then y,
/// the requester holds `held` and no others. It asks one participant for what is newer or missing.
struct TileRequest {
  Envelope envelope;
  std::string requester_id;
  std::string asked_id;
  LayerName layer;
  std::int32_t after_x = 0;
  std::int32_t after_y = 0;
  std::int32_t to_x = 0;
  std::int32_t to_y = 0;
  std::vector<TileName> held;
};

/// A rigid transform as the coordinator wrote it: readers need no libm, so that all fuse to the
/// same bits.
struct FixedTransform {
  static constexpr std::int32_t kOne = 1 << 30;
  std::int32_t cos_q30 = kOne;
  std::int32_t sin_q30 = 0;
  std::int64_t x_um = 0;
  std::int64_t y_um = 0;
  bool operator==(const FixedTransform&) const = default;
};

struct DirectiveMember {
  LayerName layer;
  std::uint16_t group =
      0;  ///< members of one group share a common frame: that of the group's first member, its lead
  FixedTransform T_common_map;
  std::array<double, 6>
      covariance{};      ///< upper triangle of x, y, yaw (m2, m rad, rad2), row by row
  float quality = 0.0F;  ///< in [0, 1]
};

/// lifeline/merge_directive: the coordinator's whole current answer.
struct MergeDirective {
  Envelope envelope;
  std::string mission_id;
  std::uint64_t epoch = 0;
  std::uint16_t own_weight_permille = 500;  ///< w_T1 of Eq. 8-10 times 1000
  std::vector<DirectiveMember>
      members;  ///< ordered by group; within a group the lead first, then by layer
};

/// lifeline/directive_copy: a directive as its coordinator said it, told by a helmet to those who
/// cannot hear that one. The envelope is the teller's.
struct DirectiveCopy {
  Envelope envelope;
  std::string teller_id;
  MergeDirective directive;
};

enum class Verdict : std::uint8_t { accepted = 0, wait = 1, rejected = 2 };

struct MergeCandidate {
  Pose2 T_a_b;
  double s_overlapping = 0.0;     ///< Eq. 12
  double acceptance_index = 0.0;  ///< Eq. 13
  double wall_agreement =
      0.0;  ///< share of the overlap's wall cells that meet a wall facing the same way
  double conflict = 0.0;  ///< share of the overlap's wall cells that lie in the other's free space
  double score = 0.0;     ///< what the candidates are ranked by
};

/// lifeline/merge_evidence: one pair's candidates, figures, verdict and reason.
struct MergeEvidence {
  Envelope envelope;
  LayerName a;
  LayerName b;
  Verdict verdict = Verdict::wait;
  std::string reason;
  double margin = 0.0;  ///< the best candidate's score over the second distinct one's
  double match_ms = 0.0;
  std::vector<MergeCandidate> candidates;  ///< best first
};

enum class Role : std::uint8_t { helmet = 0, coordinator = 1 };
enum class AgentState : std::uint8_t {
  starting = 0,
  tracking = 1,
  weak = 2,
  lost = 3,
  finished = 4
};
enum class SensorHealth : std::uint8_t { good = 0, degraded = 1, silent = 2, failed = 3 };

/// Whether a sender records what it hears.
enum class RecordingState : std::uint8_t {
  off = 0,
  on = 1,
  failing = 2,  ///< the disk refuses: nothing is recorded until there is room
};

/// What a sender holds of one layer.
struct LayerDigest {
  LayerName layer;
  std::uint32_t tiles = 0;
  std::array<std::uint8_t, 16> revisions{};  ///< of the layer's revision vector
};

/// lifeline/agent_status, once a second
struct AgentStatus {
  Envelope envelope;
  std::string agent_id;
  Role role = Role::helmet;
  AgentState state = AgentState::starting;
  SensorHealth lidar = SensorHealth::good;
  SensorHealth attitude = SensorHealth::good;
  std::uint8_t battery_percent = 255;  ///< 255 = unknown
  bool duplicate_id_heard = false;
  std::uint32_t map_id = 0;
  std::int16_t floor = 0;
  std::uint64_t scans = 0;
  std::uint64_t scans_dropped = 0;
  std::uint64_t failures = 0;  ///< scans that no matcher could place
  std::uint64_t samples_refused = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t bytes_queued = 0;
  std::uint32_t tiles_behind = 0;
  RecordingState recording = RecordingState::off;
  std::uint64_t samples_unrecorded = 0;  ///< what the recording lacks
  float explored_m2 = 0.0F;
  float slam_ms_median = 0.0F;
  std::uint64_t epoch_applied = 0;
  std::array<std::uint8_t, 16> fingerprint{};        ///< of epoch and revision vector
  std::array<std::uint8_t, 32> common_map_sha256{};  ///< all zero: none, or not up to date
  std::vector<LayerDigest> layers;
  std::vector<std::string> peers_heard;
  /// What a clock of each of them would show now, had its newest status taken no time to come here,
  /// in their order; empty where nobody says. Milliseconds, modulo 2^32: a peer finds by it how
  /// long its samples are on their way, and these back.
  std::vector<std::uint32_t> peers_echo_ms;
};

enum class DetectionKind : std::uint8_t { victim = 0, human = 1, uwb_tag = 2 };
enum class DetectionState : std::uint8_t {
  reported = 0,
  confirmed = 1,
  dismissed = 2,
  rescued = 3
};

/// lifeline/detection: all that one helmet knows of one find, as of its newest sighting.
struct Detection {
  Envelope envelope;
  std::string agent_id;
  std::uint32_t detection_id = 0;  ///< never the same again, not even in the helmet's next map
  std::uint32_t revision = 0;      ///< grows with each sample of the detection
  std::uint32_t map_id = 0;
  std::int16_t floor = 0;
  DetectionKind kind = DetectionKind::victim;
  DetectionState state = DetectionState::reported;
  double x_m = 0.0;  ///< in the map frame of (agent_id, map_id, floor)
  double y_m = 0.0;
  float confidence = 0.0F;            ///< that it is there at all, 0 to 1
  std::int64_t first_seen_at_ns = 0;  ///< the helmet's own clock, as seen_at_ns
  std::int64_t seen_at_ns = 0;        ///< the newest sighting
};

enum class AlertKind : std::uint8_t { mayday = 0, evacuate = 1, roll_call = 2 };
enum class AlertState : std::uint8_t { raised = 0, acknowledged = 1, cleared = 2 };

/// lifeline/alert
struct Alert {
  Envelope envelope;
  std::string issuer_id;
  std::uint32_t alert_id = 0;
  AlertKind kind = AlertKind::mayday;
  AlertState state = AlertState::raised;
  std::string subject_id;  ///< whom it concerns; empty = everybody
  std::string text;
  std::vector<std::string> acknowledged_by;
};

}  // namespace lifeline::wire
