#include "agents/storage/helmet_storage.hpp"

#include <utility>

#include "common/base/log.hpp"

namespace lifeline {
namespace {

/// A state that can be opened, but not be made sense of, is no better than a damaged one.
Result<std::optional<store::OpenState>> open_sound_state(const std::filesystem::path& folder,
                                                         const store::StateIdentity& identity,
                                                         Floor floor,
                                                         const store::ResumeLimits& limits,
                                                         const Clock& clock, HelmetMemory& memory) {
  auto opened = store::open_state(folder, identity, limits, clock.wall_now());
  if (!opened || !*opened) return opened;
  auto read = read_helmet_memory((*opened)->records,
                                 {(*opened)->start_number, (*opened)->opened_at}, identity, floor);
  if (read) {
    memory = *std::move(read);
    return opened;
  }
  return store::begin_anew(*std::move(*opened), folder, identity, read.error().text,
                           clock.wall_now());
}

}  // namespace

Result<std::unique_ptr<HelmetStorage>> HelmetStorage::open(
    const std::filesystem::path& folder, const store::StateIdentity& identity, Floor floor,
    const store::ResumeLimits& limits, const Clock& clock,
    const store::RecordStoreConfig& records) {
  HelmetMemory memory;
  auto opened = open_sound_state(folder, identity, floor, limits, clock, memory);
  if (!opened) return forward_error(opened);
  if (!*opened) return nullptr;
  const auto file = (*opened)->file.path().string();
  if (memory.map) {
    spdlog::info("{}: goes on in map {} with {} tiles, written {:.1f} s ago", file,
                 memory.map->value, memory.mapper ? memory.mapper->layer.tile_count() : 0,
                 to_seconds((*opened)->away));
  } else {
    spdlog::info("{}: keeps this helmet's state", file);
  }
  return std::unique_ptr<HelmetStorage>(
      new HelmetStorage(*std::move(*opened), std::move(memory), clock, records));
}

HelmetStorage::HelmetStorage(store::OpenState opened, HelmetMemory memory, const Clock& clock,
                             const store::RecordStoreConfig& records)
    : clock_(clock),
      old_(opened.records),
      memory_(std::move(memory)),
      records_(std::make_unique<store::RecordStore>(std::move(opened.file), records)),
      beat_(*records_, old_, clock.steady_now()) {}

void HelmetStorage::begin(const LayerKey& layer) {
  keeper_ = std::make_unique<HelmetKeeper>(*records_, layer);
  if (memory_.map == layer.map_id) {
    keeper_->go_on(memory_);
  } else {
    keeper_->begin_map(old_);
  }
  old_.clear();
}

void HelmetStorage::attach(sharing::HelmetChannels& channels) {
  auto tiles = std::make_unique<store::WriteAheadOutbox<wire::TsdTile>>(
      std::move(channels.tile), *records_,
      [this](const wire::TsdTile& sample) { return keeper_->keep(sample); });
  tiles_ = tiles.get();
  channels.tile = std::move(tiles);
  // A tile that is sent again may have been published just now.
  auto copies = std::make_unique<store::WriteAheadOutbox<wire::TileCopy>>(
      std::move(channels.exchange.send), *records_, [this](const wire::TileCopy& copy) {
        return keeper_->holds(copy.layer) ? records_->newest() : store::RecordStore::Ticket{0};
      });
  copies_ = copies.get();
  channels.exchange.send = std::move(copies);
}

Result<void> HelmetStorage::attach(sharing::HelmetSharing& helmet) {
  if (auto resumed = helmet.resume(memory_.sharing); !resumed) return resumed;
  kept_epoch_ = helmet.map().epoch().value;
  alerts_.begin(helmet.alerts().own());
  memory_.sharing = {};
  helmet.set_tile_listener(
      [this](const LayerKey& layer, TileIndex tile, const sharing::ReplicaTile& held) {
        keeper_->keep(layer, tile, held);
      });
  return {};
}

HelmetThreads::Keep HelmetStorage::keep() {
  return [this](const HelmetMapper& mapper, const sharing::HelmetState& state) {
    keeper_->keep(mapper, state);
  };
}

void HelmetStorage::step(const sharing::HelmetSharing& helmet) {
  tiles_->pump();
  copies_->pump();
  if (const auto& directive = helmet.map().directive(); directive.epoch != kept_epoch_) {
    kept_epoch_ = directive.epoch;
    keeper_->keep(directive);
  }
  alerts_.keep(helmet.alerts().own(), *records_);
  beat_.step(clock_.steady_now(), clock_.wall_now());
}

HelmetStorage::~HelmetStorage() {
  beat_.finish(clock_.wall_now());
}

}  // namespace lifeline
