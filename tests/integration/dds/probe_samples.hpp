#pragma once

// What lifeline-dds-probe publishes, and what its readers may expect of it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"

namespace lifeline::probe {

/// A payload that depends on all that names the tile.
inline std::vector<std::uint8_t> payload(std::uint32_t tile, std::uint64_t revision,
                                         std::size_t size) {
  std::vector<std::uint8_t> octets(size);
  auto state = static_cast<std::uint32_t>(tile * 2654435761U + revision * 40503U + size);
  for (auto& octet : octets) {
    state = state * 1664525U + 1013904223U;
    octet = static_cast<std::uint8_t>(state >> 24U);
  }
  return octets;
}

constexpr std::int32_t kTilesPerRow = 50;

/// What `tile` should hold.
inline std::vector<std::uint8_t> payload(const wire::TsdTile& tile) {
  const auto index = static_cast<std::uint32_t>(tile.tile_y * kTilesPerRow + tile.tile_x);
  return payload(index, tile.revision, tile.payload.size());
}

inline wire::TsdTile tile(const std::string& sender, std::uint32_t index, std::uint64_t revision,
                          std::size_t size) {
  wire::TsdTile tile;
  tile.envelope.mission_id = "probe";
  tile.envelope.sender_id = sender;
  tile.envelope.sequence = revision;
  tile.layer = {sender, 7, -2};
  tile.tile_x = static_cast<std::int32_t>(index) % kTilesPerRow;
  tile.tile_y = static_cast<std::int32_t>(index) / kTilesPerRow;
  tile.part = 1;
  tile.parts = 3;
  tile.revision = revision;
  tile.payload = payload(index, revision, size);
  return tile;
}

inline wire::MergeDirective directive(const std::string& sender, std::uint64_t epoch) {
  wire::MergeDirective directive;
  directive.envelope.mission_id = "probe";
  directive.envelope.sender_id = sender;
  directive.envelope.sequence = epoch;
  directive.mission_id = "probe";
  directive.epoch = epoch;
  directive.own_weight_permille = 625;
  directive.members = {{.layer = {"alpha", 1, 0},
                        .group = 0,
                        .T_common_map = {},
                        .covariance = {1e-4, 0, 0, 1e-4, 0, 1e-6},
                        .quality = 1.0F},
                       {.layer = {"bravo", 3, -1},
                        .group = 0,
                        .T_common_map = {.cos_q30 = 929887697,
                                         .sin_q30 = -536870912,
                                         .x_um = -12345678901,
                                         .y_um = 2500000},
                        .covariance = {0.5, -0.25, 0.125, 2.0, -0.0625, 0.03125},
                        .quality = 0.75F}};
  return directive;
}

}  // namespace lifeline::probe
