#include "common/dds/bounds.hpp"
#include "common/dds/convert.hpp"
#include "common/dds/convert_parts.hpp"

namespace lifeline::dds {
namespace {

// Both kinds of tile. The key must be flat (a nested key struct is serialised whole), hence no
// LayerName in the IDL.
template <typename WireTile, typename IdlTile>
Result<void> tile_to_idl(const WireTile& message, IdlTile& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.agent_id(parts::to_name(message.layer.agent_id));
  out.map_id(message.layer.map_id);
  out.floor(message.layer.floor);
  out.tile_x(message.tile_x);
  out.tile_y(message.tile_y);
  out.part(message.part);
  out.parts(message.parts);
  out.revision(message.revision);
  out.payload(message.payload);
  return {};
}

template <typename IdlTile>
wire::TsdTile tile_from_idl(const IdlTile& sample) {
  return {.envelope = parts::from_idl(sample.envelope()),
          .layer = {sample.agent_id().to_string(), sample.map_id(), sample.floor()},
          .tile_x = sample.tile_x(),
          .tile_y = sample.tile_y(),
          .part = sample.part(),
          .parts = sample.parts(),
          .revision = sample.revision(),
          .payload = sample.payload()};
}

}  // namespace

Result<void> to_idl(const wire::HelmetPose& message, msg::HelmetPose& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.agent_id(parts::to_name(message.agent_id));
  out.map_id(message.map_id);
  out.floor(message.floor);
  parts::to_idl(message.T_map_head, out.T_map_head());
  out.speed_m_s(message.speed_m_s);
  out.trust_percent(message.trust_percent);
  return {};
}

wire::HelmetPose from_idl(const msg::HelmetPose& sample) {
  return {.envelope = parts::from_idl(sample.envelope()),
          .agent_id = sample.agent_id().to_string(),
          .map_id = sample.map_id(),
          .floor = sample.floor(),
          .T_map_head = parts::from_idl(sample.T_map_head()),
          .speed_m_s = sample.speed_m_s(),
          .trust_percent = sample.trust_percent()};
}

Result<void> to_idl(const wire::HelmetScan& message, msg::HelmetScan& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.agent_id(parts::to_name(message.agent_id));
  out.map_id(message.map_id);
  out.floor(message.floor);
  parts::to_idl(message.T_map_head, out.T_map_head());
  out.first_angle_rad(message.first_angle_rad);
  out.angle_step_rad(message.angle_step_rad);
  out.ranges_cm(message.ranges_cm);
  return {};
}

wire::HelmetScan from_idl(const msg::HelmetScan& sample) {
  return {.envelope = parts::from_idl(sample.envelope()),
          .agent_id = sample.agent_id().to_string(),
          .map_id = sample.map_id(),
          .floor = sample.floor(),
          .T_map_head = parts::from_idl(sample.T_map_head()),
          .first_angle_rad = sample.first_angle_rad(),
          .angle_step_rad = sample.angle_step_rad(),
          .ranges_cm = sample.ranges_cm()};
}

Result<void> to_idl(const wire::TsdTile& message, msg::TsdTile& out) {
  return tile_to_idl(message, out);
}

Result<void> to_idl(const wire::TileCopy& message, msg::TileCopy& out) {
  return tile_to_idl(message, out);
}

wire::TsdTile from_idl(const msg::TsdTile& sample) {
  return tile_from_idl(sample);
}

wire::TileCopy from_idl(const msg::TileCopy& sample) {
  return {tile_from_idl(sample)};
}

Result<void> to_idl(const wire::TileRequest& message, msg::TileRequest& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.requester_id(parts::to_name(message.requester_id));
  out.asked_id(parts::to_name(message.asked_id));
  parts::to_idl(message.layer, out.layer());
  out.after_x(message.after_x);
  out.after_y(message.after_y);
  out.to_x(message.to_x);
  out.to_y(message.to_y);
  out.held().resize(message.held.size());
  for (std::size_t i = 0; i < message.held.size(); ++i) {
    out.held()[i].x(message.held[i].x);
    out.held()[i].y(message.held[i].y);
    out.held()[i].revision_held(message.held[i].revision_held);
  }
  return {};
}

wire::TileRequest from_idl(const msg::TileRequest& sample) {
  wire::TileRequest message{.envelope = parts::from_idl(sample.envelope()),
                            .requester_id = sample.requester_id().to_string(),
                            .asked_id = sample.asked_id().to_string(),
                            .layer = parts::from_idl(sample.layer()),
                            .after_x = sample.after_x(),
                            .after_y = sample.after_y(),
                            .to_x = sample.to_x(),
                            .to_y = sample.to_y(),
                            .held = {}};
  message.held.reserve(sample.held().size());
  for (const auto& tile : sample.held()) {
    message.held.push_back({tile.x(), tile.y(), tile.revision_held()});
  }
  return message;
}

}  // namespace lifeline::dds
