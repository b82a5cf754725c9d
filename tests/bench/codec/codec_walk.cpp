#include "tests/bench/codec/codec_walk.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "agents/helmet_mapper.hpp"
#include "agents/sharing/tile_publisher.hpp"
#include "agents/sources/open_source.hpp"
#include "common/base/check.hpp"
#include "common/wire/coarse_cells.hpp"
#include "common/wire/limits.hpp"
#include "common/wire/tile_codec.hpp"
#include "coordinator/matching/stop_watch.hpp"
#include "tests/bench/codec/rivals.hpp"
#include "tests/support/tile_octets.hpp"

namespace lifeline::bench {
namespace {

constexpr Duration kHandOver = std::chrono::milliseconds(100);
constexpr double kAmple_bit_s = 1e12;

/// Counts what leaves.
class Ledger final : public wire::Outbox<wire::TsdTile> {
 public:
  Result<void> put(const wire::TsdTile& sample) override {
    const std::size_t octets = test::tile_octets(sample);
    cost.all_octets += static_cast<double>(octets);
    cost.on_air_octets += static_cast<double>(octets + wire::kOctetsAboutASample);
    if (sample.part == 0) {
      ++cost.revisions;
      about_octets_ = octets - sample.payload.size();
    }
    return {};
  }
  [[nodiscard]] bool has_reader() const override { return true; }
  /// Of a sample of this walk, without its payload.
  [[nodiscard]] double about_octets() const { return static_cast<double>(about_octets_); }

  SharingCost cost;

 private:
  std::size_t about_octets_ = 0;
};

std::size_t known_cells(const QuantisedTile& tile) {
  return static_cast<std::size_t>(
      std::count_if(tile.begin(), tile.end(), [](QuantisedCell cell) { return cell.weight != 0; }));
}

/// One helmet's sharing of its tiles, by its publisher alone.
class SharedWalk {
 public:
  SharedWalk(const sharing::TilePublisherConfig& config, const GridGeometry& geometry, bool rivals)
      : compare_(rivals),
        store_(geometry),
        link_(kAmple_bit_s, [] { return std::uint64_t{0}; }),
        publisher_(config, layer(), {layer().agent_id, "mission", Incarnation{1}}, ledger_) {}

  void put(const sharing::MapTiles& tiles) {
    for (const auto& [tile, cells] : tiles) own_cells_[tile] = known_cells(*cells);
    publisher_.put(tiles);
  }

  void step(SteadyTime now) {
    link_.measure(now, [] { return sharing::Audience{1}; });
    LIFELINE_CHECK(publisher_.step(now, Timestamp{}, store_, link_));
    for (const auto& changed : store_.take_changed()) note(changed.tile);
    double lacking = 0.0;
    for (const auto& [tile, cells] : own_cells_) {
      lacking += static_cast<double>(cells) - static_cast<double>(shared_cells_[tile]);
    }
    if (last_ != SteadyTime{}) {
      ledger_.cost.lacked_m2_s += std::max(0.0, lacking) * cell_m2() * to_seconds(now - last_);
    }
    last_ = now;
  }

  /// No more scans: sends what is left.
  void finish(SteadyTime now) {
    publisher_.set_finished(true);
    for (int i = 0; i < 100 && publisher_.waiting() > 0; ++i) step(now += kHandOver);
    LIFELINE_CHECK(publisher_.waiting() == 0);
  }

  [[nodiscard]] const sharing::ReplicaLayer& tiles() const { return *store_.find(layer()); }

  [[nodiscard]] SharingCost cost() {
    SharingCost cost = ledger_.cost;
    for (const auto& [index, held] : tiles()) {
      ++cost.tiles;
      cost.final_octets +=
          static_cast<double>(wire::encode_tile(*held.cells, store_.geometry()).size());
      for (const Rival& rival : compare_ ? rivals() : std::vector<Rival>{})
        cost.rivals[rival.name].first += static_cast<double>(rival.octets(*held.cells));
    }
    return cost;
  }

