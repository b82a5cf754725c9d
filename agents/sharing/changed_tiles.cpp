#include "agents/sharing/changed_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "common/wire/coarse_cells.hpp"

namespace lifeline::sharing {
namespace {

/// Two distances further apart than this contradict each other: free here, behind a wall there.
constexpr int kContradiction = QuantisedCell::kTsdOne * 3 / 4;

/// How much of a cell is wrong at whoever holds `before`: all of it, where one of both does not
/// know it; four times as much, where both contradict each other, since a door that closed is a few
/// cells; a quarter, where a wall's place is in doubt by less than a cell. What else differs makes
/// no other map.
double wrong(QuantisedCell now, QuantisedCell before) {
  if ((now.weight == 0) != (before.weight == 0)) return 1.0;
  if (std::abs(now.tsd - before.tsd) > kContradiction) return 4.0;
  return (now.tsd > 0) != (before.tsd > 0) ? 0.25 : 0.0;
}

}  // namespace

HoldBackConfig for_budget(HoldBackConfig config, double budget_bit_s) {
  constexpr double kMadeFor_bit_s = 256'000;
  constexpr Duration kShortestInterval = std::chrono::milliseconds(50);
  const double share = std::min(1.0, kMadeFor_bit_s / budget_bit_s);
  config.min_interval =
      std::min(config.min_interval,
               std::max(kShortestInterval, from_seconds(share * to_seconds(config.min_interval))));
  // Where so much goes through, waiting for a better sample saves nothing that anybody lacks.
  constexpr double kHoldsNothingBelow = 0.02;
  const double waits = share < kHoldsNothingBelow ? 0.0 : share;
  config.new_m2_s *= waits;
  config.changed_m2_s *= waits;
  config.least_m2 *= share;
  return config;
}

void ChangedTiles::put(const MapTiles& tiles, SteadyTime scanned_at) {
  for (const auto& [tile, cells] : tiles) {
    Tile& changed = tiles_[tile];
    if (!changed.newest && !goes(changed)) ++waiting_;
    if (!changed.newest) changed.put_scanned_at = scanned_at;
    changed.newest = cells;
  }
  came_in_ = came_in_ || !tiles.empty();
}

void ChangedTiles::set_sent(TileIndex tile, std::shared_ptr<const QuantisedTile> cells,
                            SteadyTime at) {
  Tile& sent = tiles_[tile];
  sent.sent = std::move(cells);
  sent.sent_at = at;
  ++sent.revisions;
  sent.next.reset();
  sent.differs_m2 = sent.lacking_m2_s = 0.0;
}

std::vector<ChangedTiles::Due> ChangedTiles::due(SteadyTime now, double cell_m2) {
  if (std::exchange(came_in_, false)) last_came_in_ = now;
  const bool quiet = finished_ || now - last_came_in_ >= config_.quiet_after;
  std::vector<std::pair<TileIndex, const Tile*>> found;
  waiting_ = 0;
  for (auto& [index, tile] : tiles_) {
    if (!tile.newest && !tile.next) continue;
    weigh(tile, now, cell_m2);
    if (tile.newest || goes(tile)) ++waiting_;
    if (is_due(tile, now, quiet)) found.emplace_back(index, &tile);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    const bool new_a = !a.second->sent, new_b = !b.second->sent;
    return new_a != new_b ? new_a : a.second->differs_m2 > b.second->differs_m2;
  });
  std::vector<Due> due;
  for (const auto& [index, tile] : found) due.push_back({index, tile->next, tile->lacks_scan_of});
  return due;
}

/// Adds up what others lacked until now; then takes in what is new, at most as often as it could be
/// sent: comparing costs half a millisecond.
void ChangedTiles::weigh(Tile& tile, SteadyTime now, double cell_m2) const {
  const bool went = goes(tile);
  if (went) {
    const double counts_m2 = tile.differs_m2 - (tile.sent ? config_.least_m2 : 0.0);
    tile.lacking_m2_s += counts_m2 * to_seconds(now - tile.weighed_at);
  }
  tile.weighed_at = now;
  if (!tile.newest || now - tile.compared_at < interval()) return;
  tile.compared_at = now;
  compare(tile, cell_m2);
  if (!goes(tile)) tile.lacking_m2_s = 0.0;
  if (went) return;
  tile.differs_since = now;
  tile.lacks_scan_of = tile.put_scanned_at;
}

void ChangedTiles::compare(Tile& tile, double cell_m2) const {
  static const QuantisedTile kUnknown{};
  const auto newest = std::exchange(tile.newest, nullptr);
  const QuantisedTile& before = tile.sent ? *tile.sent : kUnknown;
  tile.next = coarse_
                  ? std::make_shared<const QuantisedTile>(wire::coarse(*newest, tile.sent.get()))
                  : newest;
  double cells = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    cells += wrong((*tile.next)[i], before[i]);
  }
  tile.differs_m2 = cells * cell_m2;
  if (*tile.next == before) tile.next.reset();
}

Duration ChangedTiles::interval() const {
  return std::max(config_.min_interval, least_interval_);
}

bool ChangedTiles::goes(const Tile& tile) const {
  return tile.next && (!tile.sent || tile.differs_m2 >= config_.least_m2);
}

/// Who walks about in one room for an hour makes less and less news of it.
double ChangedTiles::enough_m2_s(const Tile& tile) const {
  if (!tile.sent) return config_.new_m2_s;
  constexpr int kMostDoublings = 2;
  return std::ldexp(config_.changed_m2_s, std::clamp(tile.revisions - 1, 0, kMostDoublings));
}

bool ChangedTiles::is_due(const Tile& tile, SteadyTime now, bool quiet) const {
  if (!goes(tile) || (tile.sent && now - tile.sent_at < interval())) return false;
  return quiet || tile.lacking_m2_s >= enough_m2_s(tile) ||
         now - tile.differs_since >= config_.longest;
}

}  // namespace lifeline::sharing
