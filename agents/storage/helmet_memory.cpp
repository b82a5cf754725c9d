#include "agents/storage/helmet_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "common/store/alert_records.hpp"
#include "common/store/packed_cells.hpp"
#include "common/store/tile_records.hpp"
#include "idl/state.pb.h"

namespace lifeline {
namespace {

constexpr std::size_t kMostTiles = 32'768;
constexpr std::size_t kMostPoses = 4'000'000;
// Longer ago, where the helmet was says little of where it is.
constexpr Duration kMoments = std::chrono::seconds(30);

/// Tiles beside each other or not: a dense grid has to hold all of them.
constexpr std::int64_t kMostDirectory = 4'000'000;

tl::unexpected<Error> broken(const std::string& what) {
  return fail(ErrorCode::bad_data, "record {} does not hold what it should", what);
}

bool spans_too_far(const std::vector<TileIndex>& tiles) {
  if (tiles.empty()) return false;
  const auto [left, right] =
      std::minmax_element(tiles.begin(), tiles.end(), [](auto a, auto b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(tiles.begin(), tiles.end(), [](auto a, auto b) { return a.y < b.y; });
  return (std::int64_t{right->x} - left->x + 1) * (std::int64_t{high->y} - low->y + 1) >
         kMostDirectory;
}

Result<TsdGrid> read_layer(const store::Records& records, const GridGeometry& geometry,
                           const sharing::KeptTiles& published) {
  std::vector<TileIndex> tiles;
  const std::string prefix = std::string(kLayerPrefix) + "/";
  const auto first = records.lower_bound(prefix);
  for (auto record = first; record != records.end() && record->first.starts_with(prefix);
       ++record) {
    const auto tile = store::tile_of_key(record->first, kLayerPrefix);
    if (!tile || tiles.size() == kMostTiles) return broken(record->first);
    tiles.push_back(*tile);
  }
  for (const auto& [tile, kept] : published) tiles.push_back(tile);
  if (spans_too_far(tiles)) return broken(prefix);
  TsdGrid grid(geometry);
  for (const auto& [tile, kept] : published) grid.at(tile) = dequantise(*kept.cells);
  for (auto record = first; record != records.end() && record->first.starts_with(prefix);
       ++record) {
    proto::LayerTile message;
    const bool parsed = message.ParseFromString(record->second);
    const auto cells = parsed ? store::unpack_layer_cells(message.cells()) : std::nullopt;
    if (!cells) return broken(record->first);
    grid.at(*store::tile_of_key(record->first, kLayerPrefix)) = *cells;
  }
  return grid;
}

Result<std::vector<StampedPose>> read_path(const store::Records& records, std::uint64_t count) {
  std::vector<StampedPose> path;
  if (count > kMostPoses) return broken(kProgressKey);
  for (std::uint64_t piece = 0; path.size() < count; ++piece) {
    const std::string key = kPathPrefix + std::to_string(piece);
    const auto record = records.find(key);
    proto::PathPiece message;
    if (record == records.end() || !message.ParseFromString(record->second) ||
        message.stamp_ns_size() == 0 || message.pose_size() != 3 * message.stamp_ns_size()) {
      return broken(key);
    }
    for (int i = 0; i < message.stamp_ns_size() && path.size() < count; ++i) {
      const Pose2 pose{message.pose(3 * i), message.pose(3 * i + 1), message.pose(3 * i + 2)};
      if (!pose.is_finite()) return broken(key);
      path.push_back({Timestamp(Duration(message.stamp_ns(i))), pose});
    }
  }
  return path;
}

sharing::HelmetState counters_of(const proto::HelmetProgress& progress) {
  sharing::HelmetState state;
  state.state = wire::AgentState::lost;
  state.scans = progress.scans();
  state.scans_dropped = progress.scans_dropped();
  state.failures = progress.failures();
  return state;
}

/// Where the helmet was; trusted, and for so long, only if it knew and clocks tell.
Result<void> read_place(const store::Records& records, Timestamp now, MapperMemory& memory) {
  const auto record = records.find(kPlaceKey);
  if (record == records.end()) return {};
  proto::HelmetPlace place;
  if (!place.ParseFromString(record->second)) return broken(kPlaceKey);
  const Pose2 T_map_head{place.x_m(), place.y_m(), place.yaw_rad()};
  if (!T_map_head.is_finite()) return broken(kPlaceKey);
  memory.state.T_map_head = T_map_head;
  const Duration ago = now - Timestamp(Duration(place.written_at_ns()));
  if (place.trust_percent() > 0 && ago > Duration{} && ago < kMoments)
    memory.last = slam::LastPlace{T_map_head, ago};
  return {};
}

Result<MapperMemory> read_mapper(const store::Records& records, const StartedAt& start,
                                 const proto::HelmetProgress& progress,
                                 const store::StateIdentity& identity,
                                 const sharing::KeptTiles& published) {
  MapperMemory memory;
  memory.state = counters_of(progress);
  if (auto read = read_place(records, start.opened_at, memory); !read) return forward_error(read);
  auto layer = read_layer(records, identity.geometry, published);
  if (!layer) return forward_error(layer);
  auto path = read_path(records, progress.poses());
  if (!path) return forward_error(path);
  memory.layer = *std::move(layer);
  memory.trajectory = *std::move(path);
  memory.lost_scans = progress.lost_scans();
  memory.relocalisations = progress.relocalisations();
  return memory;
}

}  // namespace

Result<HelmetMemory> read_helmet_memory(const store::Records& records, const StartedAt& start,
                                        const store::StateIdentity& identity, Floor floor) {
  HelmetMemory memory;
  const auto record = records.find(kProgressKey);
  if (record == records.end()) return memory;
  proto::HelmetProgress progress;
  if (!progress.ParseFromString(record->second)) return broken(kProgressKey);
  memory.last_map = progress.map_id();
  auto layers = store::read_tiles(records, identity.geometry);
  if (!layers) return forward_error(layers);
  auto directive = store::read_directive(records, identity.mission_id);
  if (!directive) return forward_error(directive);
  auto alerts = store::read_alerts(records, identity.id);
  if (!alerts) return forward_error(alerts);
  memory.sharing = {*std::move(layers), *std::move(directive),
                    Revision{(start.start_number - 1) * kRevisionsPerStart},
                    static_cast<std::uint8_t>(start.start_number - 1), *std::move(alerts)};
  if (progress.floor() != floor.value) return memory;
  auto id = AgentId::parse(identity.id);
  if (!id) return forward_error(id);
  memory.map = MapId{progress.map_id()};
  if (!progress.mapped()) return memory;
  const LayerKey own{*std::move(id), *memory.map, floor};
  auto mapper = read_mapper(records, start, progress, identity, memory.sharing.layers[own]);
  if (!mapper) return forward_error(mapper);
  memory.mapper = *std::move(mapper);
  return memory;
}

}  // namespace lifeline
