#pragma once

// What several messages have in common; for convert_*.cpp only.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "common/wire/messages.hpp"
#include "dds/envelope.h"

namespace lifeline::dds::parts {

inline msg::Name to_name(const std::string& text) {
  return msg::Name(text.c_str());
}

inline void to_idl(const wire::Envelope& in, msg::Envelope& out) {
  out.protocol_version(in.protocol_version);
  out.mission_id(to_name(in.mission_id));
  out.sender_id(to_name(in.sender_id));
  out.incarnation(in.incarnation);
  out.sequence_number(in.sequence);
  out.sent_at_ns(in.sent_at_ns);
  out.signature(in.signature);
}

inline wire::Envelope from_idl(const msg::Envelope& in) {
  return {.protocol_version = in.protocol_version(),
          .mission_id = in.mission_id().to_string(),
          .sender_id = in.sender_id().to_string(),
          .incarnation = in.incarnation(),
          .sequence = in.sequence_number(),
          .sent_at_ns = in.sent_at_ns(),
          .signature = in.signature()};
}

inline void to_idl(const wire::LayerName& in, msg::LayerName& out) {
  out.agent_id(to_name(in.agent_id));
  out.map_id(in.map_id);
  out.floor(in.floor);
}

inline wire::LayerName from_idl(const msg::LayerName& in) {
  return {in.agent_id().to_string(), in.map_id(), in.floor()};
}

inline void to_idl(const Pose2& in, msg::Pose& out) {
  out.x_m(in.x_m);
  out.y_m(in.y_m);
  out.yaw_rad(in.yaw_rad);
}

inline Pose2 from_idl(const msg::Pose& in) {
  return {in.x_m(), in.y_m(), in.yaw_rad()};
}

/// The generated enumerations are 32 bits wide and hold whatever came in.
template <typename WireEnum, typename IdlEnum>
WireEnum to_wire_enum(IdlEnum value) {
  const auto number = static_cast<std::uint32_t>(value);
  return static_cast<WireEnum>(static_cast<std::uint8_t>(std::min<std::uint32_t>(number, 255)));
}

template <typename IdlEnum, typename WireEnum>
IdlEnum to_idl_enum(WireEnum value) {
  return static_cast<IdlEnum>(static_cast<std::underlying_type_t<WireEnum>>(value));
}

inline void to_idl(const std::vector<std::string>& in, std::vector<msg::AgentName>& out) {
  out.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) out[i].id(to_name(in[i]));
}

inline std::vector<std::string> from_idl(const std::vector<msg::AgentName>& in) {
  std::vector<std::string> out;
  out.reserve(in.size());
  for (const auto& name : in) out.push_back(name.id().to_string());
  return out;
}

}  // namespace lifeline::dds::parts
