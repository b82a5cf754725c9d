#include "agents/sharing/tile_publisher.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"
#include "common/wire/tile_codec.hpp"
#include "common/wire/tile_parts.hpp"

namespace lifeline::sharing {

TilePublisher::TilePublisher(TilePublisherConfig config, LayerKey layer, Speaker speaker,
                             wire::Outbox<wire::TsdTile>& outbox)
    : config_(config),
      layer_(std::move(layer)),
      stamper_(std::move(speaker)),
      outbox_(outbox),
      allowance_bits_(config.budget_bit_s) {}

void TilePublisher::put(const MapTiles& tiles) {
  for (const auto& [tile, cells] : tiles) waiting_[tile] = cells;
}

Result<void> TilePublisher::step(SteadyTime now, Timestamp wall_now, ReplicaStore& store) {
  refill(now);
  for (const Due& next : due(now)) {
    if (allowance_bits_ <= 0.0) break;
    if (auto sent = publish(next.tile, now, wall_now, store); !sent) return sent;
  }
  return {};
}

// A token bucket one second deep: it may go into debt by one sample, and then waits.
void TilePublisher::refill(SteadyTime now) {
  if (refilled_at_ != SteadyTime{}) {
    const double gained = to_seconds(now - refilled_at_) * config_.budget_bit_s;
    allowance_bits_ = std::min<double>(allowance_bits_ + gained, config_.budget_bit_s);
  }
  refilled_at_ = now;
}

std::vector<TilePublisher::Due> TilePublisher::due(SteadyTime now) {
  std::vector<Due> due;
  for (auto waiting = waiting_.begin(); waiting != waiting_.end();) {
    const auto last = published_.find(waiting->first);
    const bool too_soon =
        last != published_.end() && now - last->second.at < config_.min_tile_interval;
    const std::size_t changed = too_soon ? 1 : changed_cells(waiting->first, *waiting->second);
    if (changed == 0) {
      waiting = waiting_.erase(waiting);
      continue;
    }
    if (!too_soon) due.push_back({waiting->first, changed});
    ++waiting;
  }
  std::stable_sort(due.begin(), due.end(), [&](const Due& a, const Due& b) {
    const bool new_a = !published_.contains(a.tile), new_b = !published_.contains(b.tile);
    return new_a != new_b ? new_a : a.changed_cells > b.changed_cells;
  });
  return due;
}

std::size_t TilePublisher::changed_cells(TileIndex tile, const QuantisedTile& cells) const {
  static const QuantisedTile kUnknown{};
  const auto last = published_.find(tile);
  const QuantisedTile& before = last == published_.end() ? kUnknown : *last->second.cells;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) changed += cells[i] == before[i] ? 0 : 1;
  return changed;
}

Result<void> TilePublisher::publish(TileIndex tile, SteadyTime now, Timestamp wall_now,
                                    ReplicaStore& store) {
  const auto cells = waiting_.at(tile);
  Revision& revision = newest_revisions_[tile];
  ++revision.value;
  if (auto sent = send(tile, revision, wall_now, wire::encode_tile(*cells, store.geometry()));
      !sent) {
    return sent;
  }
  // Held only once it left: what nobody else can get must not be in our own common map either.
  store.put_own(layer_, tile, revision, cells);
  published_[tile] = {now, cells};
  waiting_.erase(tile);
  return {};
}

Result<void> TilePublisher::send(TileIndex tile, Revision revision, Timestamp wall_now,
                                 const std::vector<std::uint8_t>& payload) {
  wire::TsdTile sample;
  sample.layer = to_layer_name(layer_);
  sample.tile_x = tile.x;
  sample.tile_y = tile.y;
  sample.revision = revision.value;
  const auto parts = wire::split_payload(payload);
  sample.parts = static_cast<std::uint8_t>(parts.size());
  for (std::uint8_t part = 0; part < sample.parts; ++part) {
    sample.envelope = stamper_.next(wall_now);
    sample.part = part;
    sample.payload = parts[part];
    allowance_bits_ -= 8.0 * static_cast<double>(sample.payload.size());
    if (auto sent = outbox_.put(sample); !sent) return sent;
  }
  return {};
}

}  // namespace lifeline::sharing
