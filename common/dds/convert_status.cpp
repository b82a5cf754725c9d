#include "common/dds/bounds.hpp"
#include "common/dds/convert.hpp"
#include "common/dds/convert_parts.hpp"

namespace lifeline::dds {
namespace {

static_assert(static_cast<int>(wire::Role::coordinator) == msg::ROLE_COORDINATOR);
static_assert(static_cast<int>(wire::AgentState::starting) == msg::STATE_STARTING);
static_assert(static_cast<int>(wire::AgentState::finished) == msg::STATE_FINISHED);
static_assert(static_cast<int>(wire::SensorHealth::good) == msg::HEALTH_GOOD);
static_assert(static_cast<int>(wire::SensorHealth::failed) == msg::HEALTH_FAILED);
static_assert(static_cast<int>(wire::RecordingState::failing) == msg::RECORDING_FAILING);
static_assert(static_cast<int>(wire::DetectionKind::uwb_tag) == msg::DETECTION_UWB_TAG);
static_assert(static_cast<int>(wire::DetectionState::rescued) == msg::DETECTION_RESCUED);
static_assert(static_cast<int>(wire::AlertKind::roll_call) == msg::ALERT_ROLL_CALL);
static_assert(static_cast<int>(wire::AlertState::cleared) == msg::ALERT_CLEARED);

void identity_to_idl(const wire::AgentStatus& in, msg::AgentStatus& out) {
  out.agent_id(parts::to_name(in.agent_id));
  out.role(parts::to_idl_enum<msg::Role>(in.role));
  out.state(parts::to_idl_enum<msg::AgentState>(in.state));
  out.lidar(parts::to_idl_enum<msg::SensorHealth>(in.lidar));
  out.attitude(parts::to_idl_enum<msg::SensorHealth>(in.attitude));
  out.battery_percent(in.battery_percent);
  out.duplicate_id_heard(in.duplicate_id_heard);
  out.map_id(in.map_id);
  out.floor(in.floor);
}

void layers_to_idl(const wire::AgentStatus& in, msg::AgentStatus& out) {
  out.layers().resize(in.layers.size());
  for (std::size_t i = 0; i < in.layers.size(); ++i) {
    parts::to_idl(in.layers[i].layer, out.layers()[i].layer());
    out.layers()[i].tiles(in.layers[i].tiles);
    out.layers()[i].revisions(in.layers[i].revisions);
  }
}

}  // namespace

Result<void> to_idl(const wire::AgentStatus& message, msg::AgentStatus& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  identity_to_idl(message, out);
  out.scans(message.scans);
  out.scans_dropped(message.scans_dropped);
  out.failures(message.failures);
  out.samples_refused(message.samples_refused);
  out.bytes_sent(message.bytes_sent);
  out.bytes_queued(message.bytes_queued);
  out.tiles_behind(message.tiles_behind);
  out.recording(parts::to_idl_enum<msg::RecordingState>(message.recording));
  out.samples_unrecorded(message.samples_unrecorded);
  out.explored_m2(message.explored_m2);
  out.slam_ms_median(message.slam_ms_median);
  out.epoch_applied(message.epoch_applied);
  out.fingerprint(message.fingerprint);
  out.common_map_sha256(message.common_map_sha256);
  layers_to_idl(message, out);
  parts::to_idl(message.peers_heard, out.peers_heard());
  out.peers_echo_ms(message.peers_echo_ms);
  return {};
}

wire::AgentStatus from_idl(const msg::AgentStatus& sample) {
  wire::AgentStatus message{
      .envelope = parts::from_idl(sample.envelope()),
      .agent_id = sample.agent_id().to_string(),
      .role = parts::to_wire_enum<wire::Role>(sample.role()),
      .state = parts::to_wire_enum<wire::AgentState>(sample.state()),
      .lidar = parts::to_wire_enum<wire::SensorHealth>(sample.lidar()),
      .attitude = parts::to_wire_enum<wire::SensorHealth>(sample.attitude()),
      .battery_percent = sample.battery_percent(),
      .duplicate_id_heard = sample.duplicate_id_heard(),
      .map_id = sample.map_id(),
      .floor = sample.floor(),
      .scans = sample.scans(),
      .scans_dropped = sample.scans_dropped(),
      .failures = sample.failures(),
      .samples_refused = sample.samples_refused(),
      .bytes_sent = sample.bytes_sent(),
      .bytes_queued = sample.bytes_queued(),
      .tiles_behind = sample.tiles_behind(),
      .recording = parts::to_wire_enum<wire::RecordingState>(sample.recording()),
      .samples_unrecorded = sample.samples_unrecorded(),
      .explored_m2 = sample.explored_m2(),
      .slam_ms_median = sample.slam_ms_median(),
      .epoch_applied = sample.epoch_applied(),
      .fingerprint = sample.fingerprint(),
      .common_map_sha256 = sample.common_map_sha256(),
      .layers = {},
      .peers_heard = parts::from_idl(sample.peers_heard()),
      .peers_echo_ms = sample.peers_echo_ms()};
  message.layers.reserve(sample.layers().size());
  for (const auto& digest : sample.layers()) {
    message.layers.push_back({parts::from_idl(digest.layer()), digest.tiles(), digest.revisions()});
  }
  return message;
}

Result<void> to_idl(const wire::Detection& message, msg::Detection& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.agent_id(parts::to_name(message.agent_id));
  out.detection_id(message.detection_id);
  out.revision(message.revision);
  out.map_id(message.map_id);
  out.floor(message.floor);
  out.kind(parts::to_idl_enum<msg::DetectionKind>(message.kind));
  out.state(parts::to_idl_enum<msg::DetectionState>(message.state));
  out.x_m(message.x_m);
  out.y_m(message.y_m);
  out.confidence(message.confidence);
  out.first_seen_at_ns(message.first_seen_at_ns);
  out.seen_at_ns(message.seen_at_ns);
  return {};
}

wire::Detection from_idl(const msg::Detection& sample) {
  return {.envelope = parts::from_idl(sample.envelope()),
          .agent_id = sample.agent_id().to_string(),
          .detection_id = sample.detection_id(),
          .revision = sample.revision(),
          .map_id = sample.map_id(),
          .floor = sample.floor(),
          .kind = parts::to_wire_enum<wire::DetectionKind>(sample.kind()),
          .state = parts::to_wire_enum<wire::DetectionState>(sample.state()),
          .x_m = sample.x_m(),
          .y_m = sample.y_m(),
          .confidence = sample.confidence(),
          .first_seen_at_ns = sample.first_seen_at_ns(),
          .seen_at_ns = sample.seen_at_ns()};
}

Result<void> to_idl(const wire::Alert& message, msg::Alert& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.issuer_id(parts::to_name(message.issuer_id));
  out.alert_id(message.alert_id);
  out.kind(parts::to_idl_enum<msg::AlertKind>(message.kind));
  out.state(parts::to_idl_enum<msg::AlertState>(message.state));
  out.subject_id(parts::to_name(message.subject_id));
  out.text(message.text);
  parts::to_idl(message.acknowledged_by, out.acknowledged_by());
  return {};
}

wire::Alert from_idl(const msg::Alert& sample) {
  return {.envelope = parts::from_idl(sample.envelope()),
          .issuer_id = sample.issuer_id().to_string(),
          .alert_id = sample.alert_id(),
          .kind = parts::to_wire_enum<wire::AlertKind>(sample.kind()),
          .state = parts::to_wire_enum<wire::AlertState>(sample.state()),
          .subject_id = sample.subject_id().to_string(),
          .text = sample.text().to_string(),
          .acknowledged_by = parts::from_idl(sample.acknowledged_by())};
}

}  // namespace lifeline::dds