 private:
  static LayerKey layer() { return {AgentId::parse("alpha").value(), MapId{1}, Floor{0}}; }
  [[nodiscard]] double cell_m2() const {
    return store_.geometry().cell_size_m * store_.geometry().cell_size_m;
  }
  void note(TileIndex tile) {
    const QuantisedTile& cells = *tiles().at(tile).cells;
    shared_cells_[tile] = known_cells(cells);
    for (const Rival& rival : compare_ ? rivals() : std::vector<Rival>{}) {
      ledger_.cost.rivals[rival.name].second +=
          ledger_.about_octets() + static_cast<double>(rival.octets(cells));
    }
  }

  bool compare_;
  sharing::ReplicaStore store_;
  sharing::LinkBudget link_;
  Ledger ledger_;
  sharing::TilePublisher publisher_;
  std::map<TileIndex, std::size_t> own_cells_, shared_cells_;
  SteadyTime last_{};
};

/// From the tile as mapped to its payload and back.
void time_codec(const TsdGrid& layer, CodecWalk& walk) {
  for (const TileIndex index : layer.tiles()) {
    const QuantisedTile fine = quantise(*layer.find(index));
    matching::StopWatch watch;
    const auto payload = wire::encode_tile(wire::coarse(fine), layer.geometry());
    walk.encode_ms.push_back(watch.lap_ms());
    LIFELINE_CHECK(wire::decode_tile(payload, layer.geometry()));
    walk.decode_ms.push_back(watch.lap_ms());
  }
}

/// The mapper's hand-overs and the sharing's steps, in the order of the scans' time.
class Player {
 public:
  explicit Player(const AgentSettings& settings)
      : mapper_(settings.slam, settings.geometry, settings.projection),
        coarse_(settings.publisher, settings.geometry, false),
        fine_({settings.publisher.hold_back, false}, settings.geometry, true) {}

  void step(const sensing::RawScan& raw) {
    if (!first_) first_ = raw.stamp;
    const SteadyTime at = SteadyTime{std::chrono::hours(1)} + (raw.stamp - *first_);
    while (now_ < at) share(now_ == SteadyTime{} ? at : std::min(at, now_ + kHandOver));
    mapper_.step(raw);
    if (now_ < hand_over_due_) return;
    hand_over_due_ = now_ + kHandOver;
    hand_over();
  }

  CodecWalk finish() {
    mapper_.finish();
    hand_over();
    CodecWalk walk;
    for (SharedWalk* way : {&coarse_, &fine_}) way->finish(now_);
    walk.lasted_s = to_seconds(now_ - SteadyTime{std::chrono::hours(1)});
    walk.coarse = coarse_.cost();
    walk.fine = fine_.cost();
    walk.known_m2 = known_area_m2(mapper_.layer());
    time_codec(mapper_.layer(), walk);
    return walk;
  }

 private:
  void share(SteadyTime now) {
    now_ = now;
    coarse_.step(now);
    fine_.step(now);
  }
  void hand_over() {
    const sharing::MapTiles tiles = mapper_.take_changed_tiles();
    coarse_.put(tiles);
    fine_.put(tiles);
  }

  HelmetMapper mapper_;
  SharedWalk coarse_, fine_;
  std::optional<Timestamp> first_;
  SteadyTime now_{}, hand_over_due_{};
};

}  // namespace

Result<CodecWalk> play_codec_walk(const std::string& source, const AgentSettings& settings) {
  auto scans = sources::open_source(source, sources::kUnpaced);
  if (!scans) return forward_error(scans);
  Player player(settings);
  for (;;) {
    const auto raw = (*scans)->next();
    if (!raw) return forward_error(raw);
    if (!*raw) return player.finish();
    player.step(**raw);
  }
}

}  // namespace lifeline::bench
