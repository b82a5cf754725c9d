#include "common/files/map_file.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include "common/files/atomic_file.hpp"
#include "common/files/read_file.hpp"
#include "common/wire/tile_codec.hpp"
#include "idl/map_file.pb.h"

namespace lifeline::files {
namespace {

constexpr std::uint32_t kFormatVersion = 1;
constexpr std::size_t kMaxOctets = std::size_t{256} << 20;
constexpr std::size_t kMaxTiles = 32'768;     // 335,000 m2 at 0.05 m; half a gibibyte in memory
constexpr std::size_t kMaxPoses = 4'000'000;  // four days at 10 Hz

/// Counts tiles and poses without taking memory for them: an empty one takes two octets of a file
/// and a hundred in memory.
Result<void> check_counts(const std::string& name, const std::string& content) {
  using google::protobuf::internal::WireFormatLite;
  google::protobuf::io::CodedInputStream stream(
      reinterpret_cast<const std::uint8_t*>(content.data()), static_cast<int>(content.size()));
  std::size_t tiles = 0, poses = 0;
  while (const std::uint32_t tag = stream.ReadTag()) {
    const int field = WireFormatLite::GetTagFieldNumber(tag);
    tiles += field == proto::MapFile::kTilesFieldNumber ? 1 : 0;
    poses += field == proto::MapFile::kTrajectoryFieldNumber ? 1 : 0;
    if (!WireFormatLite::SkipField(&stream, tag)) break;
  }
  if (!stream.ConsumedEntireMessage()) {
    return fail(ErrorCode::bad_data, "{}: not a whole map file; copy it again", name);
  }
  if (tiles > kMaxTiles || poses > kMaxPoses) {
    return fail(ErrorCode::unsupported, "{}: {} tiles and {} poses, at most {} and {} are read",
                name, tiles, poses, kMaxTiles, kMaxPoses);
  }
  return {};
}

Result<LayerKey> read_layer(const proto::MapFile& message) {
  const auto agent = AgentId::parse(message.agent_id());
  if (!agent) return forward_error(agent);
  if (message.floor() < std::numeric_limits<std::int16_t>::min() ||
      message.floor() > std::numeric_limits<std::int16_t>::max()) {
    return fail(ErrorCode::bad_data, "floor {} does not exist", message.floor());
  }
  return LayerKey{*agent, {message.map_id()}, {static_cast<std::int16_t>(message.floor())}};
}

Result<GridGeometry> read_geometry(const proto::MapFile& message) {
  constexpr std::uint32_t kSmallest_um = 1'000, kLargest_um = 10'000'000;
  for (const std::uint32_t length_um : {message.cell_size_um(), message.truncation_um()}) {
    if (length_um < kSmallest_um || length_um > kLargest_um) {
      return fail(ErrorCode::bad_data, "cells of {} um with a truncation of {} um make no map",
                  message.cell_size_um(), message.truncation_um());
    }
  }
  return GridGeometry{message.cell_size_um() / 1e6, message.truncation_um() / 1e6};
}

Result<void> read_tile(const proto::MapTile& tile, TsdGrid& grid) {
  const TileIndex index{tile.x(), tile.y()};
  if (!is_in_range(index)) {
    return fail(ErrorCode::bad_data, "tile ({}, {}) lies outside of any map", tile.x(), tile.y());
  }
  if (grid.find(index) != nullptr) {
    return fail(ErrorCode::bad_data, "tile ({}, {}) stands twice", tile.x(), tile.y());
  }
  const std::string& payload = tile.payload();
  const auto cells = wire::decode_tile(
      {reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size()}, grid.geometry());
  if (!cells) return forward_error(cells);
  grid.at(index) = dequantise(*cells);
  return {};
}

Result<StampedPose> read_pose(const proto::MapPose& message) {
  constexpr double kFarthest_m = 1e6;
  const Pose2 pose{message.x_m(), message.y_m(), message.yaw_rad()};
  if (!pose.is_finite() || pose.translation().cwiseAbs().maxCoeff() > kFarthest_m) {
    return fail(ErrorCode::bad_data, "a pose of the trajectory is not finite or far off");
  }
  return StampedPose{Timestamp(Duration(message.stamp_ns())),
                     {pose.x_m, pose.y_m, normalise_angle(pose.yaw_rad)}};
}

Result<SavedMap> from_message(const proto::MapFile& message) {
  if (message.format_version() != kFormatVersion) {
    return fail(ErrorCode::unsupported, "map file of version {}, this program reads {}",
                message.format_version(), kFormatVersion);
  }
  if (!message.has_tile_count() || !message.has_pose_count() ||
      message.tile_count() != static_cast<std::uint32_t>(message.tiles_size()) ||
      message.pose_count() != static_cast<std::uint32_t>(message.trajectory_size())) {
    return fail(ErrorCode::bad_data, "not a whole map file; copy it again");
  }
  const auto layer = read_layer(message);
  if (!layer) return forward_error(layer);
  const auto geometry = read_geometry(message);
  if (!geometry) return forward_error(geometry);
  SavedMap map{*layer, TsdGrid(*geometry), {}};
  for (const auto& tile : message.tiles()) {
    if (const auto read = read_tile(tile, map.grid); !read) return forward_error(read);
  }
  map.trajectory.reserve(static_cast<std::size_t>(message.trajectory_size()));
  for (const auto& stamped : message.trajectory()) {
    const auto pose = read_pose(stamped);
    if (!pose) return forward_error(pose);
    map.trajectory.push_back(*pose);
  }
  return map;
}

}  // namespace

Result<void> save_map(const std::filesystem::path& file, const LayerKey& layer, const TsdGrid& grid,
                      std::span<const StampedPose> trajectory) {
  proto::MapFile message;
  message.set_format_version(kFormatVersion);
  message.set_agent_id(layer.agent_id.text());
  message.set_map_id(layer.map_id.value);
  message.set_floor(layer.floor.value);
  message.set_cell_size_um(wire::to_micrometres(grid.geometry().cell_size_m));
  message.set_truncation_um(wire::to_micrometres(grid.geometry().truncation_m));
  message.set_tile_count(static_cast<std::uint32_t>(grid.tile_count()));
  message.set_pose_count(static_cast<std::uint32_t>(trajectory.size()));
  for (const TileIndex index : grid.tiles()) {
    const auto payload = wire::encode_tile(quantise(*grid.find(index)), grid.geometry());
    proto::MapTile& tile = *message.add_tiles();
    tile.set_x(index.x);
    tile.set_y(index.y);
    tile.set_payload(payload.data(), payload.size());
  }
  for (const auto& [stamp, pose] : trajectory) {
    proto::MapPose& stamped = *message.add_trajectory();
    stamped.set_stamp_ns(stamp.time_since_epoch().count());
    stamped.set_x_m(pose.x_m);
    stamped.set_y_m(pose.y_m);
    stamped.set_yaw_rad(pose.yaw_rad);
  }
  return write_file_atomically(file, message.SerializeAsString());
}

Result<SavedMap> load_map(const std::filesystem::path& file) {
  const auto content = read_file(file, kMaxOctets);
  if (!content) return forward_error(content);
  if (const auto counted = check_counts(file.string(), *content); !counted) {
    return forward_error(counted);
  }
  proto::MapFile message;
  if (!message.ParseFromString(*content)) {
    return fail(ErrorCode::bad_data, "{}: not a whole map file; copy it again", file.string());
  }
  auto map = from_message(message);
  if (!map) return fail(map.error().code, "{}: {}", file.string(), map.error().text);
  return map;
}

}  // namespace lifeline::files
