#include "tests/bench/paper/team.hpp"

#include <algorithm>
#include <utility>

#include "common/sharing/fixed_transform.hpp"

namespace lifeline::bench {
namespace {

constexpr std::size_t kScansPerExchange = 10;

LayerKey layer_of(const char* id) {
  return {AgentId::parse(id).value(), MapId{1}, Floor{0}};
}

}  // namespace

Team::Team(Method method)
    : method_(method),
      helmets_{make_helmet(method), make_helmet(method)},
      layers_{layer_of("first"), layer_of("second")},
      store_(GridGeometry{}),
      peers_{sharing::FusedMap(GridGeometry{}), sharing::FusedMap(GridGeometry{})} {}

void Team::play(const PaperWalk& walk, const std::function<void(double)>& seen) {
  const std::size_t scans = std::min(walk.scans[0].size(), walk.scans[1].size());
  for (std::size_t k = 0; k < scans; ++k) {
    for (std::size_t i = 0; i < helmets_.size(); ++i) {
      helmets_[i]->step(as_seen_by(method_, walk.scans[i][k]));
    }
    if (own_weight_ < 1.0 && k % kScansPerExchange == 0) exchange();
    seen(to_seconds(walk.scans[0][k].stamp - walk.scans[0].front().stamp));
  }
  for (auto& helmet : helmets_) helmet->finish();
}

void Team::merge(const Pose2& T_map1_map2, double w_T1) {
  own_weight_ = w_T1;
  peers_[0].place({{layers_[1], sharing::to_fixed(T_map1_map2)}}, store_);
  peers_[1].place({{layers_[0], sharing::to_fixed(T_map1_map2.inverse())}}, store_);
}

void Team::publish() {
  for (std::size_t i = 0; i < helmets_.size(); ++i) {
    for (auto& [tile, cells] : helmets_[i]->take_changed_tiles()) {
      store_.put_own(layers_[i], tile, Revision{++revision_}, std::move(cells));
    }
  }
}

void Team::exchange() {
  publish();
  for (const auto& changed : store_.take_changed()) {
    for (auto& peers : peers_) peers.mark(changed);
  }
  for (std::size_t i = 0; i < helmets_.size(); ++i) {
    sharing::PeerUpdate update;
    update.own_weight = own_weight_;
    for (const TileIndex tile : peers_[i].update(store_)) {
      const auto cells = peers_[i].tiles().find(tile);
      update.tiles.emplace_back(
          tile, cells == peers_[i].tiles().end()
                    ? nullptr
                    : std::make_shared<const TsdTile>(sharing::to_tsd_tile(cells->second)));
    }
    helmets_[i]->apply(update);
  }
}

TsdGrid Team::merged(const Pose2& T_map1_map2) {
  publish();
  for (const auto& changed : store_.take_changed()) {
    for (auto& peers : peers_) peers.mark(changed);
  }
  sharing::FusedMap both{GridGeometry{}};
  both.place(
      {{layers_[0], sharing::to_fixed(Pose2{})}, {layers_[1], sharing::to_fixed(T_map1_map2)}},
      store_);
  both.update(store_);
  return both.to_grid();
}

}  // namespace lifeline::bench
