#include "coordinator/dashboard/observer.hpp"

#include <algorithm>

namespace lifeline::dashboard {
namespace {

constexpr Duration kTilesInterval = std::chrono::milliseconds(100);
constexpr Duration kLayersInterval = std::chrono::milliseconds(500);
constexpr Duration kPosesInterval = std::chrono::milliseconds(100);
constexpr Duration kListsInterval = std::chrono::milliseconds(200);
constexpr Duration kFleetInterval = std::chrono::milliseconds(500);
constexpr Duration kTrailsInterval = std::chrono::seconds(2);

std::shared_ptr<const sharing::FusedTile> widen(const QuantisedTile& cells) {
  auto wide = std::make_shared<sharing::FusedTile>();
  std::transform(cells.begin(), cells.end(), wide->begin(), [](QuantisedCell cell) {
    return sharing::FusedCell{cell.tsd, cell.weight};
  });
  return wide;
}

bool is_due(SteadyTime& due, SteadyTime now, Duration interval) {
  if (now < due) return false;
  due = now + interval;
  return true;
}

}  // namespace

Observer::Observer(Coordinator& coordinator, Feed& feed)
    : coordinator_(coordinator), feed_(feed), search_(coordinator) {
  coordinator_.set_map_listener([this](TileIndex tile) {
    changed_.insert(tile);
    search_.mark(tile);
  });
}

// A coordinator goes on without a page, whose address may be taken.
Observer::~Observer() {
  coordinator_.set_map_listener({});
}

void Observer::step(SteadyTime now) {
  if (is_due(tiles_due_, now, kTilesInterval)) put_tiles(now);
  if (is_due(layers_due_, now, kLayersInterval)) put_layers();
  number_helmets();
  if (feed_.is_watched()) {
    if (!was_watched_) poses_due_ = fleet_due_ = lists_due_ = trails_due_ = now;
    put_sections(now);
  }
  if (search_.step(now, feed_.is_watched())) put_if_new(Section::search, search_.frame());
  was_watched_ = feed_.is_watched();
  feed_.flush();
}

void Observer::refresh() {
  tiles_due_ = layers_due_ = poses_due_ = fleet_due_ = lists_due_ = trails_due_ = {};
  search_.refresh();
}

void Observer::take_back() {
  for (const auto& [tile, cells] : coordinator_.common_map().tiles()) changed_.insert(tile);
  for (const TileIndex tile : changed_) feed_.put(TileChange{"", tile, nullptr});
  for (const auto& [layer, tiles] : put_) {
    for (const auto& [tile, cells] : tiles) feed_.put(TileChange{to_string(layer), tile, nullptr});
  }
}

void Observer::put_tiles(SteadyTime now) {
  const auto& tiles = coordinator_.common_map().tiles();
  for (const TileIndex tile : changed_) {
    const auto held = tiles.find(tile);
    feed_.put(TileChange{
        "", tile,
        held == tiles.end() ? nullptr : std::make_shared<const sharing::FusedTile>(held->second)});
  }
  if (!changed_.empty()) {
    is_hash_old_ = true;
    observed_.common_map_changed_at = now;
  }
  changed_.clear();
}

void Observer::put_layers() {
  for (const auto& [layer, tiles] : coordinator_.store().layers()) {
    auto& put = put_[layer];
    for (const auto& [tile, held] : tiles) {
      auto& before = put[tile];
      if (before == held.cells) continue;
      before = held.cells;
      search_.note(layer, tile, *held.cells);
      feed_.put(TileChange{to_string(layer), tile, widen(*held.cells)});
    }
  }
}

void Observer::number_helmets() {
  for (const auto& [id, entry] : coordinator_.roster().entries()) {
    if (entry.status.role == wire::Role::helmet)
      observed_.numbers.try_emplace(id, static_cast<std::uint32_t>(observed_.numbers.size() + 1));
  }
}

void Observer::put_sections(SteadyTime now) {
  put_if_new(Section::alerts, alerts_frame(coordinator_));
  if (is_due(poses_due_, now, kPosesInterval))
    put_if_new(Section::poses, poses_frame(coordinator_, now));
  if (is_due(lists_due_, now, kListsInterval)) {
    put_if_new(Section::finds, finds_frame(coordinator_));
    put_if_new(Section::merges, merges_frame(coordinator_));
  }
  if (is_due(fleet_due_, now, kFleetInterval)) {
    if (is_hash_old_ && changed_.empty()) {
      const auto hash = coordinator_.common_map().sha256();
      observed_.common_map_sha256 = coordinator_.common_map().tiles().empty()
                                        ? std::string()
                                        : std::string(hash.begin(), hash.end());
      is_hash_old_ = false;
    }
    put_if_new(Section::fleet, fleet_frame(coordinator_, observed_, now));
  }
  if (is_due(trails_due_, now, kTrailsInterval))
    put_if_new(Section::trails, trails_frame(coordinator_));
}

void Observer::put_if_new(Section section, std::string frame) {
  std::string& last = last_[static_cast<std::size_t>(section)];
  if (frame == last) return;
  last = frame;
  feed_.put(section, std::move(frame));
}

}  // namespace lifeline::dashboard
