#include "coordinator/storage/coordinator_storage.hpp"

#include <utility>

#include "common/base/log.hpp"
#include "common/store/tile_records.hpp"
#include "coordinator/storage/merge_records.hpp"

namespace lifeline {
namespace {

constexpr Duration kMergesInterval = std::chrono::milliseconds(500);

Result<CoordinatorMemory> read_memory(const store::Records& records,
                                      const store::StateIdentity& identity) {
  auto layers = store::read_tiles(records, identity.geometry);
  if (!layers) return forward_error(layers);
  auto directive = store::read_directive(records, identity.mission_id);
  if (!directive) return forward_error(directive);
  auto merges = read_merges(records);
  if (!merges) return forward_error(merges);
  auto alerts = store::read_alerts(records, identity.id);
  if (!alerts) return forward_error(alerts);
  return CoordinatorMemory{*std::move(layers), *std::move(directive), std::move(merges->edges),
                           std::move(merges->apart), *std::move(alerts)};
}

}  // namespace

Result<std::unique_ptr<CoordinatorStorage>> CoordinatorStorage::open(
    const std::filesystem::path& folder, const store::StateIdentity& identity,
    const store::ResumeLimits& limits, const Clock& clock) {
  auto opened = store::open_state(folder, identity, limits, clock.wall_now());
  if (!opened) return forward_error(opened);
  if (!*opened) return nullptr;
  auto memory = read_memory((*opened)->records, identity);
  if (!memory) {
    // What can be opened, but not be made sense of, is no better than damaged.
    opened = store::begin_anew(*std::move(*opened), folder, identity, memory.error().text,
                               clock.wall_now());
    if (!opened) return forward_error(opened);
    if (!*opened) return nullptr;
    memory = CoordinatorMemory{};
  }
  const auto file = (*opened)->file.path().string();
  if (memory->directive || !memory->layers.empty()) {
    spdlog::info("{}: goes on from directive {} and {} layers, written {:.1f} s ago", file,
                 memory->directive ? memory->directive->epoch : 0, memory->layers.size(),
                 to_seconds((*opened)->away));
  } else {
    spdlog::info("{}: keeps this coordinator's state", file);
  }
  return std::unique_ptr<CoordinatorStorage>(
      new CoordinatorStorage(*std::move(*opened), *std::move(memory), clock));
}

CoordinatorStorage::CoordinatorStorage(store::OpenState opened, CoordinatorMemory memory,
                                       const Clock& clock)
    : clock_(clock),
      memory_(std::move(memory)),
      records_(std::make_unique<store::RecordStore>(std::move(opened.file))),
      beat_(*records_, opened.records, clock.steady_now()) {}

CoordinatorStorage::~CoordinatorStorage() {
  beat_.finish(clock_.wall_now());
}

void CoordinatorStorage::attach(CoordinatorChannels& channels) {
  channels.open_directive = [this, open = std::move(channels.open_directive)]()
      -> Result<std::unique_ptr<wire::Outbox<wire::MergeDirective>>> {
    auto inner = open();
    if (!inner) return inner;
    auto outbox = std::make_unique<DirectiveOutbox>(
        *std::move(inner), *records_,
        [this](const wire::MergeDirective& directive) -> store::RecordStore::Ticket {
          if (directive.epoch == kept_epoch_) return 0;  // said again
          kept_epoch_ = directive.epoch;
          return records_->put(store::kDirectiveKey, store::directive_record(directive));
        });
    directives_ = outbox.get();
    return outbox;
  };
}

Result<void> CoordinatorStorage::attach(Coordinator& coordinator) {
  if (auto resumed = coordinator.resume(memory_); !resumed) return resumed;
  kept_epoch_ = coordinator.directive().epoch;
  kept_merges_ = merges_record(coordinator.merges(), coordinator.parted_by_hand());
  alerts_.begin(coordinator.own_alerts());
  memory_ = {};
  coordinator.set_tile_listener(
      [this](const LayerKey& layer, TileIndex tile, const sharing::ReplicaTile& held) {
        records_->put(store::published_key(layer, tile), [held] {
          return std::optional(store::peer_tile_record(held.revision, *held.cells));
        });
      });
  return {};
}

void CoordinatorStorage::step(const Coordinator& coordinator) {
  if (coordinator.leads()) directives_->pump();
  if (const auto& directive = coordinator.directive();
      !coordinator.leads() && directive.epoch != kept_epoch_) {
    kept_epoch_ = directive.epoch;  // of another coordinator
    records_->put(store::kDirectiveKey, store::directive_record(directive));
  }
  const SteadyTime now = clock_.steady_now();
  if (now >= merges_due_) {
    merges_due_ = now + kMergesInterval;
    keep_merges(merges_record(coordinator.merges(), coordinator.parted_by_hand()));
  }
  alerts_.keep(coordinator.own_alerts(), *records_);
  beat_.step(now, clock_.wall_now());
}

void CoordinatorStorage::keep_merges(std::string merges) {
  if (merges == kept_merges_) return;
  kept_merges_ = merges;
  records_->put(kMergesKey, std::move(merges));
}

}  // namespace lifeline
