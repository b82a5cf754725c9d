#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/base/time.hpp"
#include "common/grid/tile_index.hpp"
#include "common/grid/tsd_cell.hpp"

namespace lifeline::sharing {

using MapTiles = std::vector<std::pair<TileIndex, std::shared_ptr<const QuantisedTile>>>;

/// How long changed tiles are held back. What others lack of a tile, in square metres, times how
/// long they lack it, is weighed against the octets of a sample (docs/decisions/0109).
struct HoldBackConfig {
  Duration min_interval = std::chrono::milliseconds(500);  ///< between two revisions of one tile
  double new_m2_s = 10.0;      ///< a tile that nobody has goes from so much on, m2 x s
  double changed_m2_s = 60.0;  ///< the first new revision does; later ones from twice, four times
  double least_m2 = 0.25;      ///< what differs by less does not go, m2
  Duration longest = std::chrono::seconds(600);     ///< what differs by more goes after so long
  Duration quiet_after = std::chrono::seconds(20);  ///< nothing came in: all that is left goes
};

/// The same where a helmet may send `budget_bit_s`: these limits are made for 256 kbit/s, and wider
/// links need not wait so long. Narrower ones are kept by the budget itself.
[[nodiscard]] HoldBackConfig for_budget(HoldBackConfig config, double budget_bit_s);

/// A helmet's own tiles: what others hold of them, what they would get, and which of them are to
/// go. One owner, not thread-safe.
class ChangedTiles {
 public:
  /// `coarse`: others get coarse cells (wire::coarse) and not those that were put in.
  ChangedTiles(HoldBackConfig config, bool coarse) : config_(config), coarse_(coarse) {}

  /// A newer state of tiles. `scanned_at`: when the oldest scan was taken that is new in them.
  void put(const MapTiles& tiles, SteadyTime scanned_at = {});
  /// Whether none will come for now: all that is left goes.
  void set_finished(bool finished) { finished_ = finished; }
  /// Revisions of one tile are at least so far apart, whatever the configuration says.
  void set_least_interval(Duration interval) { least_interval_ = interval; }
  /// Others hold the tile so. `at`: since when, or long ago.
  void set_sent(TileIndex tile, std::shared_ptr<const QuantisedTile> cells, SteadyTime at = {});

  struct Due {
    TileIndex tile;
    std::shared_ptr<const QuantisedTile> cells;  ///< what others shall get
    SteadyTime scanned_at{};                     ///< the oldest scan that they lack
  };
  /// What is to go now, most urgent first: tiles that nobody has, then those that differ most.
  /// `cell_m2`: area of a cell. Call it several times a second.
  [[nodiscard]] std::vector<Due> due(SteadyTime now, double cell_m2);

  /// Tiles that are to go, now or later.
  [[nodiscard]] std::size_t waiting() const { return waiting_; }

 private:
  struct Tile {
    std::shared_ptr<const QuantisedTile> newest;  ///< as put in; nullptr once compared
    std::shared_ptr<const QuantisedTile> next;    ///< nullptr where nothing differs
    std::shared_ptr<const QuantisedTile> sent;    ///< nullptr: nobody has it
    int revisions = 0;                            ///< sent by this process, or before
    SteadyTime sent_at{}, compared_at{}, weighed_at{}, differs_since{};
    SteadyTime put_scanned_at{};  ///< of the oldest put() that was not yet compared
    SteadyTime lacks_scan_of{};   ///< of the put() from which on something was to go
    double differs_m2 = 0.0;
    double lacking_m2_s = 0.0;
  };

  void weigh(Tile& tile, SteadyTime now, double cell_m2) const;
  void compare(Tile& tile, double cell_m2) const;
  [[nodiscard]] bool goes(const Tile& tile) const;
  [[nodiscard]] Duration interval() const;
  [[nodiscard]] double enough_m2_s(const Tile& tile) const;
  [[nodiscard]] bool is_due(const Tile& tile, SteadyTime now, bool quiet) const;

  HoldBackConfig config_;
  Duration least_interval_{};
  bool coarse_;
  std::map<TileIndex, Tile> tiles_;
  bool finished_ = false, came_in_ = false;
  SteadyTime last_came_in_{};
  std::size_t waiting_ = 0;
};

}  // namespace lifeline::sharing
