#include "agents/storage/helmet_keeper.hpp"

#include <algorithm>
#include <utility>

#include "common/store/packed_cells.hpp"
#include "common/store/tile_records.hpp"
#include "idl/state.pb.h"

namespace lifeline {
namespace {

constexpr Duration kLayerInterval = std::chrono::seconds(1);
constexpr Duration kPlaceInterval = std::chrono::milliseconds(200);

std::string place_record(const sharing::HelmetState& state) {
  proto::HelmetPlace place;
  place.set_written_at_ns(SystemClock().wall_now().time_since_epoch().count());
  place.set_x_m(state.T_map_head.x_m);
  place.set_y_m(state.T_map_head.y_m);
  place.set_yaw_rad(state.T_map_head.yaw_rad);
  place.set_trust_percent(state.trust_percent);
  return place.SerializeAsString();
}

std::string piece_record(const std::vector<StampedPose>& poses) {
  proto::PathPiece piece;
  for (const StampedPose& stamped : poses) {
    piece.add_stamp_ns(stamped.stamp.time_since_epoch().count());
    piece.add_pose(stamped.pose.x_m);
    piece.add_pose(stamped.pose.y_m);
    piece.add_pose(stamped.pose.yaw_rad);
  }
  return piece.SerializeAsString();
}

store::RecordStore::Content content(std::string text) {
  return [text = std::move(text)] { return std::optional(text); };
}

proto::HelmetProgress progress_of(const LayerKey& layer) {
  proto::HelmetProgress progress;
  progress.set_map_id(layer.map_id.value);
  progress.set_floor(layer.floor.value);
  return progress;
}

}  // namespace

HelmetKeeper::HelmetKeeper(store::RecordStore& records, LayerKey layer)
    : records_(records), layer_(std::move(layer)) {}

void HelmetKeeper::begin_map(const store::Records& old) {
  Batch batch;
  for (const auto& [key, value] : old) {
    if (key.starts_with(kPathPrefix) || store::tile_of_key(key, kLayerPrefix)) {
      batch[key] = [] { return std::nullopt; };
    }
  }
  batch[kPlaceKey] = [] { return std::nullopt; };
  batch[kProgressKey] = content(progress_of(layer_).SerializeAsString());
  records_.put(std::move(batch));
}

void HelmetKeeper::go_on(const HelmetMemory& memory) {
  const auto own = memory.sharing.layers.find(layer_);
  if (own != memory.sharing.layers.end()) {
    for (const auto& [tile, kept] : own->second) kept_revisions_[tile] = kept.revision.value;
  }
  if (!memory.mapper) return;
  const auto& path = memory.mapper->trajectory;
  earlier_ = path.size() - path.size() % kPosesPerPiece;
  piece_.assign(path.begin() + static_cast<std::ptrdiff_t>(earlier_), path.end());
}

void HelmetKeeper::keep(const HelmetMapper& mapper, const sharing::HelmetState& state) {
  {
    std::lock_guard lock(mutex_);
    for (const TileIndex tile : mapper.changed_tiles()) {
      unkept_[tile] = std::make_shared<const TsdTile>(*mapper.layer().find(tile));
    }
  }
  const SteadyTime now = std::chrono::steady_clock::now();
  if (now >= place_due_) {
    place_due_ = now + kPlaceInterval;
    records_.put(kPlaceKey, place_record(state));
  }
  const bool finished = state.state == wire::AgentState::finished;
  if (now < layer_due_ && !finished) return;
  layer_due_ = now + kLayerInterval;
  Batch batch;
  add_path(mapper, batch);
  add_progress(mapper, state, batch);
  // Under the lock until all is handed over: a tile that is published now must not overtake it.
  std::lock_guard lock(mutex_);
  for (auto& [tile, cells] : unkept_) add_layer_tile(tile, std::move(cells), batch);
  unkept_.clear();
  records_.put(std::move(batch));
}

void HelmetKeeper::add_layer_tile(TileIndex tile, Cells cells, Batch& batch) {
  batch[store::tile_key(kLayerPrefix, tile)] = [cells = std::move(cells)] {
    proto::LayerTile message;
    message.set_cells(store::pack_cells(*cells));
    return std::optional(message.SerializeAsString());
  };
}

void HelmetKeeper::add_path(const HelmetMapper& mapper, Batch& batch) {
  for (const StampedPose& pose : mapper.trajectory_from(seen_)) {
    ++seen_;
    piece_.push_back(pose);
    if (piece_.size() < kPosesPerPiece) continue;
    add_piece(batch);
    earlier_ += piece_.size();
    piece_.clear();
  }
  if (!piece_.empty()) add_piece(batch);
}

void HelmetKeeper::add_piece(Batch& batch) const {
  batch[kPathPrefix + std::to_string(earlier_ / kPosesPerPiece)] = content(piece_record(piece_));
}

void HelmetKeeper::add_progress(const HelmetMapper& mapper, const sharing::HelmetState& state,
                                Batch& batch) {
  proto::HelmetProgress progress = progress_of(layer_);
  progress.set_mapped(mapper.layer().tile_count() > 0);
  progress.set_scans(state.scans);
  progress.set_scans_dropped(state.scans_dropped);
  progress.set_failures(state.failures);
  progress.set_lost_scans(mapper.lost_scans());
  progress.set_relocalisations(mapper.relocalisations());
  progress.set_poses(earlier_ + piece_.size());
  batch[kProgressKey] = content(progress.SerializeAsString());
}

std::optional<store::RecordStore::Ticket> HelmetKeeper::keep(const wire::TsdTile& sample) {
  const TileIndex tile{sample.tile_x, sample.tile_y};
  std::uint64_t& kept = kept_revisions_[tile];
  if (sample.revision == kept) return 0;  // said again
  auto whole = parts_[tile].add(sample);
  if (!whole || !*whole) return std::nullopt;
  kept = sample.revision;
  parts_.erase(tile);
  Batch batch;
  const std::string record = store::own_tile_record(Revision{sample.revision}, **whole);
  batch[store::published_key(layer_, tile)] = content(record);
  // In one commit with what it shows: the layer on disk is never older than what others have of it.
  std::lock_guard lock(mutex_);
  if (auto newer = unkept_.extract(tile)) add_layer_tile(tile, std::move(newer.mapped()), batch);
  return records_.put(std::move(batch));
}

void HelmetKeeper::keep(const LayerKey& layer, TileIndex tile, const sharing::ReplicaTile& held) {
  records_.put(store::published_key(layer, tile), [held] {
    return std::optional(store::peer_tile_record(held.revision, *held.cells));
  });
}

void HelmetKeeper::keep(const wire::MergeDirective& directive) {
  records_.put(store::kDirectiveKey, store::directive_record(directive));
}

}  // namespace lifeline
