#include "common/store/tile_records.hpp"

#include <charconv>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/base/printable.hpp"
#include "common/sharing/accept.hpp"
#include "common/store/packed_cells.hpp"
#include "common/wire/limits.hpp"
#include "common/wire/tile_codec.hpp"
#include "idl/state.pb.h"

namespace lifeline::store {
namespace {

constexpr std::string_view kTiles = "tile/";

/// Splits off what stands before the next slash; all of it where there is none.
std::string_view take_word(std::string_view& text) {
  const std::size_t slash = text.find('/');
  const std::string_view word = text.substr(0, slash);
  text.remove_prefix(slash == std::string_view::npos ? text.size() : slash + 1);
  return word;
}

template <typename Integer>
std::optional<Integer> take_integer(std::string_view& text) {
  const std::string_view word = take_word(text);
  Integer value{};
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || rest != word.data() + word.size()) return std::nullopt;
  return value;
}

struct TileName {
  LayerKey layer;
  TileIndex tile;
};

std::optional<TileName> parse_published_key(std::string_view key) {
  key.remove_prefix(kTiles.size());
  auto agent = AgentId::parse(take_word(key));
  const auto map = take_integer<std::uint32_t>(key);
  const auto floor = take_integer<std::int16_t>(key);
  const auto x = take_integer<std::int32_t>(key), y = take_integer<std::int32_t>(key);
  if (!agent || !map || !floor || !x || !y || !key.empty()) return std::nullopt;
  if (!is_in_range(TileIndex{*x, *y})) return std::nullopt;
  return TileName{{*std::move(agent), MapId{*map}, Floor{*floor}}, {*x, *y}};
}

std::optional<sharing::KeptTile> parse_tile(const std::string& value,
                                            const GridGeometry& geometry) {
  proto::PublishedTile message;
  if (!message.ParseFromString(value) || message.revision() == 0) return std::nullopt;
  sharing::KeptTile kept{
      {message.revision()}, {message.payload().begin(), message.payload().end()}, {}};
  std::optional<QuantisedTile> cells;
  if (!kept.payload.empty()) {
    if (auto decoded = wire::decode_tile(kept.payload, geometry)) cells = *decoded;
  } else {
    cells = unpack_published_cells(message.cells());
  }
  if (!cells) return std::nullopt;
  kept.cells = std::make_shared<const QuantisedTile>(*cells);
  return kept;
}

}  // namespace

std::string tile_key(std::string_view prefix, TileIndex tile) {
  return fmt::format("{}/{}/{}", prefix, tile.x, tile.y);
}

std::optional<TileIndex> tile_of_key(std::string_view key, std::string_view prefix) {
  if (!key.starts_with(prefix) || key.size() <= prefix.size() || key[prefix.size()] != '/') {
    return std::nullopt;
  }
  key.remove_prefix(prefix.size() + 1);
  const auto x = take_integer<std::int32_t>(key), y = take_integer<std::int32_t>(key);
  if (!x || !y || !key.empty() || !is_in_range(TileIndex{*x, *y})) return std::nullopt;
  return TileIndex{*x, *y};
}

std::string published_key(const LayerKey& layer, TileIndex tile) {
  return tile_key(fmt::format("{}{}/{}/{}", kTiles, layer.agent_id.text(), layer.map_id.value,
                              layer.floor.value),
                  tile);
}

std::string own_tile_record(Revision revision, const std::vector<std::uint8_t>& payload) {
  proto::PublishedTile message;
  message.set_revision(revision.value);
  message.set_payload(payload.data(), payload.size());
  return message.SerializeAsString();
}

std::string peer_tile_record(Revision revision, const QuantisedTile& cells) {
  proto::PublishedTile message;
  message.set_revision(revision.value);
  message.set_cells(pack_cells(cells));
  return message.SerializeAsString();
}

Result<sharing::KeptLayers> read_tiles(const Records& records, const GridGeometry& geometry) {
  sharing::KeptLayers layers;
  for (auto record = records.lower_bound(std::string(kTiles)); record != records.end(); ++record) {
    if (!record->first.starts_with(kTiles)) break;
    auto name = parse_published_key(record->first);
    auto tile = name ? parse_tile(record->second, geometry) : std::nullopt;
    if (!tile)
      return fail(ErrorCode::bad_data, "record {} holds no tile", printable(record->first));
    layers[name->layer].emplace(name->tile, *std::move(tile));
  }
  return layers;
}

std::string directive_record(const wire::MergeDirective& directive) {
  proto::KeptDirective message;
  message.set_epoch(directive.epoch);
  message.set_own_weight_permille(directive.own_weight_permille);
  for (const wire::DirectiveMember& member : directive.members) {
    auto& kept = *message.add_members();
    kept.set_agent_id(member.layer.agent_id);
    kept.set_map_id(member.layer.map_id);
    kept.set_floor(member.layer.floor);
    kept.set_group(member.group);
    kept.set_cos_q30(member.T_common_map.cos_q30);
    kept.set_sin_q30(member.T_common_map.sin_q30);
    kept.set_x_um(member.T_common_map.x_um);
    kept.set_y_um(member.T_common_map.y_um);
    for (const double value : member.covariance) kept.add_covariance(value);
    kept.set_quality(member.quality);
  }
  return message.SerializeAsString();
}

Result<std::optional<wire::MergeDirective>> read_directive(const Records& records,
                                                           const std::string& mission_id) {
  const auto record = records.find(kDirectiveKey);
  if (record == records.end()) return std::optional<wire::MergeDirective>();
  proto::KeptDirective message;
  constexpr std::uint32_t kMost16 = std::numeric_limits<std::uint16_t>::max();
  if (!message.ParseFromString(record->second) || message.own_weight_permille() > kMost16) {
    return fail(ErrorCode::bad_data, "record directive holds none");
  }
  wire::MergeDirective directive;
  directive.mission_id = mission_id;
  directive.epoch = message.epoch();
  directive.own_weight_permille = static_cast<std::uint16_t>(message.own_weight_permille());
  for (const proto::KeptMember& kept : message.members()) {
    wire::DirectiveMember member;
    if (kept.group() > kMost16 || kept.covariance_size() != 6) {
      return fail(ErrorCode::bad_data, "record directive holds a member that is none");
    }
    member.layer = {kept.agent_id(), kept.map_id(), static_cast<std::int16_t>(kept.floor())};
    member.group = static_cast<std::uint16_t>(kept.group());
    member.T_common_map = {kept.cos_q30(), kept.sin_q30(), kept.x_um(), kept.y_um()};
    for (int i = 0; i < 6; ++i) member.covariance[static_cast<std::size_t>(i)] = kept.covariance(i);
    member.quality = kept.quality();
    directive.members.push_back(std::move(member));
  }
  if (auto sound = sharing::check_directive(directive); !sound) return forward_error(sound);
  return std::optional(std::move(directive));
}

}  // namespace lifeline::store
