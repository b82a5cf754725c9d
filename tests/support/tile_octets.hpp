#pragma once

#include <cstddef>
#include <string>

#include "common/wire/messages.hpp"

namespace lifeline::test {

/// Octets of a tile's sample as XCDR1 writes it (idl/map.idl), its encapsulation included: what DDS
/// is given to send.
[[nodiscard]] inline std::size_t tile_octets(const wire::TsdTile& sample) {
  std::size_t at = 0;
  const auto number = [&at](std::size_t size) { at = (at + size - 1) / size * size + size; };
  const auto octets = [&](std::size_t count) {
    number(4);  // how many follow
    at += count;
  };
  const wire::Envelope& envelope = sample.envelope;
  number(2);  // protocol_version
  octets(envelope.mission_id.size() + 1);
  octets(envelope.sender_id.size() + 1);
  for (int i = 0; i < 3; ++i) number(8);  // incarnation, sequence_number, sent_at_ns
  octets(envelope.signature.size());
  octets(sample.layer.agent_id.size() + 1);
  number(4);                              // map_id
  number(2);                              // floor
  for (int i = 0; i < 2; ++i) number(4);  // tile_x, tile_y
  for (int i = 0; i < 2; ++i) number(1);  // part, parts
  number(8);                              // revision
  octets(sample.payload.size());
  constexpr std::size_t kEncapsulation = 4;
  return kEncapsulation + at;
}

}  // namespace lifeline::test
